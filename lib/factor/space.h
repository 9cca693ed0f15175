// The spaces that estimates live in: how many numbers one takes, and how a tangent step moves it.
//
// The steps are g2o's (`oplus`), so that Jacobians, information matrices and iterates compare with
// its own:
//   se2     VERTEX_SE2                  (x, y, theta): added number by number, theta wrapped
//   se3     VERTEX_SE3:QUAT             (x, y, z, qx, qy, qz, qw): x d, where d is the translation
//                                       step[0..2] and the quaternion with vector part step[3..5]
//   expmap  VERTEX_SE3:EXPMAP           the same seven numbers: exp(step) x, step = (rotation,
//                                       translation)
//   xy      VERTEX_XY                   added
//   xyz     VERTEX_TRACKXYZ, VERTEX_XYZ added
// An expmap estimate maps world to camera; its file line holds the inverse. Quaternions have unit
// length in memory.
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace sg {

enum class Space { se2, se3, expmap, xy, xyz };

constexpr int space_dim(Space space) {
  return std::array{3, 6, 6, 2, 3}[static_cast<int>(space)];
}
// Numbers of an estimate, in memory as in a vertex line.
constexpr int space_size(Space space) {
  return std::array{3, 7, 7, 2, 3}[static_cast<int>(space)];
}

// Whether a scalar of a step turns, in radians or halves of them; the others move, in metres.
constexpr bool is_turn(Space space, int scalar) {
  if (space == Space::expmap) return scalar < 3;
  return (space == Space::se2 && scalar == 2) || (space == Space::se3 && scalar >= 3);
}

// Of a vertex tag; nothing for a vertex that no measurement model knows.
std::optional<Space> find_space(std::string_view vertex_tag);
std::string_view name(Space space);

// x := x (+) step.
void retract(Space space, const double* step, double* x);

// Identity, the origin.
void set_origin(Space space, double* x);

// A vertex line's numbers to an estimate and back. False for a quaternion of length zero.
bool from_file(Space space, const double* numbers, double* x);
void to_file(Space space, const double* x, double* numbers);

}  // namespace sg
