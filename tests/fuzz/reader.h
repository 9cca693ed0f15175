// What the fuzz targets share: any bytes give a graph whose parts agree, or an input Error, and
// what is read survives writing.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>

#include "formats/convert.h"
#include "formats/formats.h"
#include "formats/write.h"

namespace sg::fuzz {

// As assert, in every build.
inline void require(bool truth) {
  if (!truth) std::abort();
}

struct StringSink final : formats::Sink {
  std::string text;
  void write(std::string_view bytes) override { text += bytes; }
};

inline text::Text copy_of(const std::uint8_t* data, std::size_t size) {
  return text::text_of(std::string(reinterpret_cast<const char*>(data), size));
}

// The graph of these bytes; reading goes on after a defect. Nothing where reading ends with an
// Error.
inline std::optional<Graph> graph_of(text::Text text, const std::string& format) {
  formats::ReadOptions options;
  options.format = format;
  options.complaint = [](const text::Error& error) { require(error.fault == text::Fault::input); };
  try {
    return formats::read_graph_text(std::move(text), "fuzz", options);
  } catch (const text::Error& error) {
    // Of usage where no line agrees with the format.
    require(error.fault == text::Fault::input ||
            (error.fault == text::Fault::usage && !format.empty()));
    return std::nullopt;
  }
}

inline void require_consistent(const Graph& graph) {
  const auto n = static_cast<std::size_t>(graph.vertices());
  const auto m = static_cast<std::size_t>(graph.edges());
  require(graph.vertex_type.size() == n && graph.vertex_line.size() == n &&
          graph.fixed.size() == n);
  require(graph.edge_line.size() == m && graph.edge_vertices.begin.size() == m + 1);
  require(static_cast<std::size_t>(graph.edge_vertices.begin.back()) ==
          graph.edge_vertices.items.size());
  for (std::size_t v = 1; v < n; ++v) require(graph.id[v - 1] < graph.id[v]);
  for (const Index v : graph.edge_vertices.items) require(v >= 0 && v < graph.vertices());
  for (Index v = 0; v < graph.vertices(); ++v) {
    require(graph::find_vertex(graph, graph.id[v]) == v);
    require((graph.vertex_line[v] == graph::implied) == graph.edges_only);
  }
}

// A file of a foreign format: what comes of it agrees.
inline std::optional<Graph> read(const std::uint8_t* data, std::size_t size,
                                 const std::string& format) {
  auto graph = graph_of(copy_of(data, size), format);
  if (graph) require_consistent(*graph);
  return graph;
}

// And what is written of that can be read again, or is refused. TORO's writer passes over vertices
// without a line; BAL's needs them all.
inline void read_and_write(const std::uint8_t* data, std::size_t size, const std::string& format) {
  const auto graph = read(data, size, format);
  if (!graph) return;
  const formats::WriteFormat& writer = formats::find_write_format(format);
  writer.losses(*graph);
  if (format == "bal" && graph->edges_only) return;
  try {
    StringSink sink;
    writer.write(*graph, {}, sink);
    graph_of(text::text_of(std::move(sink.text)), format);
  } catch (const text::Error& error) {
    require(error.fault == text::Fault::input);
  }
}

// Nothing is changed: the same bytes.
inline void require_same_bytes(const Graph& graph) {
  StringSink sink;
  formats::write_changed(graph, formats::unchanged(graph), "", sink);
  require(sink.text == graph.text.view);
}

}  // namespace sg::fuzz
