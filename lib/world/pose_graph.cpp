#include "lib/world/pose_graph.h"

namespace sg::world {
namespace {

template <class Pose>
void write_edges(const PoseGraph<Pose>& graph, Copy copy, Odometry<Pose> odometry, Out& out) {
  Random random = random_stream(graph.seed, Stream::measurements);
  Random false_random = random_stream(graph.seed, Stream::false_measurements);
  auto loop = graph.loops.begin();
  auto false_loop = graph.false_loops.begin();
  for (Index k = 1; k < graph.poses; ++k) {
    edge_line(out, k - 1, k, measured_motion(odometry, k), graph.noise);
    for (; loop != graph.loops.end() && loop->to == k; ++loop) {
      const Pose z = measured(graph, *loop);
      edge_line(out, loop->from, k,
                copy == Copy::exact ? rounded(z) : disturbed(z, graph.noise, random), graph.noise);
    }
    for (; false_loop != graph.false_loops.end() && false_loop->to == k; ++false_loop) {
      const Pose z =
          disturbed(measured(graph, graph.loops[false_loop->like]), graph.noise, false_random);
      begin_false(copy, out);
      edge_line(out, false_loop->from, k, z, graph.noise);
    }
  }
}

template <class Pose>
void write(const PoseGraph<Pose>& graph, Copy copy, Out& out) {
  const auto motions = odometry(graph.truth, graph.noise, copy, graph.seed);
  for_each_estimate(graph.poses, motions, graph.guess,
                    [&](Index k, const Pose& pose) { vertex_line(out, k, pose); });
  write_edges(graph, copy, motions, out);
}

}  // namespace

void write_graph(const PoseGraph<SE2>& graph, Copy copy, Out& out) {
  write(graph, copy, out);
}
void write_graph(const PoseGraph<SE3>& graph, Copy copy, Out& out) {
  write(graph, copy, out);
}

}  // namespace sg::world
