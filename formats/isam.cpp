#include "formats/isam.h"

#include <Eigen/Cholesky>
#include <limits>

#include "formats/euler.h"
#include "formats/line.h"

namespace sg {
namespace {

bool observes(std::string_view tag) {
  return tag == "LANDMARK" || tag == "POINT3";
}

bool joins_poses(std::string_view tag) {
  return tag == "ODOMETRY" || tag == "EDGE2" || tag == "EDGE3";
}

// The largest pose id, -1 without poses. Defects are left for the translation to find.
Id largest_pose_id(std::string_view text) {
  Id largest = -1;
  const auto look = [&](std::string_view line, std::string&) {
    const auto tag = next_word(line);
    if (!observes(tag) && !joins_poses(tag)) return;
    const int poses = observes(tag) ? 1 : 2;
    for (int k = 0; k < poses; ++k) largest = std::max(largest, read_id(line, "a pose id"));
  };
  translate_lines(
      text, "", [](const Error&) {}, look);
  return largest;
}

void append_id(std::string& out, Id id) {
  append_word(out, std::to_string(id));
}

// The rest of a line is R, of which nothing but W = R^T R goes on.
template <int N>
Eigen::Matrix<double, N, N> read_information(std::string_view& rest) {
  const auto root = read_triangle<N>(rest);
  expect_end(rest);
  return root.transpose() * root;
}

void translate_odometry(std::string_view rest, std::string& out) {
  out += "EDGE_SE2";
  for (int k = 0; k < 2; ++k) append_id(out, read_id(rest, "a pose id"));
  for (int k = 0; k < 3; ++k) append_word(out, read_number_text(rest));
  append_triangle<3>(out, read_information<3>(rest));
}

void translate_edge3(std::string_view rest, std::string& out) {
  out += "EDGE_SE3:QUAT";
  for (int k = 0; k < 2; ++k) append_id(out, read_id(rest, "a pose id"));
  translate_euler_pose(rest, out);
  append_triangle<6>(out, to_quaternion_information(read_information<6>(rest)));
}

// `after` is the largest pose id.
void append_landmark_id(std::string& out, std::string_view& rest, Id after) {
  const Id number = read_id(rest, "a landmark id");
  if (number > std::numeric_limits<Id>::max() - 1 - after)
    throw BadLine{"landmark " + std::to_string(number) +
                  ", numbered after the poses, is beyond 64 bits"};
  append_id(out, after + 1 + number);
}

void translate_landmark(std::string_view rest, Id after, std::string& out) {
  out += "EDGE_SE2_XY";
  append_id(out, read_id(rest, "a pose id"));
  append_landmark_id(out, rest, after);
  for (int k = 0; k < 2; ++k) append_word(out, read_number_text(rest));
  append_triangle<2>(out, read_information<2>(rest));
}

void translate_point3(std::string_view rest, Id after, std::string& out) {
  out += "EDGE_SE3_TRACKXYZ";
  append_id(out, read_id(rest, "a pose id"));
  append_landmark_id(out, rest, after);
  out += " 0";  // the sensor's offset: the identity that is appended at the end
  for (int k = 0; k < 3; ++k) append_word(out, read_number_text(rest));
  append_triangle<3>(out, read_information<3>(rest));
}

}  // namespace

bool looks_like_isam(std::string_view text) {
  bool isam = false;
  bool undecided = false;
  scan_tags(text, [&](std::string_view tag) {
    isam = tag == "ODOMETRY" || observes(tag);
    undecided = tag == "EDGE2" || tag == "EDGE3";
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
    const auto tag = next_word(rest);
    if (tag == "ODOMETRY" || tag == "EDGE2") return translate_odometry(rest, out);
    if (tag == "EDGE3") return translate_edge3(rest, out);
    if (tag == "LANDMARK") return translate_landmark(rest, after, out);
    if (tag != "POINT3") return void(out += line);
    offset_needed = true;
    translate_point3(rest, after, out);
  };
  std::string g2o = translate_lines(text, file, complaint, translate);
  if (offset_needed) g2o += "PARAMS_SE3OFFSET 0 0 0 0 0 0 0 1\n";
  return g2o;
}

}  // namespace sg
