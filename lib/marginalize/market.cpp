#include "lib/marginalize/market.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <utility>

#include "lib/marginalize/exchange.h"
#include "lib/order/order.h"

namespace sg::marginalize {
namespace {

constexpr std::string_view ordering = "wmf";                    // that EC is priced in
constexpr RecoveryOptions rough{.sweeps = 4, .barrier = 1e-3};  // what is fitted later
constexpr int bracketings = 5, bisections = 6;
constexpr double step = 8;  // of prices, as long as none on the other side is known
constexpr int first_turns = 4,
              further_turns = 11;  // of exchange, from each start and from the better

// A draft that need not be written out.
struct Priced {
  double ec;
  double lost;  // with its strain (exchange.h)
  const std::function<Draft()>& draft;
};

double complexity(const graph::Pattern& pattern) {
  return elim::to_double(
      elim::elimination_complexity(pattern, order::elimination_order(ordering, pattern)));
}

// Topology ec at prices.
struct Market {
  const At& at;
  const std::vector<bool>& removed;
  const Rule& rule;
  const Progress& progress;
  Draft trees;
  graph::GraphPattern left = {};  // with trees alone
  graph::Order order = {};        // of that
  double unit = 0;                // what trees lose a unit of their EC
};

graph::GraphPattern pattern_of(const Market& market, const Draft& draft) {
  return pattern_left(*market.at.problem.graph, market.removed, draft.edge_gone,
                      factors_of(draft.measurements));
}

// A pass at a price, in the order of a pass before it.
Draft pass_at(const Market& market, double rate) {
  const auto pass = [&](const graph::Order& order, const RecoveryOptions& how) {
    Prices sheet = prices(market.left, order, market.removed, rate);
    return one_pass(market.at, market.removed, market.rule, &sheet, market.progress, how);
  };
  const Draft first = pass(market.order, rough);
  const graph::Order order = order::elimination_order(ordering, pattern_of(market, first).pattern);
  return pass(order, market.rule.conservative ? RecoveryOptions{} : rough);
}

// The measurements of some drafts, those of the same vertices once.
std::vector<Measurable> all_of(std::span<const Draft* const> drafts) {
  std::map<std::pair<Index, Index>, Measurable> all;
  for (const Draft* draft : drafts) {
    for (const Measurement& m : draft->measurements)
      all.emplace(std::pair(m.of.first, m.of.second), m.of);
  }
  std::vector<Measurable> result;
  result.reserve(all.size());
  for (const auto& [ends, of] : all) result.push_back(of);
  return result;
}

// Takes what a draft has, and no more.
void take(const Draft& draft, std::vector<Offer>& offers) {
  std::map<std::pair<Index, Index>, Eigen::MatrixXd> all;
  for (const Measurement& m : draft.measurements) {
    Eigen::MatrixXd& sum = all[{m.of.first, m.of.second}];
    if (sum.size() == 0) {
      sum = m.information;
    } else {
      sum += m.information;
    }
  }
  for (Offer& offer : offers) {
    const auto found = all.find({offer.of.first, offer.of.second});
    offer.taken = found != all.end();
    if (offer.taken) offer.information = found->second;
  }
}

Draft drafted(const Market& market, const Draft& start, const std::vector<Offer>& offers,
              double divergence) {
  Draft draft{start.edge_gone, {}, {}, start.owed, divergence};
  for (const Offer& offer : offers) {
    if (offer.taken)
      draft.measurements.push_back({offer.of, measured(market.at, offer.of), offer.information});
  }
  return draft;
}

// What is worth it at a price; all that was met on the way is shown to `see`, with the price of a unit of EC.
void look(const Market& market, double price, const auto& see) {
  const double rate = price * market.unit;
  const Draft pass = pass_at(market, rate);
  bool any = false;
  const auto see_pass = [&] {
    see(Priced{complexity(pattern_of(market, pass).pattern), pass.divergence,
               [&] { return Draft(pass); }},
        rate);
  };
  const Draft* const drafts[] = {&market.trees, &pass};
  const Whole rest(market.at, market.removed, pass.edge_gone);
  auto there = market.rule.conservative ? std::nullopt : offered(rest, all_of(drafts));
  if (!there) return see_pass();
  const auto terms = [&](const Draft& start) -> Terms {
    return {rest, start.owed, rate, [&](const State& state) {
              any = true;
              const double lost = state.lost + there->constant;
              see(Priced{state.ec, lost + state.strain,
                         [&] { return drafted(market, start, state.offers, lost); }},
                  rate);
            }};
  };
  std::vector<const Offer*> pointers;
  for (const Offer& offer : there->offers) pointers.push_back(&offer);
  Rest all(rest, pointers, [](const graph::Pattern& pattern) {
    return order::elimination_order(ordering, pattern);
  });
  Exchange of_trees{there->offers}, of_pass{std::move(there->offers)};
  take(market.trees, of_trees.offers);
  take(pass, of_pass.offers);
  advance(terms(market.trees), first_turns, all, of_trees);
  advance(terms(pass), first_turns, all, of_pass);
  const bool trees = of_trees.least < of_pass.least;
  (trees ? of_pass : of_trees) = {};
  Exchange& better = trees ? of_trees : of_pass;
  const Terms on = terms(trees ? market.trees : pass);
  advance(on, further_turns, all, better);
  settle(on, better);
  if (!any) see_pass();  // nothing that was taken would determine all
}

Draft best_at(const Market& market, double price) {
  std::optional<Draft> best;
  double least = std::numeric_limits<double>::infinity();
  look(market, price, [&](const Priced& found, double rate) {
    const double now = found.lost + rate * found.ec;
    if (best && !(now < least)) return;
    least = now;
    best = found.draft();
  });
  return std::move(*best);
}

// What loses least within an EC of all that is met while prices close in on it; else the least EC.
Draft best_within(const Market& market, double ec) {
  double price = 1, dear = 0, cheap = 0;  // 0: not known yet
  std::optional<Draft> best;
  double best_lost = 0, best_ec = std::numeric_limits<double>::infinity();
  for (int k = 0; k < bracketings + bisections; ++k) {
    if (k >= bracketings && (dear == 0 || cheap == 0)) break;
    double least = std::numeric_limits<double>::infinity(), ec_here = 0;
    look(market, price, [&](const Priced& found, double rate) {
      const bool within = found.ec <= ec, first = !best || (within && best_ec > ec);
      if (first || (within ? found.lost < best_lost : found.ec < best_ec && best_ec > ec)) {
        best = found.draft();
        best_lost = found.lost;
        best_ec = found.ec;
      }
      const double now = found.lost + rate * found.ec;
      if (ec_here > 0 && !(now < least)) return;
      least = now;
      ec_here = found.ec;
    });
    (ec_here <= ec ? dear : cheap) = price;
    price = dear == 0 ? price * step : cheap == 0 ? price / step : std::sqrt(dear * cheap);
  }
  return std::move(*best);
}

}  // namespace

Draft worth_their_ec(const At& at, const std::vector<bool>& removed, const Rule& rule,
                     const Progress& progress) {
  Rule sparsest = rule;
  sparsest.sparsity.topology = Topology::tree;
  Market market{at, removed, rule, progress, one_pass(at, removed, sparsest, nullptr, progress)};
  market.left = pattern_of(market, market.trees);
  market.order = order::elimination_order(ordering, market.left.pattern);
  const double ec =
      elim::to_double(elim::elimination_complexity(market.left.pattern, market.order));
  market.unit = std::max(market.trees.divergence, 0.0) / std::max(ec, 1.0);
  return rule.sparsity.ec ? best_within(market, *rule.sparsity.ec)
                          : best_at(market, rule.sparsity.price);
}

}  // namespace sg::marginalize
