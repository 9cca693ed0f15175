#include "lib/solve/gnc.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "lib/factor/initialize.h"
#include "lib/graph/components.h"

namespace sg::solve {
namespace {

constexpr double growth = 1.4;  // of mu in a round
constexpr double least_share = 1e-8;
constexpr double coarse = 0.05;  // tolerance of the rounds but the last
constexpr int coarse_iterations = 10;
constexpr int most_rounds = 200;
constexpr int last_rounds = 10;  // with weights of 0 and 1
constexpr double near = 5;       // u of what is taken back at last, to see
constexpr double replan =
    0.1;  // of the doubtful edges that a plan has: so many without use call for the next

// A problem without some edges, and its system.
struct Plan {
  std::vector<bool> out;
  factor::Problem problem;
  factor::LinearSystem system;
  LinearSolver solver;
};

factor::Problem without(const factor::Problem& problem, const std::vector<bool>& out) {
  factor::Problem result = problem;
  graph::Lists<>& rows = result.variables.pattern.rows;
  const graph::Lists<> all = std::exchange(rows, {});
  for (Index r = 0; r < all.size(); ++r) {
    const bool is_out = r < static_cast<Index>(out.size()) && out[r];
    rows.add(is_out ? std::span<const Index>{} : all[r]);
  }
  return result;
}

std::unique_ptr<Plan> make_plan(const factor::Problem& problem, const Planner& planner,
                                std::vector<bool> out) {
  auto plan = std::make_unique<Plan>();
  plan->problem = without(problem, out);
  plan->out = std::move(out);
  plan->system = factor::make_linear_system(plan->problem);
  plan->solver = planner(plan->problem, plan->system);
  return plan;
}

// Whether an edge tells all of one end from the other.
bool is_whole(const factor::Problem& problem, Index e) {
  const Graph& graph = *problem.graph;
  return graph.edge(e).size() == 2 && std::ranges::all_of(graph.edge(e), [&](Index v) {
           return graph.dim(v) == problem.model[e]->dim;
         });
}

// Edges of weight 0 whose ends others connect.
std::vector<bool> useless(const factor::Problem& problem, const std::vector<double>& weight) {
  const Graph& graph = *problem.graph;
  std::vector<bool> whole(graph.edges()), removed(graph.edges());
  for (Index e = 0; e < graph.edges(); ++e) {
    whole[e] = is_whole(problem, e);
    removed[e] = !whole[e] || weight[e] == 0;
  }
  const graph::Components parts = graph::components(graph, removed);
  std::vector<bool> result(graph.edges());
  for (Index e = 0; e < graph.edges(); ++e) {
    const auto ends = graph.edge(e);
    result[e] = whole[e] && weight[e] == 0 && parts.of[ends[0]] == parts.of[ends[1]];
  }
  return result;
}

double weight_of(double u, double mu) {
  if (!(u < (mu + 1) / mu)) return 0;  // and where it is not finite
  if (u <= mu / (mu + 1)) return 1;
  return std::sqrt(mu * (mu + 1) / u) - mu;
}

struct Run {
  const factor::Problem& problem;
  const Planner& planner;
  const GncOptions& options;
  factor::Values& values;
  const std::function<void(const Iteration&)>& report;
  std::unique_ptr<Plan> plan = {};
  GncResult result = {};

