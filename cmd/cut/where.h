// The conditions of sg-cut --where: comparisons of an edge's columns, joined by and and or, of which and binds closer:
//     quantile < 0.9999 or role = odometry
#pragma once

#include <string>
#include <vector>

#include "lib/graph/graph.h"

namespace sg::cut {

struct Comparison {
  std::size_t column;
  std::string op;     // < <= > >= = !=
  std::string value;  // a number where the column is one
};
using Condition = std::vector<std::vector<Comparison>>;  // one of these holds, all in it do

// Throws a usage Error that says what is wrong.
Condition parse_condition(const std::string& text);

// The edges for which it holds. Chi-squares are those at the file's estimates.
std::vector<bool> edges_where(const Graph& graph, const Condition& condition);

// "chi2, dof, ...", for the help.
std::string where_columns();

}  // namespace sg::cut
