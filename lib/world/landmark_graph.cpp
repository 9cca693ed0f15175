#include "lib/world/landmark_graph.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "lib/geometry/numbers.h"
#include "lib/geometry/triangle.h"
#include "lib/text/error.h"

namespace sg::world {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double degree = std::numbers::pi / 180;

// The camera in the robot's frame: z ahead, x to the right.
const Quaterniond optical(0.5, -0.5, 0.5, -0.5);  // w x y z

double principal_point(const Optics& optics) {
  return rounded(optics.focal * std::tan(optics.view / 2 * degree));
}

// A pose as the graph has it: type and frame depend on the sensor.
template <class Pose>
Pose true_pose(const LandmarkGraph& graph, Index k);
template <>
SE2 true_pose<SE2>(const LandmarkGraph& graph, Index k) {
  return graph.poses[k];
}
template <>
SE3 true_pose<SE3>(const LandmarkGraph& graph, Index k) {
  const SE3 robot = geometry::in_space(graph.poses[k]);
  return graph.sensor == Sensor::mono ? compose(robot, {optical, Vector3d::Zero()}) : robot;
}

template <class Pose>
using Point = decltype(geometry::act(Pose{}, {}));
template <class Pose>
Point<Pose> true_landmark(const LandmarkGraph& graph, Index l) {
  return graph.landmarks[l].head<Point<Pose>::SizeAtCompileTime>();
}

struct Observation {
  int size;
  std::array<double, 3> value;
  std::array<double, 3> sigma;
};

// What the sensor of a pose measures of a point of that pose's frame.
Observation observe(const LandmarkGraph& graph, const Vector2d& point) {
  const Optics& optics = graph.optics;
  if (graph.sensor == Sensor::bearing) {
    return {1, {std::atan2(point.y(), point.x())}, {optics.bearing_noise}};
  }
  return {2, {point.x(), point.y()}, {optics.point_noise, optics.point_noise}};
}
Observation observe(const LandmarkGraph& graph, const Vector3d& point) {
  const Optics& optics = graph.optics;
  if (graph.sensor == Sensor::xyz) {
    const double sigma = optics.point_noise;
    return {3, {point.x(), point.y(), point.z()}, {sigma, sigma, sigma}};
  }
  const Vector3d p = graph.sensor == Sensor::mono ? point : Vector3d(optical.conjugate() * point);
  const double c = principal_point(optics), depth = p.z();
  const double u = optics.focal * p.x() / depth + c, v = optics.focal * p.y() / depth + c;
  const double sigma = optics.pixel_noise, inverse = sigma / (optics.focal * optics.baseline);
  return {graph.sensor == Sensor::mono ? 2 : 3, {u, v, 1 / depth}, {sigma, sigma, inverse}};
}

void disturb(Observation& observation, Sensor sensor, Random& random) {
  for (int i = 0; i < observation.size; ++i) {
    observation.value[i] += normal(random, observation.sigma[i]);
  }
  if (sensor == Sensor::bearing) observation.value[0] = geometry::wrap(observation.value[0]);
}

graph::EdgeTag observation_type(Sensor sensor) {
  return std::array{graph::EdgeTag::project_xyz2uv, graph::EdgeTag::se3_trackxyz,
                    graph::EdgeTag::project_disparity, graph::EdgeTag::se2_xy,
                    graph::EdgeTag::bearing_se2_xy}[static_cast<std::size_t>(sensor)];
}

void observation_line(const LandmarkGraph& graph, Index pose, Index landmark,
                      const Observation& observation, Out& out) {
  const Id point = Id{landmark} + static_cast<Id>(graph.poses.size());
  const bool point_first = graph.sensor == Sensor::mono;
  begin_line(out, graph::name(observation_type(graph.sensor)),
             {point_first ? point : pose, point_first ? pose : point});
  if (!planar(graph.sensor)) number(out, 0);  // the parameter's id
  std::array<double, 3> information{};
  for (int i = 0; i < observation.size; ++i) {
    number(out, observation.value[i]);
    information[i] = 1 / (observation.sigma[i] * observation.sigma[i]);
  }
  diagonal_information(out, information.data(), observation.size);
  end_line(out);
}

void parameter_line(const LandmarkGraph& graph, Out& out) {
  if (planar(graph.sensor)) return;
  const Optics& optics = graph.optics;
  const double f = optics.focal, c = principal_point(optics);
  switch (graph.sensor) {
    case Sensor::mono:
      begin_line(out, graph::name(graph::ParamTag::pinhole), {0});
      for (double x : {f, c, c, optics.baseline}) number(out, x);
      break;
    case Sensor::disparity:
      begin_line(out, graph::name(graph::ParamTag::camera), {0});
      numbers(out, SE3{optical, Vector3d::Zero()});
      for (double x : {f, f, c, c}) number(out, x);
      break;
    default:
      begin_line(out, graph::name(graph::ParamTag::se3_offset), {0});
      numbers(out, SE3{});
  }
  out.buffer += ' ';  // g2o takes a camera's line that ends in a digit for a broken one
  end_line(out);
}

void pose_line(const LandmarkGraph&, Index k, const SE2& pose, Out& out) {
  vertex_line(out, k, pose);
}
void pose_line(const LandmarkGraph& graph, Index k, const SE3& pose, Out& out) {
  if (graph.sensor != Sensor::mono) return vertex_line(out, k, pose);
  begin_line(out, graph::name(graph::VertexTag::expmap), {k});
  numbers(out, pose);
  end_line(out);
}

// The information of EDGE_SE3:EXPMAP that ends in camera pose `end`: Ad(end)^-T S^-1 Ad(end)^-1 with
// rotation and translation swapped, since its error has the rotation first.
Matrix6d world_information(const PoseNoise& noise, const SE3& end) {
  Vector6d local;
  local.head<3>().setConstant(1 / (noise.translation * noise.translation));
  local.tail<3>().setConstant(1 / (noise.rotation * noise.rotation));
  const Matrix6d back = adjoint(inverse(end));
  return geometry::swapped(Matrix6d(back.transpose() * local.asDiagonal() * back));
}

void odometry_line(const LandmarkGraph& graph, Index k, const SE2& z, Out& out) {
  edge_line(out, k - 1, k, z, graph.odometry_noise);
}
void odometry_line(const LandmarkGraph& graph, Index k, const SE3& z, Out& out) {
  if (graph.sensor != Sensor::mono) return edge_line(out, k - 1, k, z, graph.odometry_noise);
  begin_line(out, graph::name(graph::EdgeTag::expmap), {k - 1, k});
  numbers(out, z);
  const Matrix6d information = world_information(graph.odometry_noise, true_pose<SE3>(graph, k));
  const double nothing = 1e-12 * information.diagonal().maxCoeff();  // rounding, not information
  for (const double x : geometry::upper_triangle(information)) {
    significant(out, std::abs(x) < nothing ? 0 : x);
  }
  end_line(out);
}

// For every landmark the pose in the middle of its observations.
std::vector<Index> middle_poses(const LandmarkGraph& graph) {
  std::vector<Index> left(graph.landmarks.size()), middle(graph.landmarks.size());
  for (const Index l : graph.seen.items) ++left[l];
  for (Index& count : left) count = count / 2 + 1;
  for (Index k = 0; k < static_cast<Index>(graph.poses.size()); ++k) {
    for (const Index l : graph.seen[k]) {
      if (--left[l] == 0) middle[l] = k;
    }
  }
  return middle;
}

// Where a landmark stands from a pose: a direction of the world, of unit length.
Vector3d direction(const LandmarkGraph& graph, Index pose, Index landmark) {
  const SE2& from = graph.poses[pose];
  Vector3d ray = graph.landmarks[landmark] - Vector3d(from.x, from.y, 0);
  if (planar(graph.sensor)) ray.z() = 0;
  return ray.normalized();
}

std::vector<bool> triangulated(const LandmarkGraph& graph, const Triangulation& wanted) {
  const bool direction_only = graph.sensor == Sensor::mono || graph.sensor == Sensor::bearing;
  const double cosine = direction_only ? std::cos(wanted.parallax * degree) : 1;
  std::vector<Index> count(graph.landmarks.size());
  std::vector<Vector3d> first(graph.landmarks.size());
  std::vector<bool> parallax(graph.landmarks.size());
  for (Index k = 0; k < static_cast<Index>(graph.poses.size()); ++k) {
    for (const Index l : graph.seen[k]) {
      const Vector3d now = direction(graph, k, l);
      if (count[l]++ == 0) first[l] = now;
      if (now.dot(first[l]) <= cosine) parallax[l] = true;
    }
  }
  for (std::size_t l = 0; l < count.size(); ++l) {
    parallax[l] = (parallax[l] || !direction_only) && count[l] >= wanted.observations;
  }
  return parallax;
}

template <class Pose>
void write_vertices(const LandmarkGraph& graph, const Odometry<Pose>& motions, Out& out) {
  const auto n = static_cast<Index>(graph.poses.size());
  std::vector<Pose> estimate;
  estimate.reserve(n);
  for_each_estimate(n, motions, graph.guess, [&](Index k, const Pose& pose) {
    pose_line(graph, k, pose, out);
    estimate.push_back(pose);
  });
  Random random = random_stream(graph.seed, Stream::estimates);
  const std::vector<Index> middle = middle_poses(graph);
  for (Index l = 0; l < static_cast<Index>(graph.landmarks.size()); ++l) {
    Point<Pose> point = true_landmark<Pose>(graph, l);
    if (motions.copy == Copy::noisy) {
      point =
          geometry::act(estimate[middle[l]],
                        geometry::act(geometry::inverse(true_pose<Pose>(graph, middle[l])), point));
      for (double& x : point) x += normal(random, graph.guess_noise);
    }
    begin_line(
        out, graph::name(planar(graph.sensor) ? graph::VertexTag::xy : graph::VertexTag::trackxyz),
        {Id{n} + l});
    for (const double x : point) number(out, x);
    end_line(out);
  }
}

// Without noise.
template <class Pose>
Observation observe(const LandmarkGraph& graph, const Pose& world, Index l) {
  return observe(graph, geometry::act(world, true_landmark<Pose>(graph, l)));
}

template <class Pose>
double separation_of(const LandmarkGraph& graph, Index pose, Index a, Index b) {
  const Pose world = geometry::inverse(true_pose<Pose>(graph, pose));
  const Observation of_a = observe(graph, world, a), of_b = observe(graph, world, b);
  double sum = 0;
  for (int i = 0; i < of_a.size; ++i) {
    double difference = of_a.value[i] - of_b.value[i];
    if (graph.sensor == Sensor::bearing) difference = geometry::wrap(difference);
    sum += std::pow(difference / of_a.sigma[i], 2);
  }
  return std::sqrt(sum);
}

template <class Pose>
void write_edges(const LandmarkGraph& graph, Odometry<Pose> motions, Out& out) {
  Random random = random_stream(graph.seed, Stream::measurements);
  Random false_random = random_stream(graph.seed, Stream::false_measurements);
  for (Index k = 0; k < static_cast<Index>(graph.poses.size()); ++k) {
    if (k > 0) odometry_line(graph, k, measured_motion(motions, k), out);
    const Pose world = geometry::inverse(true_pose<Pose>(graph, k));
    for (const Index l : graph.seen[k]) {
      Observation observation = observe(graph, world, l);
      if (motions.copy == Copy::noisy) disturb(observation, graph.sensor, random);
      observation_line(graph, k, l, observation, out);
    }
    if (graph.mistaken.size() == 0) continue;
    for (const auto& [landmark, like] : graph.mistaken[k]) {
      Observation observation = observe(graph, world, like);
      disturb(observation, graph.sensor, false_random);
      begin_false(motions.copy, out);
      observation_line(graph, k, landmark, observation, out);
    }
  }
}

template <class Pose>
void write(const LandmarkGraph& graph, Copy copy, Out& out) {
  const auto truth = [&graph](Index k) { return true_pose<Pose>(graph, k); };
  const auto motions = odometry<Pose>(truth, graph.odometry_noise, copy, graph.seed);
  parameter_line(graph, out);
  write_vertices(graph, motions, out);
  write_edges(graph, motions, out);
}

}  // namespace

