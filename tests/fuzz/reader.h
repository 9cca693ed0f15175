// What the fuzz targets share: any bytes give a graph whose parts agree, or an input Error, and
// what is read survives writing.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>

#include "formats/formats.h"
#include "formats/write.h"

namespace sg::fuzz {

// As assert, in every build.
inline void require(bool truth) {
  if (!truth) std::abort();
}

struct StringSink final : Sink {
  std::string text;
  void write(std::string_view bytes) override { text += bytes; }
};

inline Text copy_of(const std::uint8_t* data, std::size_t size) {
  return text_of(std::string(reinterpret_cast<const char*>(data), size));
}

// The graph of these bytes; reading goes on after a defect. Nothing where reading ends with an
// Error.
inline std::optional<Graph> graph_of(Text text, const std::string& format) {
  ReadOptions options;
  options.format = format;
  options.complaint = [](const Error& error) { require(error.fault == Fault::input); };
  try {
    return read_graph_text(std::move(text), "fuzz", options);
  } catch (const Error& error) {
    require(error.fault == Fault::input);
    return std::nullopt;
  }
}

inline void require_consistent(const Graph& graph) {
  const auto n = static_cast<std::size_t>(graph.vertices());
  const auto m = static_cast<std::size_t>(graph.edges());
  require(graph.vertex_type.size() == n && graph.vertex_line.size() == n &&
          graph.fixed.size() == n);
  require(graph.edge_line.size() == m && graph.edge_begin.size() == m + 1);
  require(static_cast<std::size_t>(graph.edge_begin.back()) == graph.edge_vertices.size());
  for (std::size_t v = 1; v < n; ++v) require(graph.id[v - 1] < graph.id[v]);
  for (const Index v : graph.edge_vertices) require(v >= 0 && v < graph.vertices());
  for (Index v = 0; v < graph.vertices(); ++v) {
    require(find_vertex(graph, graph.id[v]) == v);
    require((graph.vertex_line[v] == implied) == graph.edges_only);
  }
}

// Nothing is changed: the same bytes.
inline void require_same_bytes(const Graph& graph) {
  StringSink sink;
  write_changed(graph, unchanged(graph), "", sink);
  require(sink.text == graph.text.view);
}

}  // namespace sg::fuzz
