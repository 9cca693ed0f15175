#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <numbers>
#include <numeric>

#include "lib/geometry/information.h"
#include "lib/geometry/numbers.h"
#include "lib/geometry/se2.h"
#include "lib/geometry/se3.h"
#include "lib/geometry/triangle.h"
#include "tests/unit/common.h"

using namespace sg;
using namespace sg::test;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

constexpr double pi = std::numbers::pi;

template <int N>
Eigen::Matrix<double, N, 1> random_vector(Random& random, double size = 1) {
  return Eigen::Matrix<double, N, 1>::NullaryExpr([&] { return uniform(random, -size, size); });
}

template <int N>
Eigen::Matrix<double, N, N> random_information(Random& random) {
  const auto square =
      Eigen::Matrix<double, N, N>::NullaryExpr([&] { return uniform(random, -1, 1); }).eval();
  return square * square.transpose() + Eigen::Matrix<double, N, N>::Identity();
}

SE2 random_se2(Random& random) {
  return {uniform(random, -5, 5), uniform(random, -5, 5), uniform(random, -pi, pi)};
}
SE3 random_se3(Random& random) {
  return {Eigen::Quaterniond(random_vector<4>(random).normalized()), random_vector<3>(random, 5)};
}

Matrix3d matrix(const SE2& a) {
  Matrix3d m = Matrix3d::Identity();
  m.topLeftCorner<2, 2>() = geometry::rotation(a.theta);
  m.topRightCorner<2, 1>() << a.x, a.y;
  return m;
}

Eigen::Matrix4d matrix(const SE3& a) {
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  m.topLeftCorner<3, 3>() = a.q.toRotationMatrix();
  m.topRightCorner<3, 1>() = a.t;
  return m;
}

// exp of a tangent vector as the power series of its matrix: the definition.
template <class Matrix>
Matrix power_series(const Matrix& x) {
  Matrix term = Matrix::Identity(), sum = term;
  for (int k = 1; k < 60; ++k) sum += (term = (term * x / k).eval());
  return sum;
}

Matrix3d hat(const Vector3d& v) {
  return Matrix3d{{0, -v[2], v[0]}, {v[2], 0, v[1]}, {0, 0, 0}};
}
Eigen::Matrix4d hat(const Vector6d& v) {
  Eigen::Matrix4d m = Eigen::Matrix4d::Zero();
  m.topLeftCorner<3, 3>() = geometry::skew(v.tail<3>());
  m.topRightCorner<3, 1>() = v.head<3>();
  return m;
}

template <class Pose>
void check_group(const Pose& a, const Pose& b) {
  CHECK(matrix(geometry::compose(a, b)).isApprox(matrix(a) * matrix(b), 1e-12));
  CHECK(matrix(geometry::inverse(a)).isApprox(matrix(a).inverse().eval(), 1e-12));
  CHECK(matrix(geometry::between(a, b)).isApprox(matrix(a).inverse() * matrix(b), 1e-12));
}

// d with  z d  the composition of a d1 and b d2, in the edge's own coordinates.
Vector3d end_error(const SE2& z, const SE2& x) {
  const SE2 d = between(z, x);
  return {d.x, d.y, d.theta};
}
Vector6d end_error(const SE3& z, const SE3& x) {
  const SE3 d = between(z, x);
  Vector6d e;
  e << d.t, (d.q.w() < 0 ? -1 : 1) * d.q.vec();
  return e;
}
SE2 disturbed(const SE2& z, const Vector3d& d) {
  return compose(z, SE2{d[0], d[1], d[2]});
}
SE3 disturbed(const SE3& z, const Vector6d& d) {
  Eigen::Quaterniond q;
  q.vec() = d.tail<3>();
  q.w() = std::sqrt(1 - d.tail<3>().squaredNorm());
  return compose(z, SE3{q, d.head<3>()});
}

// Covariance of f(d1, d2) by numerical differentiation at 0.
template <int N, class F>
Eigen::Matrix<double, N, N> numerical_covariance(const F& f, const Eigen::Matrix<double, N, N>& a,
                                                 const Eigen::Matrix<double, N, N>& b) {
  using Vector = Eigen::Matrix<double, N, 1>;
  using Matrix = Eigen::Matrix<double, N, N>;
  const double h = 1e-6;
  Matrix ja, jb;
  for (int k = 0; k < N; ++k) {
    const Vector step = h * Vector::Unit(k), zero = Vector::Zero();
    ja.col(k) = (f(step, zero) - f(-step, zero)) / (2 * h);
    jb.col(k) = (f(zero, step) - f(zero, -step)) / (2 * h);
  }
  return ja * a.inverse() * ja.transpose() + jb * b.inverse() * jb.transpose();
}

