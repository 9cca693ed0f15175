#include "formats/kitti.h"

#include <Eigen/Geometry>

#include "formats/translate.h"
#include "formats/tum.h"
#include "lib/text/line.h"

namespace sg::formats {
namespace {

// As written with few digits; a matrix that is farther off is none of a rotation.
constexpr double rounding = 1e-2;

void translate_pose(std::string_view rest, Id id, std::string& out) {
  Eigen::Matrix<double, 3, 4> pose;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) pose(row, column) = text::read_number(rest);
  }
  text::expect_end(rest);
  const Eigen::Matrix3d rotation = pose.leftCols<3>();
  if (!(rotation * rotation.transpose()).isIdentity(rounding) || rotation.determinant() < 0)
    throw text::BadLine{"numbers 1-3, 5-7 and 9-11 of a KITTI pose are no rotation matrix"};
  out += graph::name(graph::VertexTag::se3);
  text::append_number(out, id);
  for (const double number : pose.col(3)) text::append_number(out, number);
  const Eigen::Quaterniond q = Eigen::Quaterniond(rotation).normalized();
  for (const double number : q.coeffs()) text::append_number(out, number);
}

}  // namespace

Losses kitti_losses(const Graph& graph) {
  Losses losses = tum_losses(graph);
  Id next = 0;
  for (Index v = 0; v < graph.vertices(); ++v) {
    if (is_trajectory_pose(graph, v) && graph.id[v] != next++)
      add_loss(losses, graph.vertex_line[v], "ids other than 0, 1, 2, ...", false);
  }
  return losses;
}

void write_kitti(const Graph& graph, const WriteOptions&, Sink& sink) {
  std::string numbers;
  for (Index v = 0; v < graph.vertices(); ++v) {
    if (!is_trajectory_pose(graph, v)) continue;
    numbers.clear();
    append_pose(graph, v, numbers);
    std::string_view rest = numbers;
    Eigen::Vector3d position;
    Eigen::Quaterniond q;
    for (double& x : position) x = text::read_number(rest);
    for (double& x : q.coeffs()) x = text::read_number(rest);
    Eigen::Matrix<double, 3, 4> pose;
    pose << q.normalized().toRotationMatrix(), position;
    std::string line;
    for (int k = 0; k < 12; ++k) text::append_number(line, pose(k / 4, k % 4));
    line += '\n';
    sink.write(std::string_view(line).substr(1));
  }
}

bool looks_like_kitti(std::string_view text) {
  return looks_like_table(text, 12);
}

std::string kitti_to_g2o(std::string_view text, const std::string& file,
                         const Complaint& complaint) {
  Id id = 0;
  return translate_lines(text, file, complaint, [&](std::string_view line, std::string& out) {
    if (says_nothing(line)) return void(out += line);
    translate_pose(line, id++, out);
  });
}

}  // namespace sg::formats
