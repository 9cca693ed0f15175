#include "lib/solve/isam2_keyframes.h"

#include <algorithm>
#include <array>
#include <limits>

#include "lib/solve/isam2_steps.h"

namespace sg::solve {
namespace {

// And stays.
bool is_there(const Isam2Replay& replay, Index v) {
  const Index j = variable_of(replay, v);
  return j >= 0 && replay.isam.tree.variable_clique[j] >= 0 && !replay.isam.leaving[j];
}

// Whether edge e measures one variable pose from another.
bool is_link(const Isam2Replay& replay, Index e) {
  const factor::Problem& problem = *replay.problem;
  return e < problem.graph->edges() && is_relative_pose(*problem.graph, e) &&
         problem.variables.pattern.rows[e].size() == 2;
}

Index other_end(std::span<const Index> ends, Index v) {
  return ends[0] == v ? ends[1] : ends[0];
}

// What edge e measures from vertex v on.
RelativePose measured_from(const Isam2Replay& replay, Index e, Index v) {
  const RelativePose z = relative_pose(*replay.problem, e);
  return replay.problem->graph->edge(e)[0] == v ? z : inverse(z);
}

Index landmark_of(const Isam2Replay& replay, Index e) {
  if (e >= replay.problem->graph->edges()) return -1;
  for (Index v : replay.problem->graph->edge(e)) {
    if (replay.problem->graph->role(v) == graph::Role::landmark) return v;
  }
  return -1;
}

// The edge that ties pose v best to a neighbour on its path: the nearest before it, or behind it, that an edge leads to. -1
// where none does. A closure would do as a way, too; but then the path, which is worth more, would lead along it twice.
Index best_link(const Isam2Replay& replay, Index v, std::span<const Index> rows) {
  const Index own = replay.poses.index[v];
  const auto end_of = [&](Index r) {
    return replay.poses.index[other_end(replay.problem->graph->edge(r), v)];
  };
  const auto leads = [&](Index r) {
    return is_link(replay, r) && is_there(replay, other_end(replay.problem->graph->edge(r), v));
  };
  Index before = -1, behind = std::numeric_limits<Index>::max();
  for (Index r : rows) {
    if (!leads(r)) continue;
    const Index end = end_of(r);
    if (end < own) before = std::max(before, end);
    if (end > own) behind = std::min(behind, end);
  }
  Index best = -1;
  double least = std::numeric_limits<double>::infinity();
  for (Index r : rows) {
    if (!leads(r) || (end_of(r) != before && end_of(r) != behind)) continue;
    const double variance = solve::variance(relative_pose(*replay.problem, r));
    if (variance < least) {
      least = variance;
      best = r;
    }
  }
  return best;
}

// Row r is one of pose `to` from now on, and none of pose `from`.
void change_row(Isam2Replay& replay, Index r, Index from, Index to) {
  Isam2& isam = replay.isam;
  if (isam.changed_rows.empty()) {
    for (Index j = 0; j < isam.columns.size(); ++j)
      isam.changed_rows.emplace_back(isam.columns[j].begin(), isam.columns[j].end());
  }
  std::erase(isam.changed_rows[variable_of(replay, from)], r);
  isam.changed_rows[variable_of(replay, to)].push_back(r);
}

bool holds(const Isam2& isam, const Isam2Clique& clique, Index j) {
  return std::ranges::count(frontals_of(isam.tree, clique), j) > 0 ||
         std::ranges::count(separators_of(isam.tree, clique), j) > 0;
}

// Of the cliques from c down that hold j; heir: variable that takes its place in those that do not hold it, -1 for none.
double freed_at(const Isam2& isam, Index c, Index j, bool frontal, Index heir) {
  const Isam2Clique& clique = isam.tree.cliques[c];
  const double d = pattern_of(isam).dim[j], f = clique.f, n = clique.f + clique.s;
  double sum = 0;
  if (heir < 0 || holds(isam, clique, heir))
    sum = f * n * n - (frontal ? f - d : f) * (n - d) * (n - d);
  for (Index child = clique.first_child; child >= 0; child = isam.tree.cliques[child].next) {
    const Isam2Clique& below = isam.tree.cliques[child];
    if (!is_prior(below) && std::ranges::count(separators_of(isam.tree, below), j) > 0)
      sum += freed_at(isam, child, j, false, heir);
  }
  return sum;
}

}  // namespace

Keyframes::Way way_to(Keyframes& keyframes, Index k) {
  Keyframes::Way& way = keyframes.ways.at(k);
  if (is_composed(keyframes, way.host)) {
    const Keyframes::Way above = way_to(keyframes, way.host);
    way = {above.host, compose(above.from_host, way.from_host)};
  }
  return way;
}

bool move_edge(Isam2Replay& replay, Keyframes& keyframes, Index e) {
  if (!is_link(replay, e)) return false;
  const auto ends = replay.problem->graph->edge(e);
  std::array<Index, 2> to{ends[0], ends[1]};
  RelativePose z = relative_pose(*replay.problem, e);
  for (int i = 0; i < 2; ++i) {
    const Index k = replay.poses.index[to[i]];
    if (!is_composed(keyframes, k)) continue;
    const Keyframes::Way way = way_to(keyframes, k);
    to[i] = replay.poses.pose[way.host];
    if (!is_there(replay, to[i])) return false;
    z = i == 0 ? compose(way.from_host, z) : compose(z, inverse(way.from_host));
  }
  if (to[0] == to[1]) return false;
  for (int i = 0; i < 2; ++i) {
    if (to[i] != ends[i]) change_row(replay, e, ends[i], to[i]);
  }
  rewrite(*keyframes.own, e, to[0], to[1], z);
  ++keyframes.moved;
  return true;
}

bool can_be_composed(const Isam2Replay& replay, Index k, int min_obs) {
  const Isam2& isam = replay.isam;
  const Index v = replay.poses.pose[k], j = variable_of(replay, v);
  if (j < 0 || j == replay.problem->held || isam.tree.variable_clique[j] < 0 || isam.pinned[j])
    return false;
  bool tied = false;
  for (Index r : rows_of(isam, j)) {
    if (enters(isam, r)) return false;
    if (isam.tree.row_clique[r] < 0) continue;
    if (is_link(replay, r)) {
      tied = tied || is_there(replay, other_end(replay.problem->graph->edge(r), v));
      continue;
    }
    const Index landmark = landmark_of(replay, r);
    if (landmark < 0) return false;
    const Index l = variable_of(replay, landmark);
    if (l < 0 || !isam.pinned[l]) continue;
    if (static_cast<int>(rows_in(isam, l).size()) <= min_obs) return false;
  }
  return tied;
}

Host host_of(const Isam2Replay& replay, Index k) {
  const Index v = replay.poses.pose[k];
  const Index link = best_link(replay, v, rows_in(replay.isam, variable_of(replay, v)));
  return {variable_of(replay, other_end(replay.problem->graph->edge(link), v)),
          variance(relative_pose(*replay.problem, link))};
}

std::vector<Index> compose_away(Isam2Replay& replay, Keyframes& keyframes, Index k) {
  Isam2& isam = replay.isam;
  const Index v = replay.poses.pose[k], j = variable_of(replay, v);
  const std::vector<Index> rows = rows_in(isam, j);
  const Index link = best_link(replay, v, rows);
  const Index host = other_end(replay.problem->graph->edge(link), v);
  const Keyframes::Way way{replay.poses.index[host], measured_from(replay, link, host)};
  std::vector<Index> landmarks;
  for (Index r : rows) {
    const auto ends = replay.problem->graph->edge(r);
    if (!is_link(replay, r) || other_end(ends, v) == host) {
      if (const Index landmark = landmark_of(replay, r); landmark >= 0)
        landmarks.push_back(landmark);
      if (r != link) ++keyframes.returned;
      take_row_out(isam, r);
      continue;
    }
    const Index to = other_end(ends, v);
    rewrite(*keyframes.own, r, host, to, compose(way.from_host, measured_from(replay, r, v)));
    change_row(replay, r, v, host);
    linearize_factor(isam, r);
    mark_to_root(isam, isam.tree.row_clique[r]);
    for (Index end : {host, to})
      mark_to_root(isam, isam.tree.variable_clique[variable_of(replay, end)]);
    ++keyframes.moved;
  }
  take_variable_out(isam, j);
  keyframes.stands_for[way.host] += keyframes.stands_for[k];
  keyframes.spread[way.host] =
      std::max(keyframes.spread[way.host], keyframes.spread[k] + variance(way.from_host));
  keyframes.ways.emplace(k, way);
  ++keyframes.composed;
  std::ranges::sort(landmarks);
  landmarks.erase(std::unique(landmarks.begin(), landmarks.end()), landmarks.end());
  return landmarks;
}

double freed_by(const Isam2& isam, Index j, Index heir) {
  const Index c = isam.tree.variable_clique[j];
  return c < 0 ? 0 : freed_at(isam, c, j, true, heir);
}

namespace {

// The link between poses a and b (pose indices) that says most, from a on.
std::optional<RelativePose> link_between(const Isam2Replay& replay, Index a, Index b) {
  const Index from = replay.poses.pose[a], to = replay.poses.pose[b];
  std::optional<RelativePose> best;
  for (Index r : rows_in(replay.isam, variable_of(replay, from))) {
    if (!is_link(replay, r) || other_end(replay.problem->graph->edge(r), from) != to) continue;
    const RelativePose z = measured_from(replay, r, from);
    if (!best || variance(z) < variance(*best)) best = z;
  }
  return best;
}

}  // namespace

void place_composed(Isam2Replay& replay, Keyframes& keyframes) {
  const factor::Problem& problem = *replay.problem;
  double* const x = replay.isam.estimate.data();
  const auto at = [&](Index k) { return problem.value_at[replay.poses.pose[k]]; };
  std::vector<Index> composed;
  for (const auto& [k, way] : keyframes.ways) composed.push_back(k);
  std::ranges::sort(composed);
  for (std::size_t i = 0; i < composed.size();) {
    // A stretch of them, and the poses on either side.
    const Index before = composed[i] - 1;
    std::size_t end = i;
    while (end < composed.size() && composed[end] - composed[i] == static_cast<Index>(end - i))
      ++end;
    const Index behind = composed[end - 1] + 1;
    const bool between = before >= 0 && behind < static_cast<Index>(replay.poses.pose.size()) &&
                         is_there(replay, replay.poses.pose[before]) &&
                         is_there(replay, replay.poses.pose[behind]);
    const std::optional<RelativePose> along =
        between ? link_between(replay, before, behind) : std::nullopt;
    for (; i < end; ++i) {
      const Keyframes::Way way = way_to(keyframes, composed[i]);
      double* const pose = x + at(composed[i]);
      place(way.from_host, x + at(way.host), pose);
      if (!along || (way.host != before && way.host != behind)) continue;
      // The same from the other side, by the share of the path that is behind it.
      const bool first = way.host == before;
      const RelativePose back = first ? inverse(*along) : *along;
      std::array<double, 16> other{};
      std::copy_n(pose, problem.value_at[replay.poses.pose[composed[i]] + 1] - at(composed[i]),
                  other.begin());
      place(compose(back, way.from_host), x + at(first ? behind : before), other.data());
      const double share = variance(way.from_host) / variance(*along);
      if (share < 1)
        blend(problem.space[replay.poses.pose[composed[i]]], other.data(), share, pose);
    }
  }
}

}  // namespace sg::solve