  bool doubts(Index e) const { return options.doubtful[e]; }
};

// s_e / c_e of the doubtful edges, 0 of the others.
std::vector<double> distrust(const Run& run) {
  std::vector<double> u(run.options.doubtful.size(), 0.0);
  for (Index e = 0; e < static_cast<Index>(u.size()); ++e) {
    if (run.doubts(e)) u[e] = factor::edge_chi2(run.problem, run.values, e) / run.options.bound[e];
  }
  return u;
}

// Makes a new plan where the one there is lacks an edge of some weight, or has many without.
void renew_plan(Run& run) {
  std::vector<bool> out = useless(run.problem, run.result.weight);
  Index had = 0, spare = 0, lacking = 0;
  for (Index e = 0; run.plan && e < static_cast<Index>(out.size()); ++e) {
    had += run.doubts(e) && !run.plan->out[e];
    spare += out[e] && !run.plan->out[e];
    lacking += !out[e] && run.plan->out[e];
  }
  if (!run.plan || lacking > 0 || spare > replan * had)
    run.plan = make_plan(run.problem, run.planner, std::move(out));
}

void solve_round(Run& run, double tolerance, int iterations) {
  renew_plan(run);
  BatchOptions batch = run.options.batch;
  batch.tolerance = std::max(tolerance, batch.tolerance);
  batch.iterations = iterations;
  batch.loss = {};
  for (std::size_t e = 0; e < run.plan->out.size(); ++e) {
    batch.loss.share.push_back(run.plan->out[e] ? 0 : std::max(run.result.weight[e], least_share));
  }
  const int before = run.result.batch.iterations;
  run.result.batch = optimize(run.plan->problem, run.plan->system, run.plan->solver, batch,
                              run.values, [&](Iteration iteration) {
                                iteration.number += before;
                                if (run.report) run.report(iteration);
                              });
  run.result.batch.iterations += before;
}

// Every landmark whose doubtful edges disagree goes to where the sum of its edges' min(s_e, c_e) is least, of the places
// where they put it one by one, or stays. A false majority, of edges that do not agree among themselves, is so found out.
void settle_landmarks(Run& run, const graph::Lists<>& edges_of) {
  const Graph& graph = *run.problem.graph;
  const std::vector<bool> placed(graph.vertices(), true);
  for (Index v = 0; v < graph.vertices(); ++v) {
    if (graph.role(v) != graph::Role::landmark || graph.fixed[v]) continue;
    const auto cost = [&] {
      double sum = 0;
      for (const Index e : edges_of[v]) {
        const double s = factor::edge_chi2(run.problem, run.values, e);
        sum += run.doubts(e) ? std::min(s, run.options.bound[e]) : s;
      }
      return sum;
    };
    double* const x = run.values.data() + run.problem.value_at[v];
    const std::vector<double> stay(x, run.values.data() + run.problem.value_at[v + 1]);
    std::vector<double> best = stay;
    double least = cost();
    for (const Index e : edges_of[v]) {
      if (run.result.weight[e] > 0 || !run.problem.model[e]->place) continue;
      if (!factor::place_vertex(run.problem, v, {&e, 1}, placed, run.values)) continue;
      if (const double sum = cost(); sum < least) {
        least = sum;
        std::copy_n(x, best.size(), best.begin());
      }
    }
    std::ranges::copy(best, x);
  }
}

// Gives the doubtful edges weights by their u.
void reweigh(Run& run, const auto& weight_of_u) {
  const std::vector<double> u = distrust(run);
  for (std::size_t e = 0; e < u.size(); ++e) {
    if (run.doubts(static_cast<Index>(e))) run.result.weight[e] = weight_of_u(u[e]);
  }
}

bool is_decided(const std::vector<double>& weight) {
  return std::ranges::all_of(weight, [](double w) { return w == 0 || w == 1; });
}

// The rounds with weights between 0 and 1. The first weights are those at the start, and not at the least squares of all
// edges: that estimate is the worse the more of them are false, and costs most to find.
void narrow(Run& run) {
  double most = 0;
  for (const double u : distrust(run)) {
    if (std::isfinite(u)) most = std::max(most, u);
  }
  if (most <= 1) return;
  double mu = 1 / (2 * most - 1);
  for (int k = 0; k < most_rounds && !run.result.batch.stopped; ++k, mu *= growth) {
    reweigh(run, [mu](double u) { return weight_of(u, mu); });
    if (k > 0 && is_decided(run.result.weight)) return;
    solve_round(run, coarse, coarse_iterations);
  }
}

// The rounds with weights of 0 and 1, until they stay.
void decide(Run& run, const graph::Lists<>& edges_of) {
  for (int k = 0; k < last_rounds && !run.result.batch.stopped; ++k) {
    settle_landmarks(run, edges_of);
    const std::vector<double> before = run.result.weight;
    reweigh(run, [](double u) { return u <= 1 ? 1 : 0; });
    if (k > 0 && run.result.weight == before) return;
    solve_round(run, 0, run.options.batch.iterations);
  }
}

double truncated_sum(const Run& run) {
  double sum = 0;
  for (Index e = 0; e < run.problem.graph->edges(); ++e) {
    const double s = factor::edge_chi2(run.problem, run.values, e);
    sum += run.doubts(e) ? std::min(s, run.options.bound[e]) : s;
  }
  return sum;
}

// Where a few true edges alone hold a part, leaving them out bends it, and none of them is believed again by itself. So
// those that are not far off are taken back together; what comes of it stays if the sum is lower.
void look_again(Run& run, const graph::Lists<>& edges_of) {
  const factor::Values values = run.values;
  const GncResult decided = run.result;
  const double sum = truncated_sum(run);
  reweigh(run, [](double u) { return u <= near ? 1 : 0; });
  if (run.result.weight == decided.weight) return;
  solve_round(run, 0, run.options.batch.iterations);
  decide(run, edges_of);
  if (truncated_sum(run) < sum) return;
  const int iterations = run.result.batch.iterations;
  run.values = values;
  run.result = decided;
  run.result.batch.iterations = iterations;
}

}  // namespace

GncResult graduate(const factor::Problem& problem, const Planner& plan, const GncOptions& options,
                   factor::Values& values, const std::function<void(const Iteration&)>& report) {
  Run run{problem, plan, options, values, report};
  run.result.weight.assign(options.doubtful.size(), 1.0);
  const double start = factor::chi2(problem, values);
  const graph::Lists<> edges_of =
      graph::transpose(problem.graph->edge_vertices, problem.graph->vertices());
  narrow(run);
  decide(run, edges_of);
  if (!run.result.batch.stopped) look_again(run, edges_of);
  run.result.batch.initial_chi2 = start;
  return std::move(run.result);
}

}  // namespace sg::solve
