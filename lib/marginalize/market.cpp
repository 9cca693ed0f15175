#include "lib/marginalize/market.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "lib/marginalize/exchange.h"
#include "lib/order/order.h"

namespace sg::marginalize {
namespace {

constexpr std::string_view ordering = "wmf";  // that EC is priced in
constexpr double rough = 0.1;                 // gap of what is fitted later
constexpr int bracketings = 5, bisections = 6;
constexpr double step = 8;  // of prices, as long as none on the other side is known

struct Priced {
  Draft draft;
  double ec;
  double strain = 0;  // exchange.h
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
  const auto pass = [&](const graph::Order& order, double gap) {
    Prices sheet = prices(market.left, order, market.removed, rate);
    return one_pass(market.at, market.removed, market.rule, &sheet, market.progress, gap);
  };
  const Draft first = pass(market.order, rough);
  const graph::Order order = order::elimination_order(ordering, pattern_of(market, first).pattern);
  return pass(order, market.rule.conservative ? RecoveryOptions{}.gap : rough);
}

// The measurements of some drafts, those of the same vertices once.
std::vector<Measurable> all_of(std::span<const Draft* const> drafts) {
  std::map<std::pair<Index, Index>, Measurable> all;
  for (const Draft* draft : drafts) {
    for (const Measurement& m : draft->measurements)
      all.emplace(std::pair(m.of.first, m.of.second), m.of);
  }
  std::vector<Measurable> result;
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

// What is worth it at a price; all that was met on the way is shown to `see`.
void look(const Market& market, double price, const auto& see) {
  const double rate = price * market.unit;
  const Draft pass = pass_at(market, rate);
  bool any = false;
  if (!market.rule.conservative) {
    const Whole rest(market.at, market.removed, pass.edge_gone);
    const Draft* const drafts[] = {&market.trees, &pass};
    auto there = offered(rest, all_of(drafts));
    for (const Draft* start : drafts) {
      if (!there) break;
      take(*start, there->offers);
      exchange(rest, start->owed, rate, there->offers, [&](const State& state) {
        any = true;
        see(Priced{drafted(market, *start, state.offers, state.lost + there->constant), state.ec,
                   state.strain},
            rate);
      });
    }
  }
  if (!any) see(Priced{pass, complexity(pattern_of(market, pass).pattern)}, rate);
}

double lost(const Priced& found) {
  return found.draft.divergence + found.strain;
}

Draft best_at(const Market& market, double price) {
  std::optional<Priced> best;
  look(market, price, [&](Priced found, double rate) {
    if (!best || lost(found) + rate * found.ec < lost(*best) + rate * best->ec)
      best = std::move(found);
  });
  return std::move(best->draft);
}

// What loses least within an EC of all that is met while prices close in on it; else the least EC.
Draft best_within(const Market& market, double ec) {
  double price = 1, dear = 0, cheap = 0;  // 0: not known yet
  std::optional<Priced> best, least;
  for (int k = 0; k < bracketings + bisections; ++k) {
    if (k >= bracketings && (dear == 0 || cheap == 0)) break;
    std::optional<Priced> here;
    look(market, price, [&](Priced found, double rate) {
      if (found.ec <= ec && (!best || lost(found) < lost(*best))) best = found;
      if (!least || found.ec < least->ec) least = found;
      if (!here || lost(found) + rate * found.ec < lost(*here) + rate * here->ec)
        here = std::move(found);
    });
    (here->ec <= ec ? dear : cheap) = price;
    price = dear == 0 ? price * step : cheap == 0 ? price / step : std::sqrt(dear * cheap);
  }
  return std::move((best ? best : least)->draft);
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