template <int N, class Uncertain>
void check_propagation(const Uncertain& a, const Uncertain& b) {
  using Vector = Eigen::Matrix<double, N, 1>;
  const Uncertain both = geometry::compose(a, b);
  const auto composed = [&](const Vector& d1, const Vector& d2) {
    return end_error(both.mean, geometry::compose(disturbed(a.mean, d1), disturbed(b.mean, d2)));
  };
  const auto expected = numerical_covariance<N>(composed, a.information, b.information);
  CHECK(both.information.inverse().isApprox(expected, 1e-7));

  const Uncertain back = geometry::inverse(a);
  const auto inverted = [&](const Vector& d, const Vector& ignored) {
    return Vector(end_error(back.mean, geometry::inverse(disturbed(a.mean, d))) + 0 * ignored);
  };
  const auto covariance = numerical_covariance<N>(inverted, a.information, b.information);
  CHECK(back.information.inverse().isApprox(covariance, 1e-7));
}

}  // namespace

TEST_CASE("angles are wrapped to above -pi and up to pi", "[geometry]") {
  CHECK(geometry::wrap(0.5) == 0.5);
  CHECK(geometry::wrap(pi) == pi);
  CHECK(geometry::wrap(-pi) == pi);
  CHECK(geometry::wrap(3 * pi / 2) == Approx(-pi / 2));
  CHECK(geometry::wrap(-7) == Approx(2 * pi - 7));
  for (int k = -50; k <= 50; ++k) {
    const double angle = geometry::wrap(0.3 + k);
    CHECK((angle > -pi && angle <= pi));
    CHECK(std::sin(angle) == Approx(std::sin(0.3 + k)).margin(1e-12));
  }
}

TEST_CASE("SE(2) follows its matrices", "[geometry]") {
  Random random(11);
  for (int trial = 0; trial < 50; ++trial) {
    const SE2 a = random_se2(random), b = random_se2(random);
    check_group(a, b);
    const Eigen::Vector2d p = random_vector<2>(random);
    CHECK(act(a, p).homogeneous().isApprox(matrix(a) * p.homogeneous(), 1e-12));
    const Vector3d v = random_vector<3>(random, trial % 2 ? 3 : 1e-5);
    CHECK(matrix(geometry::exp(v)).isApprox(power_series(hat(v)), 1e-10));
    CHECK(log(geometry::exp(v)).isApprox(v, 1e-10));
    CHECK(hat(Vector3d(adjoint(a) * v)).isApprox(matrix(a) * hat(v) * matrix(a).inverse(), 1e-9));
  }
}

TEST_CASE("SE(3) follows its matrices", "[geometry]") {
  Random random(12);
  for (int trial = 0; trial < 50; ++trial) {
    const SE3 a = random_se3(random), b = random_se3(random);
    check_group(a, b);
    const Vector3d p = random_vector<3>(random);
    CHECK(act(a, p).homogeneous().isApprox(matrix(a) * p.homogeneous(), 1e-12));
    const Vector6d v = random_vector<6>(random, trial % 2 ? 1.7 : 1e-3);
    CHECK(matrix(geometry::exp(v)).isApprox(power_series(hat(v)), 1e-10));
    CHECK(log(geometry::exp(v)).isApprox(v, 1e-10));
    CHECK(hat(Vector6d(adjoint(a) * v)).isApprox(matrix(a) * hat(v) * matrix(a).inverse(), 1e-9));
  }
}

TEST_CASE("where power series take over, motions are as exact as elsewhere", "[geometry]") {
  const Vector3d axis = Vector3d(1, 2, 2) / 3, far(300, -200, 100);
  for (const double angle : {0.00999, 0.0101}) {
    Vector6d v;
    v << far, angle * axis;
    CHECK((matrix(geometry::exp(v)) - power_series(hat(v))).norm() < 2e-13 * far.norm());
  }
}

TEST_CASE("the inverse left Jacobian is the derivative of log", "[geometry]") {
  Random random(13);
  for (double size : {1.2, 0.1, 4e-3}) {
    const Vector6d u = random_vector<6>(random, size);
    const Matrix6d J = geometry::inverse_left_jacobian(u);
    for (int k = 0; k < 6; ++k) {
      const Vector6d step = 1e-6 * Vector6d::Unit(k);
      const Vector6d slope = (log(compose(geometry::exp(step), geometry::exp(u))) -
                              log(compose(geometry::exp(Vector6d(-step)), geometry::exp(u)))) /
                             2e-6;
      CHECK((slope - J.col(k)).norm() < 1e-8);
    }
  }
}

TEST_CASE("roll, pitch and yaw go there and back", "[geometry]") {
  Random random(14);
  for (int trial = 0; trial < 50; ++trial) {
    const Vector3d angles(uniform(random, -pi, pi), uniform(random, -pi / 2, pi / 2),
                          uniform(random, -pi, pi));
    const auto q = geometry::from_roll_pitch_yaw(angles[0], angles[1], angles[2]);
    CHECK(geometry::roll_pitch_yaw(q).isApprox(angles, 1e-9));
  }
  for (double pitch : {pi / 2, pi / 2 - 1e-9, -pi / 2, -pi / 2 + 1e-12}) {
    const auto q = geometry::from_roll_pitch_yaw(0.3, pitch, 0.5);
    const Vector3d angles = geometry::roll_pitch_yaw(q);
    CHECK(geometry::from_roll_pitch_yaw(angles[0], angles[1], angles[2]).angularDistance(q) < 1e-7);
  }
}

