// Where the cost of an elimination sits, as colours.
#pragma once

#include <string>
#include <vector>

#include "cmd/plot/picture.h"
#include "cmd/plot/words.h"
#include "lib/graph/pattern.h"

namespace sg::plot {

// From light yellow (0) by orange and red to dark red (1).
Color heat(double value);

// What every variable costs under an order, and what they cost together: EC; and what EC would lose without an edge.
struct Costs {
  std::vector<double> vertex;    // d_f (d_f + d_s)^2 of every vertex; 0 of constants
  std::vector<Index> ascending;  // the vertices that are variables, by cost
  std::vector<double> edge;      // the price of every edge; 0 of free ones
  elim::Wide ec = 0;
  double total = 0;         // the same
  double largest = 0;       // of vertices
  double largest_edge = 0;  // of edges
};
Costs costs(const graph::GraphPattern& variables, const graph::Order& order);

// The fewest variables that hold half of the cost.
Index half(const Costs& costs);

// What stands above a map of costs: EC, its concentration, and whether the estimates look unsolved.
Heading cost_heading(const Graph& graph, const Costs& costs, const std::string& order);

}  // namespace sg::plot
