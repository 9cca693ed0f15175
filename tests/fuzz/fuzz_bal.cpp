// The BAL reader and writer.
#include "formats/bal.h"
#include "tests/fuzz/reader.h"

using namespace sg;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto graph = fuzz::graph_of(fuzz::copy_of(data, size), "bal");
  if (!graph) return 0;
  fuzz::require_consistent(*graph);
  formats::bal_losses(*graph);
  if (graph->edges_only) return 0;  // of a file that ends behind its observations
  try {
    fuzz::StringSink sink;
    formats::write_bal(*graph, {}, sink);
    fuzz::graph_of(text::text_of(std::move(sink.text)), "bal");
  } catch (const text::Error& error) {
    fuzz::require(error.fault == text::Fault::input);
  }
  return 0;
}
