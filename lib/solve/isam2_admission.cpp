#include "lib/solve/isam2_admission.h"

#include <algorithm>
#include <limits>

#include "lib/order/stopwatch.h"
#include "lib/solve/isam2_admit.h"
#include "lib/solve/isam2_leave.h"

namespace sg::solve {
namespace {

// What a factor costs beside elimination.
constexpr double cost_of_row = 100;
// So many of those held are looked at again for a newcomer.
constexpr int looks = 8;

constexpr auto lowest_on_top = [](const Admission::Held& a, const Admission::Held& b) {
  return a.rate > b.rate;
};

void push(Admission& admission, const Admission::Held& held) {
  admission.held.push_back(held);
  std::ranges::push_heap(admission.held, lowest_on_top);
}

Admission::Held pop(Admission& admission) {
  std::ranges::pop_heap(admission.held, lowest_on_top);
  const Admission::Held held = admission.held.back();
  admission.held.pop_back();
  return held;
}

double rate(double gain, double cost) {
  return gain / (cost + cost_of_row);
}

// An offer that has been looked at.
struct Bid {
  const Offer* offer;
  Index variable;  // that would enter; -1: none
  double cost, rate;
};

// Nothing where it does not determine its landmark, or tells nothing of poses.
std::optional<Bid> bid_of(Isam2Replay& replay, Admission& admission, const Offer& offer) {
  Bid bid{&offer, -1, 0, std::numeric_limits<double>::max()};  // what is free is not weighed
  int dim = 0;
  if (offer.vertex >= 0) {
    enter(replay, std::span(&offer.vertex, 1), offer.edges);
    bid.variable = variable_of(replay, offer.vertex);
    dim = pattern_of(replay.isam).dim[bid.variable];
    Index first = std::numeric_limits<Index>::max();
    for (Index e : offer.edges) {
      for (Index v : replay.problem->graph->edge(e)) {
        if (replay.poses.index[v] >= 0) first = std::min(first, replay.poses.index[v]);
      }
    }
    admission.place[bid.variable] = first;
  }
  const Measurement m = measurement(replay.isam, offer.edges, bid.variable);
  if (m.variables.empty() || m.jacobian.rows() == 0) return {};
  bid.cost = price(replay.isam, m.variables, dim);
  if (bid.cost == 0) return bid;
  const double gained = gain(replay.isam, m, admission.place);
  bid.rate = rate(gained, bid.cost);
  return gained > 0 ? std::optional(bid) : std::nullopt;
}

// Those of its edges that are in.
std::vector<Index> edges_of(const Isam2& isam, const Admission::Held& held) {
  if (held.edge >= 0) {
    const bool in = isam.tree.row_clique[held.edge] >= 0;
    return in ? std::vector{held.edge} : std::vector<Index>{};
  }
  // What is in a prior cannot be taken out of it.
  return isam.pinned[held.landmark] ? std::vector<Index>{} : rows_in(isam, held.landmark);
}

// What holding this edge is worth now.
double rate_now(Isam2Replay& replay, const Admission& admission, const Admission::Held& held) {
  const std::vector<Index> edges = edges_of(replay.isam, held);
  const Measurement m = measurement(replay.isam, edges, held.landmark);
  if (m.variables.empty() || m.jacobian.rows() == 0) return 0;
  return rate(gain(replay.isam, m, admission.place, true), held.cost);
}

// What has the lowest rate by the last look; it is no longer held.
std::optional<Admission::Held> lowest(const Isam2& isam, Admission& admission) {
  while (!admission.held.empty()) {
    const Admission::Held held = pop(admission);
    if (!edges_of(isam, held).empty()) return held;
  }
  return {};
}

// The same by what it is worth now, if that is below `limit`.
std::optional<Admission::Held> lowest(Isam2Replay& replay, Admission& admission, double limit) {
  for (int look = 0; look < looks && !admission.held.empty();) {
    Admission::Held held = pop(admission);
    if (edges_of(replay.isam, held).empty()) continue;  // has left
    ++look;
    if (held.rate < limit && held.looked != replay.isam.updates) {
      held.rate = rate_now(replay, admission, held);
      held.looked = replay.isam.updates;
    }
    const bool low =
        held.rate < limit && (admission.held.empty() || held.rate <= admission.held.front().rate);
    if (low) return held;
    const bool all_above = held.rate >= limit;
    push(admission, held);
    if (all_above && admission.held.front().rate >= limit) return {};
  }
  return {};
}

struct Choice {
  std::vector<Bid> in;  // the best first
  std::vector<Admission::Held> out;
};

Choice choose(Isam2Replay& replay, Admission& admission, std::vector<Bid> bids, double budget) {
  std::ranges::stable_sort(bids, std::ranges::greater(), &Bid::rate);
  Choice choice;
  double room = budget - static_cast<double>(replay.isam.tree.ec_bt);
  for (const Bid& bid : bids) {
    std::vector<Admission::Held> out;
    while (bid.cost > room) {
      const auto held = lowest(replay, admission, bid.rate);
      if (!held) break;
      room += held->cost;
      out.push_back(*held);
    }
    if (bid.cost <= room) {
      choice.in.push_back(bid);
      choice.out.insert(choice.out.end(), out.begin(), out.end());
      room -= bid.cost;
    } else {
      for (const Admission::Held& held : out) {
        room -= held.cost;
        push(admission, held);
      }
    }
  }
  return choice;
}

void give_back(Isam2& isam, Admission& admission, const Admission::Held& held) {
  for (Index e : edges_of(isam, held)) {
    ++admission.returned;
    take_row_out(isam, e);
  }
  if (held.landmark >= 0) take_variable_out(isam, held.landmark);
}

Entering entering(const Choice& choice) {
  Entering result;
  for (const Bid& bid : choice.in) {
    if (bid.variable >= 0) result.variables.push_back(bid.variable);
    result.rows.insert(result.rows.end(), bid.offer->edges.begin(), bid.offer->edges.end());
  }
  return result;
}

// What names a landmark that has been given back stays out.
void drop_homeless(const Isam2& isam, Choice& choice) {
  std::erase_if(choice.in, [&](const Bid& bid) {
    return std::ranges::any_of(bid.offer->edges, [&](Index e) {
      return std::ranges::any_of(pattern_of(isam).rows[e], [&](Index j) {
        return j != bid.variable && isam.tree.variable_clique[j] < 0;
      });
    });
  });
}

// Carries the choice out; where the tree would cost more than was thought, less of it comes in and more goes out.
void carry_out(Isam2Replay& replay, Admission& admission, Choice& choice, elim::Wide budget,
               Isam2Report& report) {
  Isam2& isam = replay.isam;
  const std::vector<Index> wanted = entering(choice).rows;
  report.relinearized += begin_update(isam, wanted);
  for (const Admission::Held& held : choice.out) give_back(isam, admission, held);
  drop_homeless(isam, choice);
  Entering in = entering(choice);
  const order::Stopwatch watch;
  CliqueTree plan = plan_top(isam, in.variables, in.rows);
  double planning = watch.seconds();
  while (ec_after(isam, plan, {}) > budget) {
    if (!choice.in.empty()) {
      choice.in.resize(choice.in.size() / 2);
      in = entering(choice);
    } else {
      const auto held = lowest(isam, admission);
      if (!held) break;
      choice.out.push_back(*held);
      give_back(isam, admission, *held);
    }
    const double before = watch.seconds();
    plan = plan_top(isam, in.variables, in.rows);
    planning = watch.seconds() - before;
  }
  admission.choosing += watch.seconds() - planning;
  Isam2Report own;
  redo_and_solve(isam, in.variables, in.rows, plan, own);
  for (Index r : wanted) {
    if (isam.tree.row_clique[r] < 0) let_row_go(isam, r);
  }
  report.reeliminated += own.reeliminated;
  report.ec += own.ec;
  report.undetermined.insert(report.undetermined.end(), own.undetermined.begin(),
                             own.undetermined.end());
  report.finite &= own.finite;
}

}  // namespace

Admission make_admission(const Isam2Replay& replay) {
  Admission admission;
  for (Index v : replay.problem->variables.variable_vertex)
    admission.place.push_back(replay.poses.index[v]);
  return admission;
}

std::vector<Offer> take_offers(const Isam2Replay& replay, Index k, int min_obs,
                               std::vector<Index>& vertices, std::vector<Index>& edges) {
  const factor::Problem& problem = *replay.problem;
  const Graph& graph = *problem.graph;
  const Index pose = replay.poses.pose[k];
  std::vector<Index> stay;
  std::vector<Offer> offers;
  const auto enters = [&](Index v) {
    return graph.role(v) == graph::Role::landmark && variable_of(replay, v) >= 0 &&
           std::ranges::find(vertices, v) != vertices.end();
  };
  bool holds_pose = k == 0;
  for (Index e : edges) {
    const graph::EdgeRole role = graph::edge_role(graph, replay.poses, e);
    const bool offered =
        (role == graph::EdgeRole::loop_closure || role == graph::EdgeRole::observation) &&
        problem.variables.pattern.rows[e].size() > 1;
    if (!offered) {
      stay.push_back(e);
      const auto ends = graph.edge(e);
      holds_pose |= std::ranges::find(ends, pose) != ends.end();
      continue;
    }
    Index landmark = -1;
    for (Index v : graph.edge(e)) landmark = enters(v) ? v : landmark;
    const auto same = std::ranges::find_if(
        offers, [&](const Offer& o) { return landmark >= 0 && o.vertex == landmark; });
    if (same == offers.end()) {
      offers.push_back({landmark, {e}});
    } else {
      same->edges.push_back(e);
    }
  }
  if (!holds_pose) return {};
  edges = std::move(stay);
  for (Offer& offer : offers) {
    if (offer.vertex < 0) continue;
    std::erase(vertices, offer.vertex);
    std::ranges::sort(offer.edges);
    const auto size = static_cast<Index>(offer.edges.size()), few = std::max<Index>(3, min_obs);
    if (size <= few) continue;
    for (Index i = 0; i < few; ++i) offer.edges[i] = offer.edges[i * (size - 1) / (few - 1)];
    offer.edges.resize(few);
  }
  return offers;
}

Admitted admit(Isam2Replay& replay, Admission& admission, std::span<const Offer> offers,
               elim::Wide budget, Isam2Report& report) {
  Admitted result;
  if (offers.empty() && replay.isam.tree.ec_bt <= budget) return result;
  const order::Stopwatch watch;
  std::vector<Bid> bids;
  for (const Offer& offer : offers) {
    admission.offered += static_cast<Index>(offer.edges.size());
    if (const auto bid = bid_of(replay, admission, offer)) bids.push_back(*bid);
  }
  Choice choice = choose(replay, admission, std::move(bids), static_cast<double>(budget));
  admission.choosing += watch.seconds();
  if (!choice.in.empty() || replay.isam.tree.ec_bt > budget)
    carry_out(replay, admission, choice, budget, report);
  for (const Bid& bid : choice.in) {
    const std::vector<Index>& edges = bid.offer->edges;
    result.edges.insert(result.edges.end(), edges.begin(), edges.end());
    push(admission, {bid.rate, bid.cost, bid.variable < 0 ? edges.front() : -1, bid.variable});
  }
  for (const Admission::Held& held : choice.out) {
    if (held.landmark >= 0)
      result.returned_landmarks.push_back(replay.problem->variables.variable_vertex[held.landmark]);
  }
  admission.admitted += static_cast<Index>(result.edges.size());
  for (const Offer& offer : offers) {
    const bool refused = offer.vertex >= 0 &&
                         replay.isam.tree.variable_clique[variable_of(replay, offer.vertex)] < 0;
    if (!refused) continue;
    replay.placed[offer.vertex] = false;
    result.refused_landmarks.push_back(offer.vertex);
  }
  return result;
}

}  // namespace sg::solve
