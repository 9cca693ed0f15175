#include "lib/elim/node_elimination.h"

#include <boost/dynamic_bitset.hpp>

namespace sg {
namespace {

using Bits = boost::dynamic_bitset<std::uint64_t>;

std::vector<Bits> adjacency_matrix(const Pattern& pattern) {
  std::vector<Bits> adjacent(pattern.variables(), Bits(pattern.variables()));
  for (Index r = 0; r < pattern.rows(); ++r) {
    for (Index i : pattern.row(r)) {
      for (Index j : pattern.row(r)) {
        if (i != j) adjacent[i].set(j);
      }
    }
  }
  return adjacent;
}

std::vector<Index> members(const Bits& set) {
  std::vector<Index> result;
  result.reserve(set.count());
  for (auto i = set.find_first(); i != Bits::npos; i = set.find_next(i))
    result.push_back(static_cast<Index>(i));
  return result;
}

}  // namespace

std::vector<EliminationStep> node_elimination(const Pattern& pattern, const Order& order) {
  std::vector<Bits> adjacent = adjacency_matrix(pattern);
  std::vector<EliminationStep> steps;
  steps.reserve(order.size());
  for (Index v : order) {
    EliminationStep step{v, members(adjacent[v]), {}};
    for (Index i : step.neighbours) {
      Bits missing = adjacent[v] - adjacent[i];
      missing.reset(i);
      for (auto j = missing.find_next(i); j != Bits::npos; j = missing.find_next(j))
        step.fill.emplace_back(i, static_cast<Index>(j));
      adjacent[i] |= missing;
      adjacent[i].reset(v);
    }
    adjacent[v] = Bits();
    steps.push_back(std::move(step));
  }
  return steps;
}

}  // namespace sg
