#include "formats/tum.h"

#include <cmath>

#include "formats/euler.h"
#include "formats/translate.h"
#include "lib/text/line.h"

namespace sg::formats {
namespace {

void append_planar(std::string_view rest, std::string& out) {
  text::copy_numbers(rest, 2, out);
  const double theta = text::read_number(rest);
  out += " 0 0 0";
  text::append_number(out, std::sin(theta / 2));
  text::append_number(out, std::cos(theta / 2));
}

// Times are ids where they are whole numbers, exact up to 2^63 - 1 where they are written as such.
Id id_of_time(std::string_view time) {
  if (const auto id = text::parse<Id>(time); id && *id >= 0) return *id;
  const auto seconds = text::parse<double>(time);
  if (!seconds || !(*seconds >= 0) || *seconds != std::floor(*seconds) || *seconds > 9e15)
    throw text::BadLine{"a time that is no vertex id: poses are matched by id"};
  return static_cast<Id>(*seconds);
}

}  // namespace

bool is_trajectory_pose(const Graph& graph, Index v) {
  const graph::Space space = graph.type_of_vertex(v).space;
  return space == graph::Space::se2 || space == graph::Space::euler || graph::has_quaternion(space);
}

void append_pose(const Graph& graph, Index v, std::string& out) {
  auto rest = graph::line_at(graph, graph.vertex_line[v]);
  const graph::Space space = graph.type_of_vertex(v).space;
  text::next_word(rest);
  text::next_word(rest);
  try {
    if (space == graph::Space::se2) {
      append_planar(rest, out);
    } else if (space == graph::Space::euler) {
      translate_euler_pose(rest, out);
    } else {
      copy_quaternion_pose(rest, out);
    }
  } catch (const text::BadLine& bad) {
    throw graph::error_at(graph, graph.vertex_line[v], bad.cause);
  }
}

Losses tum_losses(const Graph& graph) {
  Losses losses;
  for (Index v = 0; v < graph.vertices(); ++v) {
    const graph::VertexType& type = graph.type_of_vertex(v);
    if (!is_trajectory_pose(graph, v))
      add_loss(losses, graph.vertex_line[v], type.tag, type.role == graph::Role::pose);
  }
  return losses;
}

void write_tum(const Graph& graph, const WriteOptions& options, Sink& sink) {
  std::string out;
  for (Index v = 0; v < graph.vertices(); ++v) {
    if (!is_trajectory_pose(graph, v)) continue;
    out = options.times.empty() ? std::to_string(graph.id[v]) : options.times[v];
    append_pose(graph, v, out);
    sink.write(out += '\n');
  }
}

bool looks_like_tum(std::string_view text) {
  return looks_like_table(text, 8);
}

std::string tum_to_g2o(std::string_view text, const std::string& file, const Complaint& complaint) {
  return translate_lines(text, file, complaint, [](std::string_view line, std::string& out) {
    if (says_nothing(line)) return void(out += line);
    auto rest = line;
    out += graph::name(graph::VertexTag::se3);
    text::append_number(out, id_of_time(text::next_word(rest)));
    copy_quaternion_pose(rest, out);
    text::expect_end(rest);
  });
}

}  // namespace sg::formats
