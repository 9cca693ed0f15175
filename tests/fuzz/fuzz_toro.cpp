// The TORO reader and writer.
#include "formats/toro.h"
#include "tests/fuzz/reader.h"

using namespace sg;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto graph = fuzz::graph_of(fuzz::copy_of(data, size), "toro");
  if (!graph) return 0;
  fuzz::require_consistent(*graph);
  formats::toro_losses(*graph);
  try {
    fuzz::StringSink sink;
    formats::write_toro(*graph, {}, sink);
    fuzz::graph_of(text::text_of(std::move(sink.text)), "toro");
  } catch (const text::Error& error) {
    fuzz::require(error.fault == text::Fault::input);
  }
  return 0;
}
