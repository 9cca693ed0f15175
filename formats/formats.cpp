#include "formats/formats.h"

#include <array>

#include "formats/g2o.h"
#include "formats/isam.h"
#include "formats/toro.h"
#include "lib/graph/tokens.h"

namespace sg {
namespace {

constexpr std::array formats{
    ReadFormat{"toro", "TORO: VERTEX2, EDGE2, VERTEX3, EDGE3", looks_like_toro, toro_to_g2o},
    ReadFormat{"isam", "iSAM: ODOMETRY, LANDMARK, EDGE2, EDGE3, POINT3", looks_like_isam,
               isam_to_g2o},
    // Last: what no other format claims.
    ReadFormat{"g2o", "g2o text", [](std::string_view) { return true; }, nullptr},
};

const ReadFormat& find_format(const std::string& name, std::string_view text) {
  std::string known;
  for (const ReadFormat& format : formats) {
    if (name.empty() ? format.looks_like(text) : format.name == name) return format;
    known += (known.empty() ? "" : ", ") + std::string(format.name);
  }
  throw usage_error("unknown format '" + name + "'; there are " + known);
}

}  // namespace

std::span<const ReadFormat> read_formats() {
  return formats;
}

Graph read_graph(const std::string& path, const ReadOptions& options) {
  return read_graph_text(read_text(path), path == "-" ? "<stdin>" : path, options);
}

Graph read_graph_text(Text text, const std::string& file, const ReadOptions& options) {
  const Complaint complaint =
      options.complaint ? options.complaint : [](const Error& error) { throw error; };
  Tags tags = builtin_tags();
  for (const auto& spec : options.vertex_types) teach_vertex(tags, spec);
  for (const auto& spec : options.edge_types) teach_edge(tags, spec);
  const ReadFormat& format = find_format(options.format, text.view);
  if (format.to_g2o) text = text_of(format.to_g2o(text.view, file, complaint));
  return parse_g2o(std::move(text), file, std::move(tags), complaint);
}

}  // namespace sg
