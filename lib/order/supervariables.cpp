#include "lib/order/supervariables.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

namespace sg::order {

Supervariables supervariables(const std::vector<int>& dim) {
  const std::size_t n = dim.size();
  Supervariables result;
  result.dim = dim;
  result.weight = dim;
  result.alive.assign(n, true);
  result.next.assign(n, -1);
  result.tail.resize(n);
  std::iota(result.tail.begin(), result.tail.end(), 0);
  result.order.reserve(n);
  return result;
}

void absorb(Supervariables& variables, Index kept, Index gone) {
  assert(kept != gone && variables.alive[kept] && variables.alive[gone]);
  variables.weight[kept] += variables.weight[gone];
  variables.alive[gone] = false;
  variables.next[variables.tail[kept]] = gone;
  variables.tail[kept] = variables.tail[gone];
}

void eliminate_members(Supervariables& variables, Index v, std::int64_t separator) {
  graph::Order& order = variables.order;
  const auto first = static_cast<std::ptrdiff_t>(order.size());
  for (Index member = v; member >= 0; member = variables.next[member]) order.push_back(member);
  const std::vector<int>& dim = variables.dim;
  std::sort(order.begin() + first, order.end(),
            [&](Index a, Index b) { return std::pair(dim[a], a) < std::pair(dim[b], b); });
  std::int64_t front = variables.weight[v] + separator;
  for (auto member = order.begin() + first; member != order.end(); ++member) {
    variables.ec += elim::elimination_cost(dim[*member], front);
    front -= dim[*member];
  }
  variables.alive[v] = false;
}

}  // namespace sg::order
