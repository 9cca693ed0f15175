// Optimization, covariances, and how far one trajectory is from another.
#include <optional>

#include "cmd/common/estimates.h"
#include "cmd/solving/plan.h"
#include "formats/applied.h"
#include "lib/factor/initialize.h"
#include "lib/factor/linearize.h"
#include "lib/order/order.h"
#include "lib/score/covariance.h"
#include "lib/score/sigma.h"
#include "lib/score/trajectory.h"
#include "lib/solve/best_start.h"
#include "lib/solve/start.h"
#include "lib/text/words.h"
#include "python/bind.h"

namespace sg::python {
namespace {

struct Solution {
  SharedGraph graph;
  solve::BatchResult result;
};

Solution solve(const Graph& graph, const std::string& start, bool gauss_newton,
               std::optional<int> iterations, double tolerance, const py::object& order,
               int threads) {
  const OrderArgument argument = order_argument(order);
  return unlocked([&] {
    const factor::Problem problem = factor::make_problem(graph);
    factor::LinearSystem system = factor::make_linear_system(problem);
    const solve::LinearSolver solver = solve::backends().front().make(
        system, chosen_order(argument, 1, graph, graph::graph_pattern(graph)), threads);
    solve::BatchOptions options;
    options.method =
        gauss_newton ? solve::BatchMethod::gauss_newton : solve::BatchMethod::levenberg_marquardt;
    options.iterations = iterations.value_or(solving::most_iterations);
    options.tolerance = tolerance;
    std::vector<solve::Candidate> starts;
    if (start.empty()) {
      starts = solve::default_candidates(problem, {});
    } else {
      starts.push_back(solve::make_candidate(problem, start, {}));
    }
    factor::Values values;
    const solve::BatchResult result =
        solve::optimize_from_best(problem, system, solver, options, std::move(starts),
                                  start.empty() && !iterations, values, {}, {});
    if (!result.converged && !iterations)
      throw text::computation_error("not converged after " + std::to_string(result.iterations) +
                                    " iterations, chi-square " + text::format_number(result.chi2) +
                                    "; iterations=N returns what N of them reach");
    return Solution{
        shared(formats::applied(
            graph, cmd::estimate_changes(problem, values, solving::moved(problem)), {})),
        result};
  });
}

double chi2(const Graph& graph) {
  return unlocked([&] {
    const factor::Problem problem = factor::make_problem(graph);
    return factor::finite_chi2(problem, factor::start_values(problem), {});
  });
}

// A graph at its estimates, eliminated.
struct AtEstimate {
  factor::Problem problem;
  factor::Values values;
  solve::Elimination elimination;
};
AtEstimate at_estimate(const Graph& graph) {
  factor::Problem problem = factor::make_problem(graph);
  factor::Values values = factor::start_values(problem);
  const graph::GraphPattern variables = graph::graph_pattern(graph);
  auto elimination =
      score::eliminated(problem, values, chosen_order({"wmf", {}}, 1, graph, variables));
  if (!elimination) throw score::singular_error(problem, values);
  return {std::move(problem), std::move(values), std::move(*elimination)};
}

py::array_t<double> matrix(const Eigen::MatrixXd& from) {
  py::array_t<double> result({from.rows(), from.cols()});
  for (Eigen::Index i = 0; i < from.rows(); ++i)
    for (Eigen::Index j = 0; j < from.cols(); ++j) result.mutable_at(i, j) = from(i, j);
  return result;
}

py::dict covariances(const Graph& graph) {
  const auto blocks = unlocked([&] {
    AtEstimate at = at_estimate(graph);
    return score::vertex_covariances(at.problem, at.elimination);
  });
  py::dict result;
  for (Index v = 0; v < graph.vertices(); ++v) result[py::int_(graph.id[v])] = matrix(blocks[v]);
  return result;
}

py::array_t<double> joint_covariance(const Graph& graph, Id a, Id b) {
  return matrix(unlocked([&] {
    const auto u = graph::find_vertex(graph, a), v = graph::find_vertex(graph, b);
    if (!u || !v)
      throw text::usage_error("there is no vertex " + std::to_string(u ? b : a) + " in the graph");
    AtEstimate at = at_estimate(graph);
    return score::joint_covariance(at.problem, at.elimination, *u, *v);
  }));
}

py::tuple sigmas(const Graph& graph) {
  std::vector<Index> vertices;
  std::vector<double> numbers;
  unlocked([&] {
    AtEstimate at = at_estimate(graph);
    for (const auto& [vertex, sigma] : score::pose_sigmas(at.problem, at.values, at.elimination)) {
      vertices.push_back(vertex);
      numbers.push_back(sigma);
    }
  });
  return py::make_tuple(ids_of(graph, vertices), array(numbers));
}

py::dict trajectory_error(const Graph& graph, const Graph& reference, const std::string& align) {
  const auto alignment = score::alignment(align);
  if (!alignment) throw text::usage_error("align: none, se or sim, not '" + align + "'");
  const score::TrajectoryError error = unlocked([&] {
    return score::trajectory_error(score::trajectory(graph), score::trajectory(reference),
                                   *alignment);
  });
  using namespace py::literals;
  return py::dict("matched"_a = error.matched, "ate"_a = error.ate, "rpe"_a = error.rpe);
}

}  // namespace

void bind_solving(py::module_& module) {
  using namespace py::literals;
  py::class_<Solution>(module, "Solution", "What an optimization reached.")
      .def_readonly("graph", &Solution::graph, "the graph at its new estimates")
      .def_property_readonly("chi2", [](const Solution& from) { return from.result.chi2; })
      .def_property_readonly("initial_chi2",
                             [](const Solution& from) { return from.result.initial_chi2; })
      .def_property_readonly("iterations",
                             [](const Solution& from) { return from.result.iterations; })
      .def_property_readonly("converged",
                             [](const Solution& from) { return from.result.converged; });
  module.def("solve", &solve, "graph"_a, py::kw_only(), "start"_a = "", "gauss_newton"_a = false,
             "iterations"_a = py::none(), "tolerance"_a = 1e-9,
             "order"_a = std::string(order::default_ordering), "threads"_a = 1,
             "Optimize a graph: sg-solve(1). Raises ComputationError where that does not converge, "
             "unless\niterations says after how many to stop.");
  module.def("chi2", &chi2, "graph"_a, "The chi-square of the graph at its estimates.");
  module.def("covariances", &covariances, "graph"_a,
             "{id: marginal covariance of the vertex's step} at the estimates: sg-cov(1).");
  module.def("joint_covariance", &joint_covariance, "graph"_a, "a"_a, "b"_a,
             "The covariance of two vertices together, the scalars of a before those of b.");
  module.def("sigmas", &sigmas, "graph"_a,
             "(ids, standard deviations of position) of the poses, at the estimates.");
  module.def("trajectory_error", &trajectory_error, "graph"_a, "reference"_a, "align"_a = "se",
             "matched poses, ate and rpe against a reference: sg-score(1).");
}

}  // namespace sg::python
