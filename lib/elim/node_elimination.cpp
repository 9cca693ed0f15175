#include "lib/elim/node_elimination.h"

#include <bit>
#include <cstdint>

#include "lib/elim/etree.h"

namespace sg::elim {
namespace {

// Bit j of row i, j > i: positions i and j are neighbours. Of an edge only the upper half is kept,
// since the lower end is eliminated first and nobody looks back at it.
class UpperMatrix {
 public:
  explicit UpperMatrix(Index n)
      : words_((n + 63) / 64), bits_(static_cast<std::size_t>(n) * words_) {}

  void join(Index i, Index j) { word(i, j / 64) |= std::uint64_t{1} << (j % 64); }

  // Calls visit(j) for the neighbours j of i, ascending.
  void for_each(Index i, const auto& visit) const {
    for (std::size_t w = i / 64; w < words_; ++w) visit_bits(w, word(i, w), visit);
  }

  // Makes the neighbours j > i of k neighbours of i; calls visit(j) for those that were not.
  void merge(Index i, Index k, const auto& visit) {
    for (std::size_t w = i / 64; w < words_; ++w) {
      std::uint64_t added = word(k, w) & ~word(i, w);
      if (w == i / 64) added &= ~std::uint64_t{1} << (i % 64);  // above i itself
      word(i, w) |= added;
      visit_bits(w, added, visit);
    }
  }

 private:
  static void visit_bits(std::size_t w, std::uint64_t bits, const auto& visit) {
    for (; bits; bits &= bits - 1) visit(static_cast<Index>(w * 64 + std::countr_zero(bits)));
  }
  std::uint64_t& word(Index i, std::size_t w) { return bits_[i * words_ + w]; }
  const std::uint64_t& word(Index i, std::size_t w) const { return bits_[i * words_ + w]; }

  std::size_t words_;
  std::vector<std::uint64_t> bits_;
};

UpperMatrix adjacency_matrix(const OrderedPattern& pattern) {
  UpperMatrix adjacent(pattern.variables());
  for (Index r = 0; r < pattern.rows.size(); ++r) {
    const auto row = pattern.rows[r];
    for (std::size_t a = 0; a < row.size(); ++a) {
      for (std::size_t b = a + 1; b < row.size(); ++b) adjacent.join(row[a], row[b]);
    }
  }
  return adjacent;
}

}  // namespace

std::vector<EliminationStep> node_elimination(const graph::Pattern& pattern,
                                              const graph::Order& order) {
  UpperMatrix adjacent = adjacency_matrix(ordered(pattern, order));
  std::vector<EliminationStep> steps;
  steps.reserve(order.size());
  for (Index k = 0; k < pattern.variables(); ++k) {
    EliminationStep step{order[k], {}, {}};
    adjacent.for_each(k, [&](Index i) {
      step.neighbours.push_back(order[i]);
      adjacent.merge(i, k, [&](Index j) { step.fill.emplace_back(order[i], order[j]); });
    });
    steps.push_back(std::move(step));
  }
  return steps;
}

}  // namespace sg::elim
