// The iSAM reader and writer.
#include "formats/isam.h"
#include "tests/fuzz/reader.h"

using namespace sg;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto graph = fuzz::graph_of(fuzz::copy_of(data, size), "isam");
  if (!graph) return 0;
  fuzz::require_consistent(*graph);
  formats::isam_losses(*graph);
  try {
    fuzz::StringSink sink;
    formats::write_isam(*graph, {}, sink);
    fuzz::graph_of(text::text_of(std::move(sink.text)), "isam");
  } catch (const text::Error& error) {
    fuzz::require(error.fault == text::Fault::input);
  }
  return 0;
}
