#include "lib/world/lines.h"

#include <array>
#include <cmath>

#include "lib/geometry/numbers.h"

namespace sg::world {
namespace {

// True of one of q and -q: the sign of its last nonzero component, the real part being the last.
bool canonical(const Eigen::Quaterniond& q) {
  for (int i = 3; i >= 0; --i) {
    if (q.coeffs()[i] != 0) return q.coeffs()[i] > 0;
  }
  return true;
}

double information(double sigma) {
  return 1 / (sigma * sigma);
}

}  // namespace

SE2 rounded(const SE2& pose) {
  return {rounded(pose.x), rounded(pose.y), rounded(pose.theta)};
}

SE3 rounded(const SE3& pose) {
  SE3 result;
  const Eigen::Quaterniond q = pose.q.normalized();
  for (int i = 0; i < 4; ++i) result.q.coeffs()[i] = rounded(q.coeffs()[i]);
  for (int i = 0; i < 3; ++i) result.t[i] = rounded(pose.t[i]);
  if (!canonical(result.q)) result.q.coeffs() *= -1;
  return result;
}

SE2 disturbed(const SE2& z, const PoseNoise& noise, Random& random) {
  SE2 n;
  n.x = normal(random, noise.translation);
  n.y = normal(random, noise.translation);
  n.theta = normal(random, noise.rotation);
  return rounded(compose(z, n));
}

SE3 disturbed(const SE3& z, const PoseNoise& noise, Random& random) {
  SE3 n;
  for (double& x : n.t) x = normal(random, noise.translation);
  for (double& x : n.q.vec()) x = normal(random, noise.rotation / 2);
  const double square = n.q.vec().squaredNorm();
  if (square < 1) {
    n.q.w() = std::sqrt(1 - square);
  } else {
    n.q.normalize();  // noise beyond half a turn
  }
  return rounded(compose(z, n));
}

void numbers(Out& out, const SE2& pose) {
  for (const double x : numbers_of(pose)) number(out, x);
}

void numbers(Out& out, const SE3& pose) {
  for (const double x : numbers_of(rounded(pose))) number(out, x);
}

void diagonal_information(Out& out, const double* diagonal, int size) {
  for (int i = 0; i < size; ++i) {
    significant(out, diagonal[i]);
    for (int j = i + 1; j < size; ++j) significant(out, 0);
  }
}

void vertex_line(Out& out, Id vertex, const SE2& pose) {
  begin_line(out, graph::name(graph::VertexTag::se2), {vertex});
  numbers(out, pose);
  end_line(out);
}

void vertex_line(Out& out, Id vertex, const SE3& pose) {
  begin_line(out, graph::name(graph::VertexTag::se3), {vertex});
  numbers(out, pose);
  end_line(out);
}

void edge_line(Out& out, Id a, Id b, const SE2& z, const PoseNoise& noise) {
  begin_line(out, graph::name(graph::EdgeTag::se2), {a, b});
  numbers(out, z);
  const double xy = information(noise.translation), theta = information(noise.rotation);
  diagonal_information(out, std::array{xy, xy, theta}.data(), 3);
  end_line(out);
}

void edge_line(Out& out, Id a, Id b, const SE3& z, const PoseNoise& noise) {
  begin_line(out, graph::name(graph::EdgeTag::se3), {a, b});
  numbers(out, z);
  const double xyz = information(noise.translation), q = 4 * information(noise.rotation);
  diagonal_information(out, std::array{xyz, xyz, xyz, q, q, q}.data(), 6);
  end_line(out);
}

}  // namespace sg::world
