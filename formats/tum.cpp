#include "formats/tum.h"

#include <algorithm>
#include <cmath>

#include "formats/euler.h"
#include "lib/text/error.h"
#include "lib/text/line.h"

namespace sg::formats {
namespace {

bool holds(const Graph& graph, Index v) {
  const graph::Space space = graph.type_of_vertex(v).space;
  return space == graph::Space::se2 || space == graph::Space::euler || graph::has_quaternion(space);
}

void append_planar(std::string_view rest, std::string& out) {
  text::copy_numbers(rest, 2, out);
  const double theta = text::read_number(rest);
  out += " 0 0 0";
  text::append_number(out, std::sin(theta / 2));
  text::append_number(out, std::cos(theta / 2));
}

}  // namespace

Losses tum_losses(const Graph& graph) {
  Losses losses;
  for (Index v = 0; v < graph.vertices(); ++v) {
    const graph::VertexType& type = graph.type_of_vertex(v);
    if (!holds(graph, v))
      add_loss(losses, graph.vertex_line[v], type.tag, type.role == graph::Role::pose);
  }
  return losses;
}

void write_tum(const Graph& graph, const WriteOptions&, Sink& sink) {
  std::string out;
  for (Index v = 0; v < graph.vertices(); ++v) {
    if (!holds(graph, v)) continue;
    auto rest = graph::line_at(graph, graph.vertex_line[v]);
    const graph::Space space = graph.type_of_vertex(v).space;
    text::next_word(rest);
    out = text::next_word(rest);
    if (space == graph::Space::se2) {
      append_planar(rest, out);
    } else if (space == graph::Space::euler) {
      translate_euler_pose(rest, out);
    } else {
      text::copy_numbers(rest, 7, out);
    }
    sink.write(out += '\n');
  }
}

namespace {

// Takes lines off the front of `text` up to the next one that is neither blank nor a comment, and
// counts them; empty at the end of the text.
std::string_view next_pose_line(std::string_view& text, std::size_t& number) {
  while (!text.empty()) {
    ++number;
    const std::string_view line = text::next_line(text);
    auto rest = line;
    const auto word = text::next_word(rest);
    if (!word.empty() && !word.starts_with('#')) return line;
  }
  return {};
}

TumPose read_pose(std::string_view line, const std::string& file, std::size_t number) {
  TumPose pose{};
  const auto time = text::parse<double>(text::next_word(line));
  if (!time || *time < 0 || *time != std::floor(*time) || *time > 9e15)
    throw text::input_error(file, number, "a time that is no vertex id: poses are matched by id");
  pose.id = static_cast<Id>(*time);
  for (double& value : pose.numbers) {
    const auto read = text::parse<double>(text::next_word(line));
    if (!read)
      throw text::input_error(file, number, "a pose wants x y z qx qy qz qw behind its time");
    value = *read;
  }
  return pose;
}

}  // namespace

bool looks_like_tum(std::string_view text) {
  std::size_t number = 0;
  auto line = next_pose_line(text, number);
  return text::parse<double>(text::next_word(line)).has_value();
}

std::vector<TumPose> read_tum(std::string_view text, const std::string& file) {
  std::vector<TumPose> poses;
  std::size_t number = 0;
  for (auto line = next_pose_line(text, number); !line.empty();
       line = next_pose_line(text, number)) {
    poses.push_back(read_pose(line, file, number));
  }
  std::sort(poses.begin(), poses.end(),
            [](const TumPose& a, const TumPose& b) { return a.id < b.id; });
  for (std::size_t k = 1; k < poses.size(); ++k) {
    if (poses[k].id == poses[k - 1].id)
      throw text::input_error(file, 0, "time " + std::to_string(poses[k].id) + " comes twice");
  }
  return poses;
}

}  // namespace sg::formats
