#include "formats/convert.h"

#include <algorithm>
#include <array>

#include "formats/bal.h"
#include "formats/dot.h"
#include "formats/isam.h"
#include "formats/kitti.h"
#include "formats/metis_file.h"
#include "formats/mtx.h"
#include "formats/toro.h"
#include "formats/tum.h"
#include "lib/text/error.h"
#include "lib/text/nearest.h"

namespace sg::formats {
namespace {

Losses nothing(const Graph&) {
  return {};
}

void write_g2o(const Graph& graph, const WriteOptions&, Sink& sink) {
  write_changed(graph, unchanged(graph), "", sink);
}

constexpr std::array formats{
    WriteFormat{"g2o", "g2o text", nothing, write_g2o},
    WriteFormat{"toro", "TORO", toro_losses, write_toro, true},
    WriteFormat{"isam", "iSAM", isam_losses, write_isam},
    WriteFormat{"bal", "BAL", bal_losses, write_bal, true},
    WriteFormat{"mtx", "Matrix Market pattern of A^T A", nothing, write_mtx},
    WriteFormat{"metis", "METIS graph", nothing, write_metis},
    WriteFormat{"dot", "Graphviz", nothing, write_dot},
    WriteFormat{"tum", "TUM trajectory", tum_losses, write_tum, true},
    WriteFormat{"kitti", "KITTI trajectory", kitti_losses, write_kitti, true},
};

}  // namespace

void add_loss(Losses& losses, Offset line, std::string_view what, bool structure) {
  const auto it =
      std::find_if(losses.begin(), losses.end(), [&](const Loss& l) { return l.what == what; });
  if (it == losses.end()) {
    losses.push_back({line, std::string(what), structure});
  } else {
    ++it->count;
    if (it->first == graph::implied || (line != graph::implied && line < it->first))
      it->first = line;
  }
}

void add_edge_losses(Losses& losses, const Graph& graph, Holds holds_edge) {
  for (Index e = 0; e < graph.edges(); ++e) {
    if (!holds_edge(graph, e))
      add_loss(losses, graph.edge_line[e], graph.type_of_edge(e).tag, true);
  }
}

void add_vertex_losses(Losses& losses, const Graph& graph, Holds holds_vertex) {
  for (Index v = 0; v < graph.vertices(); ++v) {
    if (!holds_vertex(graph, v))
      add_loss(losses, graph.vertex_line[v], graph.type_of_vertex(v).tag, true);
  }
}

std::span<const WriteFormat> write_formats() {
  return formats;
}

const WriteFormat& find_write_format(std::string_view name) {
  for (const WriteFormat& format : formats) {
    if (format.name == name) return format;
  }
  throw text::usage_error(text::no_such("format", name, text::names_of(formats)));
}

}  // namespace sg::formats
