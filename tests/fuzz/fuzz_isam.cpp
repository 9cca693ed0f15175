// The iSAM reader and writer.
#include "formats/isam.h"
#include "tests/fuzz/reader.h"

using namespace sg;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto graph = fuzz::graph_of(fuzz::copy_of(data, size), "isam");
  if (!graph) return 0;
  fuzz::require_consistent(*graph);
  isam_losses(*graph);
  try {
    fuzz::StringSink sink;
    write_isam(*graph, {}, sink);
    fuzz::graph_of(text_of(std::move(sink.text)), "isam");
  } catch (const Error& error) {
    fuzz::require(error.fault == Fault::input);
  }
  return 0;
}