bool sees(const Optics& optics, Sensor sensor, const Vector3d& point) {
  const Vector3d p(point.x(), point.y(), planar(sensor) ? 0 : point.z());
  if (p.norm() > optics.range || p.norm() < optics.near) return false;
  if (camera(sensor) && p.x() < optics.near) return false;
  const double ahead = camera(sensor) ? p.x() : std::hypot(p.x(), p.y());
  const double across = std::atan2(p.y(), p.x()), up = std::atan2(p.z(), ahead);
  return std::max(std::abs(across), std::abs(up)) <= optics.view / 2 * degree;
}

double separation(const LandmarkGraph& graph, Index pose, Index a, Index b) {
  return planar(graph.sensor) ? separation_of<SE2>(graph, pose, a, b)
                              : separation_of<SE3>(graph, pose, a, b);
}

void keep_triangulated(LandmarkGraph& graph, const Triangulation& wanted) {
  const std::vector<bool> keep = triangulated(graph, wanted);
  std::vector<Index> number(graph.landmarks.size(), -1);
  std::vector<Vector3d> landmarks;
  graph::Lists<> seen;
  for (Index k = 0; k < graph.seen.size(); ++k) {
    for (const Index l : graph.seen[k]) {
      if (!keep[l]) continue;
      if (number[l] < 0) {
        number[l] = static_cast<Index>(landmarks.size());
        landmarks.push_back(graph.landmarks[l]);
      }
      seen.items.push_back(number[l]);
    }
    seen.close();
  }
  graph.landmarks = std::move(landmarks);
  graph.seen = std::move(seen);
}

void write_graph(const LandmarkGraph& graph, Copy copy, Out& out) {
  if (planar(graph.sensor)) {
    write<SE2>(graph, copy, out);
  } else {
    write<SE3>(graph, copy, out);
  }
}

}  // namespace sg::world
