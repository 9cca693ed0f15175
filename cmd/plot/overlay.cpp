#include "cmd/plot/overlay.h"

#include "lib/text/error.h"

namespace sg::plot {

Overlay overlay(const Graph& graph, const std::string& name, score::Trajectory other) {
  const score::Trajectory own = score::trajectory(graph);
  Overlay result{name, {}, {}, {}, score::trajectory_error(own, other, score::Alignment::se)};
  if (result.error.matched == 0)
    throw text::input_error(name, 0,
                            "no pose in common with " + graph.file + " (poses are matched by id)");
  const auto pairs = score::matched(own, other);
  other = score::aligned(std::move(other), own, score::Alignment::se);
  for (const SE3& pose : other.pose) {
    const auto place = graph.vertices() + static_cast<Index>(result.positions.size());
    if (!result.positions.empty()) result.path.push_back({place - 1, place});
    result.positions.push_back({pose.t.x(), pose.t.y(), pose.t.z()});
  }
  for (const auto& [k, of_other] : pairs)
    result.whiskers.push_back(
        {*graph::find_vertex(graph, own.id[k]), graph.vertices() + static_cast<Index>(of_other)});
  return result;
}

}  // namespace sg::plot
