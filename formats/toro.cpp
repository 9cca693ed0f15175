#include "formats/toro.h"

#include <algorithm>
#include <array>
#include <span>

#include "formats/euler.h"
#include "formats/translate.h"

namespace sg::formats {
namespace {

void append_ids(std::string& out, std::string_view& rest, int count) {
  for (int k = 0; k < count; ++k) text::append_number(out, text::read_id(rest, "a vertex id"));
}

void translate_vertex2(std::string_view rest, std::string& out) {
  out += graph::name(graph::VertexTag::se2);
  append_ids(out, rest, 1);
  text::copy_numbers(rest, 3, out);
  text::expect_end(rest);
}

void translate_edge2(std::string_view rest, std::string& out) {
  out += graph::name(graph::EdgeTag::se2);
  append_ids(out, rest, 2);
  text::copy_numbers(rest, 3, out);
  std::array<std::string_view, 6> w;  // row by row
  for (const int k : graph::toro_triangle) w[k] = text::read_number_text(rest);
  text::expect_end(rest);
  for (const auto word : w) text::append_word(out, word);
}

void translate_vertex3(std::string_view rest, std::string& out) {
  out += graph::name(graph::VertexTag::se3);
  append_ids(out, rest, 1);
  translate_euler_pose(rest, out);
  text::expect_end(rest);
}

void translate_edge3(std::string_view rest, std::string& out) {
  out += graph::name(graph::EdgeTag::se3);
  append_ids(out, rest, 2);
  translate_euler_pose(rest, out);
  const bool given = !text::at_end(rest);
  const Matrix6d information = given ? read_symmetric<6>(rest) : Matrix6d::Identity();
  text::expect_end(rest);
  append_triangle<6>(out, to_quaternion_information(information));
}

void translate_equivalence(std::string_view rest, std::string& out) {
  out += "# EQUIV";
  append_ids(out, rest, 2);
  text::expect_end(rest);
}

struct Tag {
  std::string_view name;
  void (*translate)(std::string_view rest, std::string& out);
};
constexpr std::array tags{
    Tag{"VERTEX2", translate_vertex2},   Tag{"EDGE2", translate_edge2},
    Tag{"VERTEX3", translate_vertex3},   Tag{"EDGE3", translate_edge3},
    Tag{"VERTEX", translate_vertex2},    Tag{"EDGE", translate_edge2},
    Tag{"EQUIV", translate_equivalence},
};

bool holds_vertex(const Graph& graph, Index v) {
  const graph::VertexTag type = graph.vertex_tag(v);
  return type == graph::VertexTag::se2 || type == graph::VertexTag::se3 ||
         type == graph::VertexTag::toro2 || type == graph::VertexTag::toro3;
}

bool holds_edge(const Graph& graph, Index e) {
  const graph::EdgeTag type = graph.edge_tag(e);
  return type == graph::EdgeTag::se2 || type == graph::EdgeTag::se3 ||
         type == graph::EdgeTag::toro2 || type == graph::EdgeTag::toro3;
}

void write_se2(std::string_view rest, std::string& out) {
  out = "VERTEX2";
  append_ids(out, rest, 1);
  text::copy_numbers(rest, 3, out);
}

void write_edge_se2(std::string_view rest, std::string& out) {
  out = "EDGE2";
  append_ids(out, rest, 2);
  text::copy_numbers(rest, 3, out);
  std::array<std::string_view, 6> w;  // row by row
  for (auto& word : w) word = text::read_number_text(rest);
  for (const int k : graph::toro_triangle) text::append_word(out, w[k]);
}

void write_se3(std::string_view rest, std::string& out) {
  out = "VERTEX3";
  append_ids(out, rest, 1);
  translate_quaternion_pose(rest, out);
}

void write_edge_se3(std::string_view rest, std::string& out) {
  out = "EDGE3";
  append_ids(out, rest, 2);
  translate_quaternion_pose(rest, out);
  append_triangle<6>(out, to_euler_information(read_symmetric<6>(rest)));
}

void write_vertex(graph::VertexTag type, std::string_view line, std::string_view rest,
                  std::string& out) {
  if (type == graph::VertexTag::se2) return write_se2(rest, out);
  if (type == graph::VertexTag::se3) return write_se3(rest, out);
  if (type == graph::VertexTag::toro2 || type == graph::VertexTag::toro3) out = line;
}

void write_edge(graph::EdgeTag type, std::string_view line, std::string_view rest,
                std::string& out) {
  if (type == graph::EdgeTag::se2) return write_edge_se2(rest, out);
  if (type == graph::EdgeTag::se3) return write_edge_se3(rest, out);
  if (type == graph::EdgeTag::toro2 || type == graph::EdgeTag::toro3) out = line;
}

}  // namespace

bool toro_begins(std::string_view word) {
  return std::ranges::find(tags, word, &Tag::name) != tags.end();
}

bool looks_like_toro(std::string_view text) {
  bool toro = false;
  scan_tags(text, [&](std::string_view tag) {
    toro = toro_begins(tag) && !shared_by_toro_and_isam(tag);
    return !shared_by_toro_and_isam(tag);
  });
  return toro;
}

bool rather_toro(std::string_view text) {
  bool isam = true;
  while (!text.empty()) {
    auto line = text::next_line(text);
    if (text::next_word(line) != "EDGE2") continue;
    std::array<double, 11> n{};  // ids, measurement, w
    for (double& number : n) number = text::parse<double>(text::next_word(line)).value_or(0);
    const std::span<const double, 6> w(n.data() + 5, 6);
    if (!(w[0] > 0 && w[2] > 0 && w[3] > 0)) return false;
    if (w[5] == 0) isam = false;  // the last of iSAM's diagonal
  }
  return !isam;
}

std::string toro_to_g2o(std::string_view text, const std::string& file,
                        const Complaint& complaint) {
  return translate_lines(text, file, complaint, [](std::string_view line, std::string& out) {
    auto rest = line;
    const auto tag = std::ranges::find(tags, text::next_word(rest), &Tag::name);
    if (tag == tags.end()) {
      out += line;
    } else {
      tag->translate(rest, out);
    }
  });
}

Losses toro_losses(const Graph& graph) {
  Losses losses;
  add_edge_losses(losses, graph, holds_edge);
  add_vertex_losses(losses, graph, holds_vertex);
  return losses;
}

void write_toro(const Graph& graph, const WriteOptions&, Sink& sink) {
  for (Index e = 0; e < graph.edges(); ++e) {
    if (holds_edge(graph, e)) graph::check_ends(graph, e);
  }
  const auto translate = [&graph](std::string_view line, std::string& out) {
    auto rest = line;
    const graph::TagMeaning* meaning = graph.tags.find(text::next_word(rest));
    if (!meaning) return;
    if (meaning->kind == graph::LineKind::vertex) {
      write_vertex(graph::VertexTag{meaning->type}, line, rest, out);
    } else if (meaning->kind == graph::LineKind::edge) {
      write_edge(graph::EdgeTag{meaning->type}, line, rest, out);
    }
  };
  write_lines(graph, translate, sink);
  sink.write(kept_fix(graph, [&](Index v) { return holds_vertex(graph, v); }));
}

}  // namespace sg::formats
