#include "lib/prune/keyframes.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "lib/text/error.h"

namespace sg::prune {
namespace {

Index pose_count(const graph::PoseIndex& poses) {
  return static_cast<Index>(poses.pose.size());
}

// Nearest keyframe of every pose within its segment, the earlier of two equally near.
std::vector<Index> nearest_keyframes(const graph::Lists<>& odometry,
                                     const std::vector<bool>& keyframe) {
  const auto n = static_cast<Index>(keyframe.size());
  std::vector<Index> nearest(n);
  for (Index k = 0, last = 0; k < n; ++k) {
    if (keyframe[k]) last = k;
    nearest[k] = last;
  }
  for (Index k = n - 2, next = n - 1; k >= 0; --k) {
    if (odometry[k + 1].empty()) next = -1;  // the segment ends with k
    if (keyframe[k + 1] && !odometry[k + 1].empty()) next = k + 1;
    if (next >= 0 && keyframe[next] && next - k < k - nearest[k]) nearest[k] = next;
  }
  return nearest;
}

bool is_keyframe(const Keyframing& kf, Index k) {
  return kf.nearest[k] == k;
}

Index host_of(const Keyframing& kf, Index k) {
  return kf.host[kf.nearest[k]];
}

bool touches_dropped(const Keyframing& kf, Index e) {
  const auto ends = kf.graph.edge(e);
  return std::any_of(ends.begin(), ends.end(), [&](Index v) { return kf.removal.vertex[v]; });
}

// The odometry from keyframe a to keyframe b becomes one edge, in the place of its last line: there
// both poses have been defined, since their own odometry stands no later.
void compose_odometry(Keyframing& kf, Index a, Index b) {
  Index carrier = -1;
  for (Index k = a + 1; k <= b; ++k) {
    require_composable(kf.graph, kf.odometry, k);
    for (Index e : kf.odometry[k]) {
      kf.removal.edge[e] = true;
      carrier = std::max(carrier, e);
    }
  }
  kf.removal.edge[carrier] = false;
  kf.rewritten[carrier] = true;
  kf.composed[carrier] = true;
}

bool is_merged(const Keyframing& kf, Index k) {
  return kf.host[k] != k;
}

void settle_odometry(Keyframing& kf) {
  const Index n = pose_count(kf.poses);
  Index last = 0;  // keyframe
  for (Index k = 1; k < n; ++k) {
    if (!is_keyframe(kf, k)) continue;
    const bool changed = k > last + 1 || is_merged(kf, last) || is_merged(kf, k);
    const bool falls_together =
        kf.host[last] == kf.host[k];  // and goes, as what is not composed does
    if (!kf.odometry[k].empty() && changed && !falls_together) compose_odometry(kf, last, k);
    last = k;
  }
}

// A loop closure between other poses than keyframes; false where its ends fall together.
bool move_loop(Keyframing& kf, Index e) {
  const auto ends = kf.graph.edge(e);
  if (host_of(kf, kf.poses.index[ends[0]]) == host_of(kf, kf.poses.index[ends[1]])) {
    ++kf.collapsed_loops;
    return false;
  }
  if (!is_motion(kf.graph.edge_tag(e))) {
    throw graph::error_at(kf.graph, kf.graph.edge_line[e],
                          "cannot move a loop closure of type " + kf.graph.type_of_edge(e).tag +
                              " to keyframes (--loops drop leaves them out)");
  }
  kf.rewritten[e] = true;
  return true;
}

// Edges of three and more vertices that measure a motion cannot be composed, nor simply dropped.
void refuse_motion_of_many(const Keyframing& kf, Index e) {
  Index first = -1;
  for (Index v : kf.graph.edge(e)) {
    if (kf.poses.index[v] < 0) continue;
    if (first >= 0 && v != first) {
      throw graph::error_at(kf.graph, kf.graph.edge_line[e],
                            "cannot compose " + kf.graph.type_of_edge(e).tag +
                                " across dropped poses" + other_way(kf.graph, e));
    }
    first = v;
  }
}

// Everything but the odometry that is composed.
void settle_edges(Keyframing& kf, bool move_loops) {
  for (Index e = 0; e < kf.graph.edges(); ++e) {
    if (kf.rewritten[e] || kf.removal.edge[e] || !touches_dropped(kf, e)) continue;
    const graph::EdgeRole role = graph::edge_role(kf.graph, kf.poses, e);
    if (role == graph::EdgeRole::other) refuse_motion_of_many(kf, e);
    if (role == graph::EdgeRole::loop_closure && move_loops && move_loop(kf, e)) continue;
    kf.removal.edge[e] = true;
    kf.dropped_priors += kf.graph.edge(e).size() == 1;
  }
}

bool moves_a_loop(const Keyframing& kf) {
  for (Index e = 0; e < kf.graph.edges(); ++e) {
    if (kf.rewritten[e] && graph::edge_role(kf.graph, kf.poses, e) == graph::EdgeRole::loop_closure)
      return true;
  }
  return false;
}

// Ways to keyframes lead along odometry that is not composed otherwise, too: behind the last
// keyframe of a segment.
void require_ways(const Keyframing& kf) {
  for (Index k = 1; k < pose_count(kf.poses); ++k) {
    if (!is_keyframe(kf, k)) require_composable(kf.graph, kf.odometry, k);
  }
}

// Motions from keyframes to every milestone_spacing-th pose before and behind them, so that long
// ways are not walked for each loop closure again.
void set_milestones(Keyframing& kf) {
  const Index n = pose_count(kf.poses);
  const auto set = [&](Index k) {
    const Index way = std::abs(k - kf.nearest[k]);
    if (way > 0 && way % milestone_spacing == 0)
      kf.milestones.emplace(k, travelled(kf, kf.nearest[k], k));
  };
  for (Index k = 0; k < n; ++k) {
    if (k > kf.nearest[k]) set(k);
  }
  for (Index k = n - 1; k >= 0; --k) {
    if (k < kf.nearest[k]) set(k);
  }
}

// The neighbouring keyframes of the step that odometry edge e takes.
std::pair<Index, Index> around(const Keyframing& kf, Index e) {
  const auto ends = kf.graph.edge(e);
  Index b = std::max(kf.poses.index[ends[0]], kf.poses.index[ends[1]]);
  Index a = b - 1;
  while (!is_keyframe(kf, a)) --a;
  while (!is_keyframe(kf, b)) ++b;
  return {a, b};
}

// The keyframes that edge e, between two poses, comes to join.
std::pair<Index, Index> joined(const Keyframing& kf, Index e) {
  const auto ends = kf.graph.edge(e);
  const auto [a, b] =
      kf.composed[e] ? around(kf, e) : std::pair{kf.poses.index[ends[0]], kf.poses.index[ends[1]]};
  return {host_of(kf, a), host_of(kf, b)};
}

// What edge e, between two poses, then measures.
struct Moved {
  Index from, to;  // keyframes, neither of them merged
  Motion motion;
};
Moved moved(const Keyframing& kf, Index e) {
  const auto ends = kf.graph.edge(e);
  Index a = kf.poses.index[ends[0]], b = kf.poses.index[ends[1]];
  std::optional<Motion> z;
  if (kf.composed[e]) {
    std::tie(a, b) = around(kf, e);
    z = travelled(kf, a, b);
  } else {
    const Index p = std::exchange(a, kf.nearest[a]), q = std::exchange(b, kf.nearest[b]);
    z = motion(kf.graph, e);
    if (p != a) z = compose(travelled(kf, a, p), *z);
    if (q != b) z = compose(*z, inverse(travelled(kf, b, q)));
  }
  if (is_merged(kf, a)) z = compose(kf.from_host.at(a), *z);
  if (is_merged(kf, b)) z = compose(*z, inverse(kf.from_host.at(b)));
  return {kf.host[a], kf.host[b], std::move(*z)};
}

// Merges every keyframe, the fixed ones aside, into the nearest place of those that closures tie it to and that are near
// enough: in the order of time, so that a host has none itself.
void merge_revisits(Keyframing& kf, const Revisit& revisit) {
  std::vector<Index> later(kf.graph.edges(), -1);  // keyframe of every closure
  for (Index e = 0; e < kf.graph.edges(); ++e) {
    if (!is_motion(kf.graph.edge_tag(e)) ||
        graph::edge_role(kf.graph, kf.poses, e) != graph::EdgeRole::loop_closure)
      continue;
    const auto [a, b] = joined(kf, e);
    if (a != b) later[e] = std::max(a, b);
  }
  const graph::Lists<> closures = graph::grouped(later, pose_count(kf.poses));
  for (Index k = 0; k < pose_count(kf.poses); ++k) {
    if (kf.graph.fixed[kf.poses.pose[k]]) continue;
    std::optional<Moved> best;  // from its host to k
    for (const Index e : closures[k]) {
      Moved z = moved(kf, e);
      if (z.from == k) z = {z.to, z.from, inverse(z.motion)};
      const bool near = distance(z.motion) <= revisit.distance && angle(z.motion) <= revisit.angle;
      if (near && (!best || distance(z.motion) < distance(best->motion))) best = std::move(z);
    }
    if (!best) continue;
    kf.host[k] = best->from;
    kf.from_host.emplace(k, std::move(best->motion));
    ++kf.merged;
  }
}

// Edges of one type between the same keyframes become one where any of them has moved, in the place of the last line.
void fuse_parallel(Keyframing& kf) {
  std::map<std::tuple<Index, Index, graph::TypeIndex>, std::vector<Index>> groups;
  for (Index e = 0; e < kf.graph.edges(); ++e) {
    if (kf.removal.edge[e] || !is_motion(kf.graph.edge_tag(e))) continue;
    const auto [a, b] = joined(kf, e);
    if (a != b) groups[{std::min(a, b), std::max(a, b), kf.graph.edge_type[e]}].push_back(e);
  }
  for (auto& [pair, edges] : groups) {
    if (edges.size() < 2 || std::ranges::none_of(edges, [&](Index e) { return kf.rewritten[e]; }))
      continue;
    const Index carrier = edges.back();
    require_fusible(kf.graph, carrier, "between two keyframes");
    for (const Index e : edges) {
      kf.removal.edge[e] = e != carrier;
      kf.rewritten[e] = e == carrier;
    }
    kf.fused.emplace(carrier, std::move(edges));
  }
}

// A line that names a vertex before the file defines it would not be read by g2o.
void find_late_lines(Keyframing& kf) {
  if (kf.graph.edges_only) return;
  for (Index e = 0; e < kf.graph.edges(); ++e) {
    if (!kf.rewritten[e]) continue;
    const auto [a, b] = joined(kf, e);
    for (const Index k : {a, b})
      kf.late[e] = kf.late[e] || kf.graph.vertex_line[kf.poses.pose[k]] > kf.graph.edge_line[e];
  }
}

}  // namespace

std::vector<bool> choose_keyframes(const Graph& graph, const graph::PoseIndex& poses,
                                   const graph::Lists<>& odometry, const KeyframeRule& rule) {
  const Index n = pose_count(poses);
  std::vector<bool> keyframe(n);
  double travelled = 0, turned = 0;
  for (Index k = 0, first = 0; k < n; ++k) {
    const bool start = odometry[k].empty();
    if (start) first = k;
    if (!start && rule.rate == 0) {
      const Motion step = step_motion(graph, poses, odometry, k);
      travelled += distance(step);
      turned += angle(step);
    }
    const bool due = rule.rate > 0 ? (k - first) % rule.rate == 0
                                   : (rule.distance > 0 && travelled >= rule.distance) ||
                                         (rule.angle > 0 && turned >= rule.angle);
    keyframe[k] = start || due || graph.fixed[poses.pose[k]];
    if (keyframe[k]) travelled = turned = 0;
  }
  return keyframe;
}

Keyframing keyframing(const Graph& graph, const graph::PoseIndex& poses,
                      const graph::Lists<>& odometry, const std::vector<bool>& keyframe,
                      const KeyframingOptions& options) {
  const std::vector<bool> no_edge(graph.edges(), false);
  std::vector<Index> host(pose_count(poses));
  std::iota(host.begin(), host.end(), 0);
  Keyframing kf{graph,
                poses,
                odometry,
                nearest_keyframes(odometry, keyframe),
                std::move(host),
                no_edge,
                no_edge,
                no_edge,
                nothing_removed(graph)};
  if (options.revisit) {
    require_ways(kf);
    set_milestones(kf);
    merge_revisits(kf, *options.revisit);
  }
  for (Index k = 0; k < pose_count(poses); ++k) {
    kf.removal.vertex[poses.pose[k]] = !keyframe[k] || is_merged(kf, k);
  }
  settle_odometry(kf);
  settle_edges(kf, options.move_loops);
  if (!options.revisit && moves_a_loop(kf)) {
    require_ways(kf);
    set_milestones(kf);
  }
  if (options.fuse) fuse_parallel(kf);
  find_late_lines(kf);
  return kf;
}

Motion travelled(const Keyframing& kf, Index from, Index to) {
  const Index direction = from < to ? 1 : -1;
  const auto step = [&](Index k) {
    if (direction > 0) return step_motion(kf.graph, kf.poses, kf.odometry, k + 1);
    return inverse(step_motion(kf.graph, kf.poses, kf.odometry, k));
  };
  const auto milestone = [&](Index k) {
    return kf.nearest[k] == from ? kf.milestones.find(k) : kf.milestones.end();
  };
  Index at = to;
  while (at != from && milestone(at) == kf.milestones.end()) at -= direction;
  std::optional<Motion> way;
  if (at != from) way = milestone(at)->second;
  for (; at != to; at += direction) way = way ? compose(*way, step(at)) : step(at);
  return way.value();
}

std::string rewritten_line(const Keyframing& kf, Index e) {
  Moved line = moved(kf, e);
  if (const auto fused = kf.fused.find(e); fused != kf.fused.end()) {
    std::vector<Motion> motions;
    for (const Index i : fused->second) {
      Moved one = moved(kf, i);
      motions.push_back(one.from == line.from ? std::move(one.motion) : inverse(one.motion));
    }
    line.motion = fuse_from(kf.graph, kf.poses, line.from, motions);
  }
  const auto id = [&](Index k) { return kf.graph.id[kf.poses.pose[k]]; };
  return edge_text(line.motion, id(line.from), id(line.to));
}

}  // namespace sg::prune
