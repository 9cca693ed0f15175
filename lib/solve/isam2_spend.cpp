#include "lib/solve/isam2_spend.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/solve/isam2_admit.h"
#include "lib/solve/isam2_leave.h"

namespace sg::solve {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
// Edges to what is less old are no return: they are there anyhow.
constexpr Index least_age = 3;
// So many of a step's returns are looked at.
constexpr int most_returns = 2;
// Of a pose's observations so many stand for all.
constexpr int most_observations = 6;
// A pose's observations are looked at again after so many steps; so many poses' rates are, in a step.
constexpr Index worth_lasts = 200;
constexpr Index looks = 8;
// Where poses are composed, so much more than is needed: it takes the way to the root apart.
constexpr double slack = 0.02;
// Of the rate at which room was made, a step later in which none had to be.
constexpr double fading = 0.99;

// How old what edge e, of this step, names is.
Index age(const Isam2Window& window, Index e) {
  const auto& ages = window.spending.ages;
  const auto found = std::ranges::find(ages, e, &std::pair<Index, Index>::first);
  return found == ages.end() ? 0 : found->second;
}

double expected(const Isam2Window& window, Index pose, Index k) {
  return window.keyframes.stands_for[pose] * expected_gain(window.spending.returns, k - pose);
}

// What giving the pose's observations back would lose, by some of them.
double worth(Isam2Window& window, Index pose, Index k) {
  Spending& spending = window.spending;
  if (spending.looked[pose] >= 0 && k - spending.looked[pose] < worth_lasts)
    return spending.worth[pose];
  Isam2& isam = window.replay.isam;
  const Graph& graph = *window.replay.problem->graph;
  const Index v = window.replay.poses.pose[pose];
  std::vector<Index> observations;
  for (Index r : rows_in(isam, variable_of(window.replay, v))) {
    if (r >= graph.edges()) continue;
    for (Index end : graph.edge(r)) {
      const Index j = variable_of(window.replay, end);
      if (graph.role(end) == graph::Role::landmark && j >= 0 &&
          static_cast<int>(rows_in(isam, j).size()) > window.min_obs)
        observations.push_back(r);
    }
  }
  double sum = 0;
  if (const std::size_t all = observations.size(); all > 0) {
    const std::size_t few = std::min<std::size_t>(all, most_observations);
    for (std::size_t i = 0; i < few; ++i) observations[i] = observations[i * all / few];
    observations.resize(few);
    sum = gain(isam, measurement(isam, observations), window.admission.place, true) *
          static_cast<double>(all) / static_cast<double>(few);
  }
  spending.looked[pose] = k;
  return spending.worth[pose] = sum;
}

// Loss per EC of composing a pose; infinite where it cannot be.
double rate_of_composing(Isam2Window& window, Index pose, Index k) {
  const Isam2Replay& replay = window.replay;
  if (is_composed(window.keyframes, pose) || !can_be_composed(replay, pose, window.min_obs))
    return infinite;
  const Index j = variable_of(replay, replay.poses.pose[pose]);
  const double way = way_variance(replay, pose) + window.keyframes.spread[pose];
  const double share = way / (way + window.spending.closure + 1e-12);
  const double loss = worth(window, pose, k) + expected(window, pose, k) * share;
  return loss / std::max(freed_by(replay.isam, j), 1.0);
}

// The pose whose composing loses least per EC, -1 where none can be; by rates that are renewed in turn.
Index cheapest_to_compose(Isam2Window& window, Index k) {
  std::vector<double>& rates = window.spending.rates;
  const Index end = k - 1;  // the newest two stay
  for (;;) {
    Index best = -1;
    double least = infinite;
    for (Index pose = window.first; pose < end; ++pose) {
      if (rates[pose] < least) {
        least = rates[pose];
        best = pose;
      }
    }
    if (best < 0) return -1;
    const double now = rate_of_composing(window, best, k);
    const bool still = now <= 1.05 * least || now == 0;
    rates[best] = now;
    if (still && now < infinite) return best;
  }
}

void look_again(Isam2Window& window, Index k) {
  const Index end = k - 1;
  if (end <= window.first) return;
  Index& pose = window.spending.next_look;
  for (Index look = 0; look < std::min(looks, end - window.first); ++look) {
    if (++pose >= end || pose < window.first) pose = window.first;
    window.spending.rates[pose] = rate_of_composing(window, pose, k);
  }
  window.spending.rates[end - 1] = rate_of_composing(window, end - 1, k);
}

// Landmarks that a composed pose had seen: when they were last seen; those with too few observations go.
void settle_landmarks(Isam2Window& window, std::span<const Index> landmarks) {
  Isam2Replay& replay = window.replay;
  Isam2& isam = replay.isam;
  for (const Index v : landmarks) {
    const Index j = variable_of(replay, v);
    if (j < 0 || window.left[v] || isam.tree.variable_clique[j] < 0) continue;
    int count = 0, height = 0;
    Index last = -1;
    for (Index r : rows_of(isam, j)) {
      if (isam.tree.row_clique[r] < 0 && !enters(isam, r)) continue;
      ++count;
      height += factor::block_rows(*replay.problem, r);
      for (Index end : replay.problem->graph->edge(r))
        last = std::max(last, replay.poses.index[end]);
    }
    const bool few = count < window.min_obs || height < pattern_of(isam).dim[j];
    const bool comes =
        std::ranges::any_of(rows_of(isam, j), [&](Index r) { return enters(isam, r); });
    if (!few || comes || isam.pinned[j]) {
      if (last >= 0) window.last_seen[v] = last;
      continue;
    }
    for (Index r : rows_in(isam, j)) {
      take_row_out(isam, r);
      ++window.keyframes.returned;
    }
    take_variable_out(isam, j);
    replay.placed[v] = false;
    window.last_seen[v] = -1;
    window.incomplete.insert(std::ranges::upper_bound(window.incomplete, v), v);
  }
}

void compose(Isam2Window& window, Index pose) {
  const std::vector<Index> landmarks = compose_away(window.replay, window.keyframes, pose);
  window.left[window.replay.poses.pose[pose]] = true;
  window.spending.rates[pose] = infinite;
  --window.there;
  while (is_composed(window.keyframes, window.first)) ++window.first;
  settle_landmarks(window, landmarks);
}

}  // namespace

