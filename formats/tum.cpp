#include "formats/tum.h"

#include <cmath>

#include "formats/euler.h"
#include "formats/line.h"

namespace sg {
namespace {

bool planar(std::string_view tag) {
  return tag == "VERTEX_SE2" || tag == "VERTEX2";
}

// Tags whose first seven numbers are x y z qx qy qz qw.
bool spatial(std::string_view tag) {
  return tag == "VERTEX_SE3:QUAT" || tag == "VERTEX_SE3:EXPMAP" || tag == "VERTEX_CAM";
}

bool holds(const Graph& graph, Index v) {
  const std::string_view tag = graph.type_of_vertex(v).tag;
  return planar(tag) || spatial(tag) || tag == "VERTEX3";
}

void append_planar(std::string_view rest, std::string& out) {
  for (int k = 0; k < 2; ++k) append_word(out, read_number_text(rest));
  const double theta = read_number(rest);
  out += " 0 0 0";
  append_number(out, std::sin(theta / 2));
  append_number(out, std::cos(theta / 2));
}

}  // namespace

Losses tum_losses(const Graph& graph) {
  Losses losses;
  add_vertex_losses(losses, graph, holds);
  for (Loss& loss : losses) {
    loss.structure = graph.tags.vertices[graph.tags.vertex_type(loss.what)].role == Role::pose;
  }
  return losses;
}

void write_tum(const Graph& graph, const WriteOptions&, Sink& sink) {
  std::string out;
  for (Index v = 0; v < graph.vertices(); ++v) {
    if (!holds(graph, v)) continue;
    auto rest = line_at(graph, graph.vertex_line[v]);
    const auto tag = next_word(rest);
    out = next_word(rest);
    if (planar(tag)) {
      append_planar(rest, out);
    } else if (tag == "VERTEX3") {
      translate_euler_pose(rest, out);
    } else {
      for (int k = 0; k < 7; ++k) append_word(out, read_number_text(rest));
    }
    sink.write(out += '\n');
  }
}

}  // namespace sg
