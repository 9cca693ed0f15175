#include "lib/prune/offer.h"

#include <algorithm>

namespace sg::prune {
namespace {

constexpr std::size_t bases = 6;  // poses about which a landmark's observations are sought

// The variable of the pose that an edge observes from, the last if there are several; -1 for a constant.
Index observer(const Part& part, Index e) {
  Index last = -1;
  for (const Index v : part.choice.graph.edge(e)) last = std::max(last, part.choice.poses.index[v]);
  return last < 0 ? -1 : part.evidence.vertex_variable[part.choice.poses.pose[last]];
}

// So many of a list, spread evenly.
std::vector<Index> spread(std::span<const Index> list, std::size_t count) {
  std::vector<Index> chosen;
  for (std::size_t k = 0; k < count; ++k)
    chosen.push_back(list[k * (list.size() - 1) / std::max<std::size_t>(count - 1, 1)]);
  return chosen;
}

// Those of a landmark's observations whose poses stand in the separator of `base`'s, and that: they come together for
// nothing but the landmark itself.
std::vector<Index> beside(const Part& part, std::span<const Index> edges, Index base) {
  const Index first = observer(part, base);
  std::vector<Index> chosen;
  if (first < 0) return chosen;
  const std::vector<Index>& separator = part.filled.separator[part.position[first]];
  for (const Index e : edges) {
    const Index j = observer(part, e);
    if (j < 0 || j == first || std::ranges::binary_search(separator, part.position[j]))
      chosen.push_back(e);
  }
  return chosen;
}

// A landmark that comes in with these of its observations, and with what else it has.
Offer with_observations(const Part& part, Index variable, std::vector<Index> edges,
                        std::span<const Index> others) {
  Offer offer{std::move(edges), {}, variable};
  offer.rows = offer.edges;
  offer.rows.insert(offer.rows.end(), others.begin(), others.end());
  offer.measurement = without(part.evidence, offer.rows, variable);
  return offer;
}

}  // namespace

double worth(Part& part, const Offer& offer, const Gain& gain) {
  const elim::Wide cost =
      elim::increase(part.filled, factor_of(part, offer.rows)) + edge_cost * offer.edges.size();
  return chosen(part, gain) / elim::to_double(cost);
}

double guessed_worth(Part& part, const Offer& offer) {
  return worth(part, offer, guessed_gain(part.knowledge, offer.measurement));
}

Offer edge_offer(const Part& part, Index e) {
  return {{e}, {e}, -1, measurement(part.evidence, e)};
}

std::optional<Valued> landmark_offer(Part& part, Index vertex, std::vector<Index> candidates,
                                     std::span<const Index> others) {
  std::optional<Valued> best;
  if (candidates.empty()) return best;
  std::ranges::stable_sort(candidates, {}, [&](Index e) { return observer(part, e); });
  std::vector<std::vector<Index>> sources{candidates};
  for (const Index base : spread(candidates, std::min(bases, candidates.size())))
    sources.push_back(beside(part, candidates, base));
  const Index variable = part.evidence.vertex_variable[vertex];
  for (const std::vector<Index>& source : sources) {
    for (auto count = static_cast<std::size_t>(part.choice.min_obs); count <= source.size();
         count += (count + 2) / 3) {
      Offer offer = with_observations(part, variable, spread(source, count), others);
      if (offer.measurement.variables.empty()) continue;
      const double value = guessed_worth(part, offer);
      if (!best || value > best->worth) best = Valued{std::move(offer), value};
    }
  }
  return best;
}

}  // namespace sg::prune
