#include "formats/toro.h"

#include <array>

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
  const Matrix6d information = read_symmetric<6>(rest);
  text::expect_end(rest);
  append_triangle<6>(out, to_quaternion_information(information));
}

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

bool looks_like_toro(std::string_view text) {
  bool toro = false;
  scan_tags(text, [&](std::string_view tag) {
    toro = tag == "VERTEX2" || tag == "VERTEX3";
    return tag != "EDGE2" && tag != "EDGE3";
  });
  return toro;
}

std::string toro_to_g2o(std::string_view text, const std::string& file,
                        const Complaint& complaint) {
  return translate_lines(text, file, complaint, [](std::string_view line, std::string& out) {
    auto rest = line;
    const auto tag = text::next_word(rest);
    if (tag == "VERTEX2") return translate_vertex2(rest, out);
    if (tag == "EDGE2") return translate_edge2(rest, out);
    if (tag == "VERTEX3") return translate_vertex3(rest, out);
    if (tag == "EDGE3") return translate_edge3(rest, out);
    out += line;
  });
}

Losses toro_losses(const Graph& graph) {
  Losses losses;
  add_edge_losses(losses, graph, holds_edge);
  add_vertex_losses(losses, graph, holds_vertex);
  for (Offset line : graph.fix_lines) add_loss(losses, line, graph::fix_tag, false);
  return losses;
}

void write_toro(const Graph& graph, const WriteOptions&, Sink& sink) {
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
}

}  // namespace sg::formats