void refuse_closures(Isam2Window& window, Entering& entering, Index k) {
  if (!(window.spending.rate > 0) || k < 1) return;
  Isam2Replay& replay = window.replay;
  Isam2& isam = replay.isam;
  const auto& variable = replay.problem->variables.vertex_variable;
  const Index newest = variable[replay.poses.pose[k]], before = variable[replay.poses.pose[k - 1]];
  if (before < 0 || isam.tree.variable_clique[before] < 0) return;
  const auto is_odometry = [&](Index r) {
    const auto row = pattern_of(isam).rows[r];
    return row.size() == 2 && std::ranges::count(row, newest) > 0 &&
           std::ranges::count(row, before) > 0;
  };
  if (std::ranges::none_of(entering.rows, is_odometry)) return;
  std::erase_if(entering.rows, [&](Index r) {
    if (r >= replay.problem->graph->edges() || !is_relative_pose(*replay.problem->graph, r))
      return false;
    const auto row = pattern_of(isam).rows[r];
    if (row.size() != 2 || age(window, r) < least_age) return false;
    const Index other = row[0] == newest ? row[1] : row[0];
    if (other == before || isam.tree.variable_clique[other] < 0) return false;
    Measurement m = measurement(isam, std::span(&r, 1));
    for (Index& j : m.variables) j = j == newest ? before : j;
    const double cost = price(isam, m.variables) + 100;
    const bool refused = gain(isam, m, window.admission.place) < window.spending.rate * cost;
    window.spending.refused += refused ? 1 : 0;
    return refused;
  });
}

CliqueTree plan_spending(Isam2Window& window, const Entering& entering, Index k, Index least,
                         Leaving& leaving) {
  const auto budget = static_cast<double>(window.options.budget);
  const bool by_age = window.options.spend == Spend::mixed;
  if (by_age && expected(window, window.first, k) == 0) {  // nothing is lost by it
    window.spending.rate *= fading;
    return plan_within(window, entering, k, least, leaving);
  }
  CliqueTree plan = plan_with(window, entering, k, least, leaving);
  bool looked = false;
  double worst = 0;
  for (int round = 0; round < 4; ++round) {
    const auto ec = static_cast<double>(ec_after(window.replay.isam, plan, leaving.variables));
    if (ec <= budget) break;
    double excess = ec - budget;
    Index turns = leaving.turns();
    bool any = false, composed = false;
    while (excess > 0) {
      const double freed = freed_by_turn(window, k);
      const double rate = by_age && window.first < k - 1 && freed > 0
                              ? expected(window, window.first, k) / freed
                              : infinite;
      Index pose = -1;
      if (rate > 0) {
        if (!looked) look_again(window, k);
        looked = true;
        pose = cheapest_to_compose(window, k);
      }
      if (pose < 0 && rate == infinite) break;
      any = true;
      if (pose >= 0 && window.spending.rates[pose] < rate) {
        const Index v = window.replay.poses.pose[pose];
        excess -= freed_by(window.replay.isam, variable_of(window.replay, v));
        if (!composed) excess += slack * budget;
        composed = true;
        worst = std::max(worst, window.spending.rates[pose]);
        compose(window, pose);
      } else {
        excess -= freed;
        worst = std::max(worst, rate);
        add_turn(window, k, leaving);
        ++turns;
      }
    }
    if (!any) break;
    plan = plan_with(window, entering, k, turns, leaving);
  }
  window.spending.rate = worst > 0 ? worst : fading * window.spending.rate;
  if (ec_after(window.replay.isam, plan, leaving.variables) <= window.options.budget) return plan;
  return plan_within(window, entering, k, leaving.turns(), leaving);
}

void learn(Isam2Window& window) {
  Isam2& isam = window.replay.isam;
  Spending& spending = window.spending;
  next_step(spending.returns);
  int looked = 0;
  for (const auto& [e, old] : spending.ages) {
    if (old < least_age) continue;
    std::optional<double> gained;
    if (isam.tree.row_clique[e] >= 0 && ++looked <= most_returns) {
      const double lost =
          gain(isam, measurement(isam, std::span(&e, 1)), window.admission.place, true);
      if (std::isfinite(lost)) gained = lost;
    }
    note_return(spending.returns, old, gained);
    if (!is_relative_pose(*window.replay.problem->graph, e)) continue;
    const double v = variance(relative_pose(*window.replay.problem, e));
    if (std::isfinite(v)) spending.closure += 0.05 * (v - spending.closure);
  }
}

}  // namespace sg::solve
