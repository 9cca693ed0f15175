// Graduated non-convexity against all subsets of the doubtful edges: truncated least squares by brute force.
#include "lib/solve/gnc.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "lib/factor/initialize.h"
#include "lib/factor/residuals.h"
#include "lib/order/order.h"
#include "tests/unit/common.h"

using namespace sg;
using namespace sg::test;

namespace {

constexpr int poses = 8;

std::string edge(int a, int b, double x, double y, double theta) {
  std::string text = "EDGE_SE2 " + std::to_string(a) + " " + std::to_string(b);
  for (const double number : {x, y, theta}) text += " " + std::to_string(number);
  return text + " 100 0 0 100 0 400\n";
}

// A ring with closures between poses at random, the first `wrong` of which are false.
std::string ring(Random& random, int closures, int wrong) {
  const double turn = 2 * M_PI / poses;
  const auto noise = [&] { return uniform(random, -0.1, 0.1); };
  const auto measured = [&](int a, int b, bool is_false) {
    const auto x = [&](int k) { return std::sin(turn * k) / std::sin(turn / 2) / 2; };
    const auto y = [&](int k) { return (1 - std::cos(turn * k)) / std::sin(turn / 2) / 2; };
    const double c = std::cos(turn * a), s = std::sin(turn * a);
    const double dx = x(b) - x(a), dy = y(b) - y(a), off = is_false ? uniform(random, 2, 4) : 0;
    return edge(a, b, c * dx + s * dy + noise() + off, c * dy - s * dx + noise() - off,
                std::remainder(turn * (b - a), 2 * M_PI) + noise() / 2);
  };
  std::string edges;
  for (int k = 1; k < poses; ++k) edges += measured(k - 1, k, false);
  for (int k = 0; k < closures; ++k) {
    const int a = draw(random, 0, poses - 3);
    edges += measured(a, draw(random, a + 2, poses - 1), k < wrong);
  }
  return edges;
}

solve::LinearSolver plan(const factor::Problem& problem, const factor::LinearSystem& system) {
  graph::Order order(problem.variables.pattern.variables());
  for (Index j = 0; j < static_cast<Index>(order.size()); ++j) order[j] = j;
  return solve::find_backend("tree").make(system, order, 1);
}

// The least chi-square of the graph with these edges alone, plus the bounds of the doubtful others.
double truncated(const factor::Problem& problem, const solve::GncOptions& options,
                 const std::vector<double>& share) {
  factor::Values values = factor::start_values(problem);
  factor::LinearSystem system = factor::make_linear_system(problem);
  solve::BatchOptions batch;
  batch.loss.share = share;
  double sum = solve::optimize(problem, system, plan(problem, system), batch, values).chi2;
  for (std::size_t e = 0; e < share.size(); ++e) sum += (1 - share[e]) * options.bound[e];
  return sum;
}

}  // namespace

TEST_CASE("graduated non-convexity finds the subset of edges that is best of all", "[solve]") {
  for (int seed = 0; seed < 20; ++seed) {
    INFO("seed " << seed);
    Random random(static_cast<unsigned>(seed));
    const int closures = 6, wrong = seed % 4;
    const Graph graph = graph_of(ring(random, closures, wrong));
    const factor::Problem problem = factor::make_problem(graph);
    solve::GncOptions options;
    options.bound.assign(graph.edges(), factor::chi2_of_quantile(0.9999, 3));
    for (Index e = 0; e < graph.edges(); ++e) options.doubtful.push_back(e >= poses - 1);
    factor::Values values = factor::start_values(problem);
    const solve::GncResult result = solve::graduate(problem, plan, options, values);
    CHECK(result.batch.converged);
    double least = std::numeric_limits<double>::infinity();
    std::vector<double> best;
    for (int subset = 0; subset < 1 << closures; ++subset) {
      std::vector<double> share(graph.edges(), 1.0);
      for (int k = 0; k < closures; ++k) share[poses - 1 + k] = subset >> k & 1;
      const double sum = truncated(problem, options, share);
      if (sum < least) least = sum, best = share;
    }
    CHECK(result.weight == best);
    CHECK(truncated(problem, options, result.weight) == Approx(least));
    for (int k = 0; k < closures; ++k) CHECK(result.weight[poses - 1 + k] == (k < wrong ? 0 : 1));
  }
}

TEST_CASE("an edge that is left out leaves no vertex undetermined", "[solve]") {
  // Two sights of one landmark that disagree, and two parts of a trajectory that closures alone join.
  const Graph graph = graph_of(
      "EDGE_SE2 0 1 1 0 0 100 0 0 100 0 100\nEDGE_SE2 3 4 1 0 0 100 0 0 100 0 100\n"
      "EDGE_SE2 1 3 1 0 0 100 0 0 100 0 100\nEDGE_SE2 1 3 9 0 0 100 0 0 100 0 100\n"
      "EDGE_SE2_XY 0 9 0 5 100 0 100\nEDGE_SE2_XY 1 9 30 5 100 0 100\n");
  const factor::Problem problem = factor::make_problem(graph);
  solve::GncOptions options;
  options.doubtful = {false, false, true, true, true, true};
  options.bound.assign(graph.edges(), 20);
  factor::Values values = factor::start_values(problem);
  const solve::GncResult result = solve::graduate(problem, plan, options, values);
  CHECK(result.batch.converged);
  for (const double x : values) CHECK(std::isfinite(x));
  CHECK(result.weight[2] + result.weight[3] <= 1);
  CHECK(result.weight[4] + result.weight[5] <= 1);
}

TEST_CASE("where all edges agree, graduated non-convexity keeps them", "[solve]") {
  Random random(5);
  const Graph graph = graph_of(ring(random, 4, 0));
  const factor::Problem problem = factor::make_problem(graph);
  solve::GncOptions options;
  options.doubtful.assign(graph.edges(), true);
  options.bound.assign(graph.edges(), 20);
  factor::Values values = factor::start_values(problem), plainly = values;
  const solve::GncResult result = solve::graduate(problem, plan, options, values);
  CHECK(result.weight == std::vector<double>(graph.edges(), 1.0));
  factor::LinearSystem system = factor::make_linear_system(problem);
  const double chi2 = solve::optimize(problem, system, plan(problem, system), {}, plainly).chi2;
  CHECK(result.batch.chi2 == Approx(chi2));
}
