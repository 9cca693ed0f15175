// What the parts of `best` (best.cpp) share: the search as it stands, its budget, and what it judges orders by.
#pragma once

#include <string_view>
#include <vector>

#include "lib/order/order.h"
#include "lib/order/stopwatch.h"

namespace sg::order {

// What an order is judged by: the caller's price, or else nothing, and then EC.
struct Price {
  double asked = 0;
  elim::Wide ec = 0;
  friend bool operator<(const Price& a, const Price& b) {
    return a.asked != b.asked ? a.asked < b.asked : a.ec < b.ec;
  }
};

// What is known so far.
struct Search {
  const graph::Pattern& pattern;
  const OrderOptions& options;
  graph::Adjacency graph;
  std::vector<int> stage = {};  // 1 of the variables of `last`
  graph::Order order = {};      // the best so far
  Price price = {};             // of it
  Stopwatch clock = {};
  double amd_seconds = 0;  // of amd with a score
};

// Whether it has been asked to stop.
bool stopped(const Search& search);

// Whether the budget has so many seconds left, or time for so many times what amd took.
bool lasts(const Search& search, double seconds);
bool time_for(const Search& search, double effort);

Price price_of(const Search& search, const graph::Order& order, elim::Wide ec);

void take(Search& search, const graph::Order& order, const Price& price);

// Tells the caller of the best so far, by what it was found and after how many tries.
void report(const Search& search, std::string_view how, int tries);

}  // namespace sg::order
