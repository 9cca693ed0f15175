// A world of landmarks: a robot moves in the horizontal plane, takes odometry from each pose to the
// next, and observes landmarks with one sensor.
//
// Frames. The robot's frame has x ahead, y to the left, z up; the camera sits in the robot's origin
// and looks ahead: x to the right, y down, z ahead.
//
//   sensor      vertices                              observation                           of
//   mono        VERTEX_SE3:EXPMAP, VERTEX_TRACKXYZ    EDGE_PROJECT_XYZ2UV:EXPMAP u v        camera
//   xyz         VERTEX_SE3:QUAT, VERTEX_TRACKXYZ      EDGE_SE3_TRACKXYZ x y z               robot
//   disparity   VERTEX_SE3:QUAT, VERTEX_TRACKXYZ      EDGE_PROJECT_DISPARITY u v 1/depth    camera
//   xy          VERTEX_SE2, VERTEX_XY                 EDGE_SE2_XY x y                       robot
//   bearing     VERTEX_SE2, VERTEX_XY                 EDGE_BEARING_SE2_XY angle             robot
//
// The poses of `mono` are those of the camera, all others those of the robot. Conventions are g2o's;
// what it calls disparity is the inverse depth. g2o knows the point of EDGE_PROJECT_XYZ2UV:EXPMAP as
// VERTEX_TRACKXYZ since it merged its two point types, and skips the older name VERTEX_XYZ.
//
// EDGE_SE3:EXPMAP measures its error in the world frame: e = log(T_b^-1 z^-1 T_a) with T the world
// in the camera's frame, rotation first. Noise of covariance S in the camera's own frame there has
// the covariance Ad(X) S Ad(X)^T, X = T_b^-1 the pose of camera b; its inverse is the information
// that is written, so that it claims what was drawn.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "lib/graph/lists.h"
#include "lib/world/odometry.h"

namespace sg::world {

enum class Sensor { mono, xyz, disparity, xy, bearing };
constexpr bool planar(Sensor sensor) {
  return sensor == Sensor::xy || sensor == Sensor::bearing;
}
constexpr bool camera(Sensor sensor) {
  return sensor == Sensor::mono || sensor == Sensor::disparity;
}

// What of the world a sensor sees, and how well.
struct Optics {
  double range = 25;             // metres
  double near = 1;               // metres ahead, below which nothing is seen: images blow up there
  double view = 90;              // degrees across and, in space, from top to bottom
  double focal = 320;            // pixels
  double baseline = 0.5;         // metres, of the stereo pair
  double pixel_noise = 1;        // standard deviation in pixels, of each image
  double point_noise = 0.1;      // metres along each axis, of xyz and xy
  double bearing_noise = 0.003;  // radians
};

// Whether the sensor of a robot sees a point of the robot's frame.
bool sees(const Optics& optics, Sensor sensor, const Eigen::Vector3d& point);

// A pose's observation of one landmark, taken for that of another (outliers.h).
struct FalseSight {
  Index landmark;  // which it is said to be
  Index like;      // which it is
};

struct LandmarkGraph {
  Sensor sensor = Sensor::mono;
  Optics optics;
  std::vector<SE2> poses;                  // true ones, of the robot
  std::vector<Eigen::Vector3d> landmarks;  // true ones; a planar sensor ignores z
  graph::Lists<> seen;                     // landmarks that each pose observes
  graph::Lists<FalseSight> mistaken;       // false observations of each pose, or no list at all
  PoseNoise odometry_noise{};
  double guess_noise = 0.1;  // metres along each axis, of landmark estimates
  Guess guess = Guess::odometry;
  std::uint64_t seed = 0;
};

// The graph of a world before anything is in it: the sensor, its noise and the seed, which every world
// of landmarks has under these names.
template <class World>
LandmarkGraph begin_landmark_graph(const World& world) {
  LandmarkGraph graph;
  graph.sensor = world.sensor;
  graph.optics = world.optics;
  graph.odometry_noise = world.odometry_noise;
  graph.guess_noise = world.guess_noise;
  graph.guess = world.guess;
  graph.seed = world.seed;
  return graph;
}

// How far apart the sensor of a pose sees two landmarks: standard deviations of its noise.
double separation(const LandmarkGraph& graph, Index pose, Index a, Index b);

// What makes a landmark worth having: a direction alone, as mono and bearing measure it, determines
// no point, and directions that hardly differ let Gauss-Newton diverge.
struct Triangulation {
  Index observations = 3;  // at least so many, 1 or more
  double parallax = 1;     // degrees by which some observation's direction differs from the first
                           // one's; counts for mono and bearing only
};

// Leaves out the other landmarks, and numbers those that stay by their first observation.
void keep_triangulated(LandmarkGraph& graph, const Triangulation& wanted);

// The parameter line of the sensor; poses 0 .. n-1; landmarks n, n+1, ...; then with every pose its
// odometry and its observations, the false ones last (comments in the exact copy, odometry.h). The estimate of a landmark lies where the pose in the middle of
// its observations, by its own estimate, sees it, plus noise. Does not flush.
void write_graph(const LandmarkGraph& graph, Copy copy, Out& out);

}  // namespace sg::world
