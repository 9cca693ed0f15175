#include "cmd/plot/unsolved.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "cmd/plot/words.h"
#include "formats/thin.h"
#include "lib/factor/initialize.h"
#include "lib/factor/linearize.h"
#include "lib/factor/residuals.h"
#include "lib/graph/replay.h"

namespace sg::plot {
namespace {

// Of more edges, some, which say the same: those of which a graph that was read thinly knows what they measure. (Where estimates
// have to be composed along edges, all.)
Index stride(const Graph& graph) {
  constexpr formats::Thin thin;
  if (graph.edges_only || graph.edges() <= thin.first) return 1;
  return thin.every * (1 + graph.edges() / (thin.every * thin.first));
}

// The same vertices with every so many-th edge.
Graph sampled(const Graph& graph) {
  const Index every = stride(graph);
  Graph result;
  result.file = graph.file;
  result.text = graph.text;
  result.tags = graph.tags;
  result.id = graph.id;
  result.vertex_type = graph.vertex_type;
  result.vertex_line = graph.vertex_line;
  result.fixed = graph.fixed;
  result.params = graph.params;
  result.edges_only = graph.edges_only;
  for (Index e = 0; e < graph.edges(); e += every) {
    result.edge_type.push_back(graph.edge_type[e]);
    result.edge_line.push_back(graph.edge_line[e]);
    result.edge_vertices.add(graph.edge(e));
  }
  return result;
}

// Of edges that measure anything.
std::map<graph::EdgeRole, std::vector<double>> errors_by_role(const Graph& graph) {
  const factor::Problem problem = factor::make_problem(graph);
  const factor::Values values = factor::start_values(problem);
  const std::vector<graph::EdgeRole> roles = graph::edge_roles(graph, graph::pose_index(graph));
  std::map<graph::EdgeRole, std::vector<double>> errors;
  for (Index e = 0; e < graph.edges(); ++e) {
    const int degrees = factor::degrees_of_freedom(problem, e);
    if (degrees == 0) continue;
    const double chi2 = factor::edge_chi2(problem, values, e);
    errors[roles[e]].push_back(std::isfinite(chi2) ? chi2 / degrees
                                                   : std::numeric_limits<double>::infinity());
  }
  return errors;
}

}  // namespace

Contradiction contradiction(const Graph& graph) {
  Contradiction worst;
  try {
    for (auto& [role, errors] : errors_by_role(sampled(graph))) {
      const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
      std::ranges::nth_element(errors, middle);
      if (*middle > worst.median) worst = {name_of(role), *middle};
    }
  } catch (const text::Error&) {
    return {};
  }
  return worst;
}

std::string unsolved_hint(const Graph& graph) {
  const Contradiction worst = contradiction(graph);
  if (!(worst.median > most_of_solved)) return "";
  const std::string off = std::isfinite(worst.median)
                              ? "by " + std::to_string(std::llround(std::sqrt(worst.median))) +
                                    " standard deviations or more"
                              : "beyond all numbers";
  return "These estimates look unsolved: half of the " + worst.kind + " are off " + off +
         ". Try: sg-solve FILE | sg-plot map";
}

}  // namespace sg::plot
