// Where the cost of a graph sits: the map shaded by it, and what costs most.
#pragma once

#include <string>
#include <vector>

#include "cmd/report/sheet.h"
#include "cmd/report/study.h"

namespace sg::report {

constexpr std::size_t most_listed = 25;  // of what costs most

// Each with the largest first.
Sheet costliest_variables(const Study& study, const cmd::Method& method);
Sheet costliest_cliques(const Study& study, const cmd::Method& method);
Sheet costliest_edges(const Study& study, const cmd::Method& method);

struct Map {
  std::string call;
  std::string svg;  // empty where the graph has no map, which a note tells
  struct Spot {     // a vertex on it, in points
    Id id;
    double x, y;
    std::string cost;
  };
  std::vector<Spot> spots;  // of the costliest variables
};
Map map(Study& study, const cmd::Method& method, const graph::Order& order);

}  // namespace sg::report
