#include "formats/isam.h"

#include <algorithm>
#include <array>
#include <limits>

#include "formats/euler.h"
#include "formats/translate.h"
#include "lib/geometry/information.h"

namespace sg::formats {
namespace {

bool observes(std::string_view tag) {
  return tag == "LANDMARK" || tag == "POINT3";
}

bool planar(std::string_view tag) {
  return tag == "ODOMETRY" || tag == "EDGE2" || tag == "Constraint2";
}

bool joins_poses(std::string_view tag) {
  return planar(tag) || tag == "EDGE3";
}

bool measures_nothing(std::string_view tag) {
  constexpr std::array<std::string_view, 5> tags{"SOLVE", "POSE3D_INIT", "EDGE3_INIT",
                                                 "POSE3D_TRUE", "EDGE3_TRUE"};
  return std::ranges::find(tags, tag) != tags.end();
}

// The largest pose id, -1 without poses. Defects are left for the translation to find.
Id largest_pose_id(std::string_view text) {
  Id largest = -1;
  const auto look = [&](std::string_view line, std::string&) {
    const auto tag = text::next_word(line);
    if (!observes(tag) && !joins_poses(tag)) return;
    const int poses = observes(tag) ? 1 : 2;
    for (int k = 0; k < poses; ++k) largest = std::max(largest, text::read_id(line, "a pose id"));
  };
  translate_lines(
      text, "", [](const text::Error&) {}, look);
  return largest;
}

// The rest of a line is R, of which nothing but W = R^T R goes on.
template <int N>
Eigen::Matrix<double, N, N> read_information(std::string_view& rest) {
  using Matrix = Eigen::Matrix<double, N, N>;
  const Matrix root = read_symmetric<N>(rest).template triangularView<Eigen::Upper>();
  text::expect_end(rest);
  return root.transpose() * root;
}

// The same where the identity may be left unsaid.
template <int N>
Eigen::Matrix<double, N, N> read_optional_information(std::string_view rest) {
  if (text::at_end(rest)) return Eigen::Matrix<double, N, N>::Identity();
  return read_information<N>(rest);
}

void translate_odometry(std::string_view rest, std::string& out) {
  out += graph::name(graph::EdgeTag::se2);
  for (int k = 0; k < 2; ++k) text::append_number(out, text::read_id(rest, "a pose id"));
  text::copy_numbers(rest, 3, out);
  append_triangle<3>(out, read_information<3>(rest));
}

void translate_edge3(std::string_view rest, std::string& out) {
  out += graph::name(graph::EdgeTag::se3);
  for (int k = 0; k < 2; ++k) text::append_number(out, text::read_id(rest, "a pose id"));
  translate_euler_pose(rest, out);
  append_triangle<6>(out, to_quaternion_information(read_optional_information<6>(rest)));
}

// `after` is the largest pose id.
void append_landmark_id(std::string& out, std::string_view& rest, Id after) {
  const Id number = text::read_id(rest, "a landmark id");
  if (number > std::numeric_limits<Id>::max() - 1 - after)
    throw text::BadLine{"landmark " + std::to_string(number) +
                        ", numbered after the poses, is above 2^63 - 1"};
  text::append_number(out, after + 1 + number);
}

void translate_landmark(std::string_view rest, Id after, std::string& out) {
  out += graph::name(graph::EdgeTag::se2_xy);
  text::append_number(out, text::read_id(rest, "a pose id"));
  append_landmark_id(out, rest, after);
  text::copy_numbers(rest, 2, out);
  append_triangle<2>(out, read_information<2>(rest));
}

void translate_point3(std::string_view rest, Id after, std::string& out) {
  out += graph::name(graph::EdgeTag::se3_trackxyz);
  text::append_number(out, text::read_id(rest, "a pose id"));
  append_landmark_id(out, rest, after);
  out += " 0";  // the sensor's offset: the identity that is appended at the end
  text::copy_numbers(rest, 3, out);
  append_triangle<3>(out, read_optional_information<3>(rest));
}

// Of these parameters alone iSAM's POINT3 can say nothing and means the same.
bool identity_offset(const Graph& graph, Id id) {
  const std::vector<double> identity{0, 0, 0, 0, 0, 0, 1};
  std::vector<double> numbers;
  for (const graph::Param& param : graph.params) {
    if (param.id != id) continue;
    graph::param_numbers(graph, param, numbers);
    return param.type == graph::ParamTag::se3_offset && numbers == identity;
  }
  return false;
}

bool holds_edge(const Graph& graph, Index e) {
  const graph::EdgeTag type = graph.edge_tag(e);
  if (type == graph::EdgeTag::se3_trackxyz)
    return identity_offset(graph, graph::edge_params(graph, e).front());
  return type == graph::EdgeTag::se2 || type == graph::EdgeTag::se3 ||
         type == graph::EdgeTag::se2_xy;
}

// Whether an edge that iSAM can hold joins the vertex.
std::vector<bool> mentioned(const Graph& graph) {
  std::vector<bool> result(graph.vertices(), false);
  for (Index e = 0; e < graph.edges(); ++e) {
    if (!holds_edge(graph, e)) continue;
    for (Index v : graph.edge(e)) result[v] = true;
  }
  return result;
}

template <int N>
void append_root(std::string& out, const Eigen::Matrix<double, N, N>& information) {
  const auto root = geometry::triangular_square_root(information);
  if (!root)
    throw text::BadLine{
        "the information matrix is not positive semidefinite: it has no square root"};
  append_triangle<N>(out, *root);
}

void write_edge(const Graph& graph, Index e, Id first_landmark, std::string& out) {
  auto rest = graph::line_at(graph, graph.edge_line[e]);
  text::next_word(rest);
  const graph::EdgeTag type = graph.edge_tag(e);
  const bool point = type == graph::EdgeTag::se3_trackxyz;
  const bool landmark = point || type == graph::EdgeTag::se2_xy;
  out = point                         ? "POINT3"
        : landmark                    ? "LANDMARK"
        : type == graph::EdgeTag::se2 ? "ODOMETRY"
                                      : "EDGE3";
  text::append_number(out, text::read_id(rest, "a pose id"));
  text::append_number(out, text::read_id(rest, "a vertex id") - (landmark ? first_landmark : 0));
  if (type == graph::EdgeTag::se3) {
    translate_quaternion_pose(rest, out);
    return append_root<6>(out, to_euler_information(read_symmetric<6>(rest)));
  }
  if (point) text::read_id(rest, "a parameter id");
  const int numbers = type == graph::EdgeTag::se2_xy ? 2 : 3;
  text::copy_numbers(rest, numbers, out);
  if (numbers == 2) return append_root<2>(out, read_symmetric<2>(rest));
  append_root<3>(out, read_symmetric<3>(rest));
}

// The largest id of a pose that is written, -1 without one.
Id last_pose(const Graph& graph, const std::vector<bool>& used) {
  Id last = -1;
  for (Index v = 0; v < graph.vertices(); ++v) {
    if (used[v] && graph.role(v) == graph::Role::pose) last = graph.id[v];
  }
  return last;
}

bool below_a_pose(const Graph& graph, const std::vector<bool>& used, Index v, Id last) {
  return used[v] && graph.role(v) == graph::Role::landmark && graph.id[v] < last;
}

// Whether the numbers of landmarks give their ids back: reading counts them on from the last pose.
bool ids_stay(const Graph& graph, const std::vector<bool>& used, Id last) {
  for (Index v = 0; v < graph.vertices(); ++v) {
    if (below_a_pose(graph, used, v, last)) return false;
  }
  return true;
}

}  // namespace

bool isam_begins(std::string_view word) {
  return joins_poses(word) || observes(word) || measures_nothing(word);
}

bool looks_like_isam(std::string_view text) {
  bool isam = false;
  bool undecided = false;
  scan_tags(text, [&](std::string_view tag) {
    undecided = shared_by_toro_and_isam(tag);
    isam = !undecided && isam_begins(tag);
    return !undecided;
  });
  return isam || undecided;  // EDGE2 and EDGE3 alone
}

std::string isam_to_g2o(std::string_view text, const std::string& file,
                        const Complaint& complaint) {
  const Id after = largest_pose_id(text);
  bool offset_needed = false;
  const auto translate = [&](std::string_view line, std::string& out) {
    auto rest = line;
    const auto tag = text::next_word(rest);
    if (planar(tag)) return translate_odometry(rest, out);
    if (tag == "EDGE3") return translate_edge3(rest, out);
    if (tag == "LANDMARK") return translate_landmark(rest, after, out);
    if (measures_nothing(tag)) return void(out.append("# ").append(line));
    if (tag != "POINT3") return void(out += line);
    offset_needed = true;
    translate_point3(rest, after, out);
  };
  std::string g2o = translate_lines(text, file, complaint, translate);
  if (offset_needed)
    g2o.append(graph::name(graph::ParamTag::se3_offset)).append(" 0 0 0 0 0 0 0 1\n");
  return g2o;
}

Losses isam_losses(const Graph& graph) {
  Losses losses;
  add_edge_losses(losses, graph, holds_edge);
  const std::vector<bool> used = mentioned(graph);
  const Id last = last_pose(graph, used);
  for (Index v = 0; v < graph.vertices(); ++v) {
    if (!used[v]) add_loss(losses, graph.vertex_line[v], "a vertex without an edge", true);
    if (below_a_pose(graph, used, v, last))
      add_loss(losses, graph.vertex_line[v], "the id of a landmark below a pose's", true);
  }
  return losses;
}

void write_isam(const Graph& graph, const WriteOptions&, Sink& sink) {
  const std::vector<bool> used = mentioned(graph);
  const Id last = last_pose(graph, used);
  const bool stay = ids_stay(graph, used, last);
  const Id first = stay ? last + 1 : 0;  // what is taken off a landmark's id
  std::string out;
  for (Index e = 0; e < graph.edges(); ++e) {
    if (!holds_edge(graph, e)) continue;
    graph::check_ends(graph, e);
    try {
      write_edge(graph, e, first, out);
    } catch (const text::BadLine& bad) {
      throw graph::error_at(graph, graph.edge_line[e], bad.cause);
    }
    sink.write(out += '\n');
  }
  if (!stay) return;
  std::vector<Offset> estimates;  // in the file's order
  for (Index v = 0; v < graph.vertices(); ++v) {
    if (used[v] && graph.vertex_line[v] != graph::implied)
      estimates.push_back(graph.vertex_line[v]);
  }
  std::ranges::sort(estimates);
  for (const Offset line : estimates) sink.write(kept(graph::line_at(graph, line)).append("\n"));
  sink.write(kept_fix(graph, [&](Index v) { return used[v]; }));
}

}  // namespace sg::formats
