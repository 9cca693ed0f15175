#include "formats/formats.h"

#include <array>
#include <unordered_map>

#include "formats/g2o.h"
#include "formats/isam.h"
#include "formats/toro.h"
#include "lib/text/words.h"

namespace sg::formats {
namespace {

constexpr std::array formats{
    ReadFormat{"toro", "TORO: VERTEX2, EDGE2, VERTEX3, EDGE3", looks_like_toro, toro_to_g2o},
    ReadFormat{"isam", "iSAM: ODOMETRY, LANDMARK, EDGE2, EDGE3, POINT3", looks_like_isam,
               isam_to_g2o},
    // Last: what no other format claims.
    ReadFormat{"g2o", "g2o text", [](std::string_view) { return true; }, nullptr},
};

}  // namespace

std::span<const ReadFormat> read_formats() {
  return formats;
}

const ReadFormat& find_format(const ReadOptions& options, std::string_view text) {
  const std::string& name = options.format;
  std::string known;
  for (const ReadFormat& format : formats) {
    if (name.empty() ? format.looks_like(text) : format.name == name) return format;
    known += (known.empty() ? "" : ", ") + std::string(format.name);
  }
  throw text::usage_error("unknown format '" + name + "'; there are " + known);
}

Graph read_graph(const std::string& path, const ReadOptions& options) {
  return read_graph_text(text::read_text(path), text::input_name(path), options);
}

Graph read_graph_text(text::Text text, const std::string& file, const ReadOptions& options) {
  const Complaint complaint =
      options.complaint ? options.complaint : [](const text::Error& error) { throw error; };
  graph::Tags tags = graph::builtin_tags();
  for (const auto& spec : options.vertex_types) graph::teach_vertex(tags, spec);
  for (const auto& spec : options.edge_types) graph::teach_edge(tags, spec);
  for (const auto& tag : options.param_tags) graph::teach_params(tags, tag);
  const ReadFormat& format = find_format(options, text.view);
  if (format.to_g2o) text = text::text_of(format.to_g2o(text.view, file, complaint));
  return parse_g2o(std::move(text), file, std::move(tags), complaint);
}

std::vector<std::pair<std::string, std::int64_t>> count_tags(std::string_view text) {
  std::vector<std::pair<std::string, std::int64_t>> counts;
  std::unordered_map<std::string_view, std::size_t> place;
  std::size_t last = 0;
  while (!text.empty()) {
    auto line = text::next_line(text);
    auto tag = text::next_word(line);
    if (tag.empty()) continue;
    if (tag.front() == '#') tag = tag.substr(0, 1);
    if (last == counts.size() || counts[last].first != tag) {
      last = place.try_emplace(tag, counts.size()).first->second;
      if (last == counts.size()) counts.emplace_back(tag, 0);
    }
    ++counts[last].second;
  }
  return counts;
}

}  // namespace sg::formats
