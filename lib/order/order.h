// Elimination orderings: one table that names them all.
//
// An ordering sees the block pattern of A (lib/graph/pattern.h) and returns a permutation of its
// variables, the first to be eliminated first. It works on the block graph: variables weigh their
// dimension where the method knows weights. Ties and the order of rows decide what a heuristic
// gives, so they are pinned down: variables by ascending id, rows in file order; and the same
// pattern, options and library version give the same order on any machine.
//
// A new ordering: a file lib/order/NAME.cpp, its declaration in methods.h, its row in order.cpp.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "lib/elim/score.h"
#include "lib/graph/pattern.h"

namespace sg::order {

// How long an anytime ordering may go on: so many tries, or seconds where those are not 0.
struct Budget {
  int tries = 200;
  double seconds = 0;
};
// "2.5": seconds; "500t": tries. Throws a usage Error, about this option, for anything else.
Budget parse_budget(std::string_view text, std::string_view option = "--budget");

// A better order, as soon as an anytime ordering has found it.
struct Improvement {
  std::string_view how;  // a method's name, "coarse", "polish", "restart" or "local"
  int tries;             // so far
  double seconds;        // so far
  elim::Wide ec;
  double price;  // OrderOptions::price; 0 without one
};

// Seeds that users give count from 1, as those of worlds do; draws from 0, by which ties go as the
// pattern has them.
constexpr std::uint64_t draw_of(std::uint64_t seed) {
  return seed - 1;
}

// What an ordering may want to know beyond the pattern. Left empty, each field says nothing.
struct OrderOptions {
  std::uint64_t seed = 0;         // of methods that draw at random: which draw
  std::vector<Index> last;        // variables to be eliminated after all others, in any order
  std::vector<Index> file_order;  // all variables as the file lists them; empty: as numbered
  std::vector<bool> landmark;     // of every variable; empty: none is
  Budget budget;                  // of best
  // What best minimizes instead of EC; may be empty. Called by several threads at a time.
  std::function<double(const graph::Pattern&, const graph::Order&)> price;
  std::function<void(const Improvement&)> report;  // of best; may be empty
  std::function<bool()>
      stop;  // of best, and may be empty; asked by any thread: is the best so far enough?
};

struct Ordering {
  std::string_view name;
  std::string_view description;  // one line, lower case, for --help and the manual
  graph::Order (*compute)(const graph::Pattern&, const OrderOptions&);
};

// What is meant where nobody names one.
constexpr std::string_view default_ordering = "colamd";

// All orderings, in the order in which --help lists them.
std::span<const Ordering> orderings();
// Throws a usage Error that lists the names.
const Ordering& find_ordering(std::string_view name);

// The order of a method. `last` holds for every method: colamd, amd and wmf have it as a constraint
// and take it into account; of the others the order is computed without it, and the variables of
// `last` are then moved to its end, in their relative order. Throws std::out_of_range where one of
// them is no variable of the pattern.
graph::Order elimination_order(const Ordering& ordering, const graph::Pattern& pattern,
                               const OrderOptions& options = {});
graph::Order elimination_order(std::string_view name, const graph::Pattern& pattern,
                               const OrderOptions& options = {});

// The options that a graph answers by itself: file_order and landmark.
OrderOptions order_options(const Graph& graph, const graph::GraphPattern& pattern);

}  // namespace sg::order