TEST_CASE("roll, pitch and yaw turn about the fixed axes x, y and z in this order", "[geometry]") {
  const Matrix3d turned = geometry::from_roll_pitch_yaw(pi / 2, 0, pi / 2).toRotationMatrix();
  CHECK((turned * Vector3d::UnitY() - Vector3d::UnitZ()).norm() < 1e-15);
  CHECK((turned * Vector3d::UnitX() - Vector3d::UnitY()).norm() < 1e-15);
  const Matrix3d pitched = geometry::from_roll_pitch_yaw(0, pi / 2, 0).toRotationMatrix();
  CHECK((pitched * Vector3d::UnitX() + Vector3d::UnitZ()).norm() < 1e-15);
}

TEST_CASE("compact coordinates go there and back", "[geometry]") {
  Random random(5);
  for (int trial = 0; trial < 50; ++trial) {
    SE3 a = random_se3(random);
    const Vector6d v = compact(a);
    CHECK(v.head<3>() == a.t);
    CHECK(matrix(geometry::from_compact(v)).isApprox(matrix(a), 1e-12));
    a.q.coeffs() *= -1;  // the same rotation
    CHECK(compact(a) == v);
  }
  Vector6d long_one;
  long_one << 1, 2, 3, 0, 0, 4;
  const SE3 half_turn = geometry::from_compact(long_one);
  CHECK(half_turn.q.coeffs() == Eigen::Vector4d(0, 0, 1, 0));
  CHECK(half_turn.t == Vector3d(1, 2, 3));
}

TEST_CASE("swapping puts the rotation first, and back", "[geometry]") {
  Random random(6);
  const Vector6d v = random_vector<6>(random);
  const Matrix6d m = random_information<6>(random);
  CHECK(geometry::swapped(v).head<3>() == v.tail<3>());
  CHECK(geometry::swapped(geometry::swapped(v)) == v);
  CHECK(geometry::swapped(geometry::swapped(m)) == m);
  CHECK(Vector6d(geometry::swapped(m) * geometry::swapped(v))
            .isApprox(geometry::swapped(Vector6d(m * v)), 1e-14));
}

TEST_CASE("motions and their numbers", "[geometry]") {
  const double numbers[] = {1, 2, 3, 0.1, 0.2, 0.3, 0.4};
  const SE3 a = geometry::se3(numbers);
  CHECK(a.t == Vector3d(1, 2, 3));
  CHECK(a.q.w() == 0.4);
  CHECK(a.q.vec() == Vector3d(0.1, 0.2, 0.3));
  CHECK(std::ranges::equal(numbers_of(a), numbers));
  CHECK(normalized(a).q.isApprox(a.q.normalized()));
  CHECK(normalized(a).t == a.t);
  double back[7] = {};
  set_se3(a, back);
  CHECK(std::ranges::equal(back, numbers));
  set_se2(geometry::se2(numbers + 1), back);
  CHECK(std::vector(back, back + 3) == std::vector{2.0, 3.0, 0.1});
}

TEST_CASE("a triangle is the upper one, row by row", "[geometry]") {
  std::array<double, 6> triangle{};
  std::iota(triangle.begin(), triangle.end(), 1.0);
  const Matrix3d expected{{1, 2, 3}, {2, 4, 5}, {3, 5, 6}};
  CHECK(geometry::symmetric<Matrix3d>(triangle) == expected);
  CHECK(geometry::symmetric<Eigen::MatrixXd>(triangle, 3) == expected);
  CHECK(geometry::symmetric<Eigen::MatrixXd>(triangle, 2) == Eigen::Matrix2d{{1, 2}, {2, 3}});
  CHECK(geometry::upper_triangle(expected) == triangle);
  CHECK(geometry::triangle_size(6) == 21);
  CHECK_FALSE(geometry::is_diagonal(triangle, 3));
  CHECK(geometry::is_diagonal(std::array{1.0, 0.0, 0.0, 2.0, 0.0, 3.0}, 3));
  CHECK_FALSE(geometry::is_diagonal(std::array{1.0, 0.0, 0.0, 2.0, 1e-300, 3.0}, 3));
}

TEST_CASE("uncertainty propagates to first order", "[geometry]") {
  Random random(15);
  for (int trial = 0; trial < 20; ++trial) {
    check_propagation<3>(geometry::UncertainSE2{random_se2(random), random_information<3>(random)},
                         geometry::UncertainSE2{random_se2(random), random_information<3>(random)});
    check_propagation<6>(geometry::UncertainSE3{random_se3(random), random_information<6>(random)},
                         geometry::UncertainSE3{random_se3(random), random_information<6>(random)});
  }
}

TEST_CASE("what is unknown stays unknown in a parallel sum", "[geometry]") {
  const Matrix3d a = Vector3d(4, 0, 3).asDiagonal();
  const Matrix3d b = Vector3d(4, 0, 0).asDiagonal();
  const Matrix3d expected = Vector3d(2, 0, 0).asDiagonal();
  CHECK((geometry::parallel_sum(a, b) - expected).norm() < 1e-12);
}
