// How far a trajectory is from a reference: the measures of the TUM benchmark (Sturm et al., A
// benchmark for the evaluation of RGB-D SLAM systems, 2012) with the definitions that the tool evo
// documents. Both are root mean squares, in the reference's unit of length.
#pragma once

#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "lib/geometry/se3.h"
#include "lib/graph/graph.h"

namespace sg::score {

struct Trajectory {
  std::vector<Id> id;     // ascending
  std::vector<SE3> pose;  // side by side with them: camera or robot to world
};

// The poses of a graph at the estimates of its file, by id; poses of the plane lie in z = 0. Of an
// edges-only file: as composed along its edges. Throws an input Error for poses of another kind.
Trajectory trajectory(const Graph& graph);

// The pose that these numbers of a VERTEX line of this space are; nothing where a trajectory has none of that kind.
std::optional<SE3> pose_of(graph::Space space, const std::vector<double>& numbers);

// Whether no pose leaves z = 0, nor turns about another axis than z.
bool is_planar(const Trajectory& trajectory);

enum class Alignment : std::uint8_t { none, se, sim };
// The kind of that name, if there is one.
std::optional<Alignment> alignment(std::string_view name);

// Poses that both have, by id: their places in the one and in the other.
std::vector<std::pair<std::size_t, std::size_t>> matched(const Trajectory& a, const Trajectory& b);

// The estimate as trajectory_error moves it before it measures. Without a matched pose it stays.
Trajectory aligned(Trajectory estimate, const Trajectory& reference, Alignment alignment);

struct TrajectoryError {
  std::size_t matched = 0;    // poses that both have
  std::optional<double> ate;  // nothing without a matched pose
  std::optional<double> rpe;  // nothing with less than two
};

// Poses are matched by id. The estimate is moved onto the reference by the rigid motion (se) or
// similarity (sim) that minimizes the squared distances of matched positions (Umeyama 1991; in the
// plane where all positions lie in z = 0), or stays (none).
//   ate: of the distances between matched positions;
//   rpe: of |trans((Q_i^-1 Q_i+1)^-1 (P_i^-1 P_i+1))| over consecutive matched poses, Q of the
//        reference and P of the aligned estimate. Only the scale of the alignment matters to it.
TrajectoryError trajectory_error(const Trajectory& estimate, const Trajectory& reference,
                                 Alignment alignment);

}  // namespace sg::score
