// Variables that have become indistinguishable are kept as one *supervariable*, named by one of its
// members: they have the same neighbours, so some best order has them together, and every later
// step handles them at the price of one (Duff, Reid 1983; Amestoy, Davis, Duff 1996).
#pragma once

#include <cstdint>
#include <vector>

#include "lib/elim/score.h"

namespace sg::order {

struct Supervariables {
  std::vector<int> dim;     // n: of the variables themselves
  std::vector<int> weight;  // n: of the supervariable that v names: sum of its members' dimensions
  std::vector<char> alive;  // n: v names a supervariable that is not yet eliminated
  std::vector<Index> next, tail;  // n: chains of members; next is -1 at a tail

  graph::Order order;  // eliminated so far
  elim::Wide ec = 0;   // its elimination complexity
};
Supervariables supervariables(const std::vector<int>& dim);

// `gone` becomes part of `kept`.
void absorb(Supervariables& variables, Index kept, Index gone);

// The members of v go next, small ones first: of all orders inside a clique this has the least EC.
// separator: scalar dimension of v's neighbours.
void eliminate_members(Supervariables& variables, Index v, std::int64_t separator);

// A well-mixed 64-bit number for every index (the finalizer of SplitMix64). Sets of indices are
// compared by the sums of their numbers: equal sets have equal sums, and different ones meet by
// chance once in 2^64.
inline std::uint64_t mix(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

}  // namespace sg::order
