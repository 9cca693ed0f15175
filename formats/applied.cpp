#include "formats/applied.h"

namespace sg::formats {
namespace {

struct Text final : Sink {
  std::string bytes;
  void write(std::string_view more) override { bytes += more; }
};

}  // namespace

Graph applied(const Graph& graph, Changes changes, ReadOptions options) {
  Text text;
  write_changed(graph, std::move(changes), "", text);
  options.format = "g2o";  // whatever the graph was read from
  return read_graph_text(text::text_of(std::move(text.bytes)), graph.file, options);
}

}  // namespace sg::formats
