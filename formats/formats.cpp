#include "formats/formats.h"

#include <algorithm>
#include <array>
#include <unordered_map>
#include <utility>
#include <vector>

#include "formats/bal.h"
#include "formats/g2o.h"
#include "formats/isam.h"
#include "formats/kitti.h"
#include "formats/thin.h"
#include "formats/toro.h"
#include "formats/translate.h"
#include "formats/tum.h"
#include "lib/text/nearest.h"
#include "lib/text/stream.h"
#include "lib/text/words.h"

namespace sg::formats {
namespace {

bool is_number(std::string_view word) {
  return text::parse<double>(word).has_value();
}

bool anything(std::string_view) {
  return true;
}

constexpr std::array formats{
    ReadFormat{"toro", "TORO: VERTEX2, EDGE2, VERTEX3, EDGE3", looks_like_toro, toro_begins,
               toro_to_g2o},
    ReadFormat{"isam", "iSAM: ODOMETRY, LANDMARK, EDGE2, EDGE3, POINT3", looks_like_isam,
               isam_begins, isam_to_g2o},
    ReadFormat{"tum", "TUM: a trajectory, time and pose a line", looks_like_tum, is_number,
               tum_to_g2o},
    ReadFormat{"kitti", "KITTI: a trajectory, a matrix a line", looks_like_kitti, is_number,
               kitti_to_g2o},
    ReadFormat{"bal", "BAL: cameras, points, and pixels", looks_like_bal, is_number, bal_to_g2o},
    // Last: what no other format claims.
    ReadFormat{"g2o", "g2o text", anything, anything, nullptr},
};

const ReadFormat& named(std::string_view name) {
  for (const ReadFormat& format : formats) {
    if (format.name == name) return format;
  }
  throw text::usage_error(text::no_such("format", name, text::names_of(formats)));
}

const ReadFormat& told_by_content(std::string_view text) {
  return *std::ranges::find_if(formats, [&](const ReadFormat& f) { return f.looks_like(text); });
}

// Nothing but EDGE2 and EDGE3, and some of them.
bool toro_or_isam(std::string_view text) {
  bool shared = false;
  scan_tags(text, [&](std::string_view tag) { return !(shared = shared_by_toro_and_isam(tag)); });
  return shared;
}

// Says which of two readings was chosen, where they differ.
void warn_of_choice(const ReadFormat& chosen, const ReadOptions& options, std::string_view text,
                    std::string_view read, const std::string& file) {
  if (!options.warning || !options.format.empty() || !toro_or_isam(text)) return;
  const ReadFormat& other = named(chosen.name == "toro" ? "isam" : "toro");
  if (other.to_g2o(text, file, [](const text::Error&) {}) == read) return;
  options.warning(file + ": EDGE2 and EDGE3 are TORO's and iSAM's: read as " +
                  std::string(chosen.name) + " (--from " + std::string(other.name) +
                  " for the other)");
}

// "left out 2 EDGE_SE3_PLANE, 1 EDGE_SE3_PRIORXY"
void warn_of_left_out(const Graph& graph, const Warning& warning) {
  if (graph.left_out.empty() || !warning) return;
  std::string lines;
  for (const Offset line : graph.left_out) lines.append(graph::line_at(graph, line)).append("\n");
  std::string said;
  for (const auto& [tag, count] : count_tags(lines))
    said += (said.empty() ? "" : ", ") + std::to_string(count) + " " + tag;
  warning(graph.file + ": left out " + said);
}

// What is no text of a graph, by what its first bytes say.
void refuse_other_files(std::string_view text, const std::string& file) {
  struct Kind {
    std::string_view begins, what;
  };
  constexpr std::array kinds{
      Kind{"PK\x03\x04", "a ZIP archive: unpack it"},
      Kind{"SQLite format 3", "an SQLite database, not a graph's text: export the graph from it"},
      Kind{"#ROSBAG", "a ROS bag, not a graph's text"},
      Kind{"\x7f"
           "ELF",
           "a program"},
      Kind{"%PDF", "a PDF document"},
      Kind{"<", "HTML or XML, perhaps the page of an error, not a graph's text"},
      Kind{"{", "JSON, not a graph's text"},
      Kind{"version https://git-lfs", "a pointer of Git LFS: fetch the file it stands for"},
  };
  for (const Kind& kind : kinds) {
    if (text.starts_with(kind.begins))
      throw text::input_error(file, 1, "this is " + std::string(kind.what));
  }
  if (text.substr(0, 4096).find('\0') != text.npos)
    throw text::input_error(file, 1, "this is binary data, not a graph's text");
}

Complaint complaint_of(const ReadOptions& options) {
  return options.complaint ? options.complaint : [](const text::Error& error) { throw error; };
}

graph::Tags tags_of(const ReadOptions& options) {
  graph::Tags tags = graph::builtin_tags();
  for (const auto& spec : options.vertex_types) graph::teach_vertex(tags, spec);
  for (const auto& spec : options.edge_types) graph::teach_edge(tags, spec);
  for (const auto& tag : options.param_tags) graph::teach_params(tags, tag);
  for (const auto& spec : options.aliases) graph::teach_alias(tags, spec);
  return tags;
}

// Whether the first lines of a text are g2o's.
bool begins_as_g2o(std::string_view block, const ReadOptions& options) {
  if (block.starts_with("\xEF\xBB\xBF")) return false;  // a mark of another editor's
  std::string_view lines = block.substr(0, 1U << 16);
  lines = lines.substr(0, lines.rfind('\n') + 1);
  if (lines.find('\0') != lines.npos || find_format(options, lines).to_g2o) return false;
  const auto known = tags_of(options);
  bool any = false;
  scan_tags(lines, [&](std::string_view tag) { return !(any = known.find(tag) != nullptr); });
  return any;
}

}  // namespace

std::span<const ReadFormat> read_formats() {
  return formats;
}

void check_format(std::string_view name) {
  named(name);
}

const ReadFormat& find_format(const ReadOptions& options, std::string_view text) {
  if (options.format.empty())
    return toro_or_isam(text) && rather_toro(text) ? named("toro") : told_by_content(text);
  const ReadFormat& format = named(options.format);
  bool any = false, agrees = false;
  scan_tags(text, [&](std::string_view tag) {
    any = true;
    return agrees = format.begins(tag);
  });
  if (any && !agrees) {
    throw text::usage_error("--from " + options.format +
                            ": no line of the input is of that format (it looks like " +
                            std::string(told_by_content(text).name) + ")");
  }
  return format;
}

Graph read_graph(const std::string& path, const ReadOptions& options) {
  return read_graph_text(text::read_text(path), text::input_name(path), options);
}

Graph read_graph_text(text::Text text, const std::string& file, const ReadOptions& options) {
  const Complaint complaint = complaint_of(options);
  graph::Tags tags = tags_of(options);
  refuse_other_files(text.view, file);
  const ReadFormat& format = find_format(options, text.view);
  if (format.to_g2o) {
    std::string translated = format.to_g2o(text.view, file, complaint);
    warn_of_choice(format, options, text.view, translated, file);
    text = text::text_of(std::move(translated));
  }
  Graph graph = parse_g2o(std::move(text), file, std::move(tags), complaint,
                          {options.skip_unknown, options.unknown_edge});
  warn_of_left_out(graph, options.warning);
  return graph;
}

Graph read_graph_thinly(const std::string& path, const ReadOptions& options, Source& source) {
  const text::Stream stream = text::open_stream(path);
  std::vector<char> room(4U << 20);
  const std::string_view first = text::read_block(stream, room);
  if (first.size() < room.size() || !begins_as_g2o(first, options)) {
    text::Text text = text::read_rest(stream, first);
    source = {find_format(options, text.view).name, text.view.size()};
    return read_graph_text(std::move(text), stream.path, options);
  }
  source = {"g2o", 0};
  const auto next_block = [&] {
    const auto block = source.bytes == 0 ? first : text::read_block(stream, room);
    source.bytes += block.size();
    return block;
  };
  Graph graph = parse_g2o_thinly(next_block, stream.path, tags_of(options), complaint_of(options),
                                 {options.skip_unknown, options.unknown_edge});
  warn_of_left_out(graph, options.warning);
  return graph;
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
