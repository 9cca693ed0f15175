// The g2o reader, the writer that keeps bytes, and what looks at a whole graph.
#include "lib/graph/check.h"
#include "lib/graph/replay.h"
#include "lib/graph/summary.h"
#include "tests/fuzz/reader.h"

using namespace sg;

namespace {

// Every second vertex and third edge go: what is left can still be read.
void drop_some(const Graph& graph) {
  formats::Changes changes = formats::unchanged(graph);
  for (Index v = 0; v < graph.vertices(); v += 2) changes.drop_vertex[v] = true;
  for (Index e = 0; e < graph.edges(); e += 3) changes.drop_edge[e] = true;
  fuzz::StringSink sink;
  formats::write_changed(graph, changes, "# fuzz\n", sink);
  fuzz::graph_of(text::text_of(std::move(sink.text)), "g2o");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto graph = fuzz::graph_of(fuzz::copy_of(data, size), "g2o");
  if (!graph) return 0;
  fuzz::require_consistent(*graph);
  fuzz::require_same_bytes(*graph);
  drop_some(*graph);
  graph::check(*graph);
  graph::summarize(*graph);
  graph::replay(*graph, graph::pose_index(*graph), 2);
  return 0;
}
