#include "cmd/scoring/columns.h"

#include <algorithm>
#include <numeric>

#include "lib/factor/initialize.h"
#include "lib/graph/summary.h"
#include "lib/trees/connectivity.h"
#include "lib/trees/spanning_trees.h"

namespace sg::scoring {

const score::Trajectory& Subject::trajectory() {
  return cmd::once(trajectory_, [&] {
    score::Trajectory kept = score::trajectory(graph);
    return odometry ? score::filled(kept, *odometry) : kept;
  });
}

double Subject::log_trees() {
  return cmd::once(log_trees_, [&] { return trees::log_trees(graph, weights); });
}

std::optional<double> Subject::lambda2() {
  return cmd::once(lambda2_, [&] { return trees::algebraic_connectivity(graph, weights); });
}

const factor::Problem& Subject::problem() {
  return cmd::once(problem_, [&] { return factor::make_problem(graph); });
}

const factor::Values& Subject::values() {
  return cmd::once(values_, [&] { return factor::start_values(problem()); });
}

const score::TrajectoryError& Subject::error() {
  return cmd::once(error_, [&] {
    return score::trajectory_error(trajectory(), reference.value().trajectory, alignment);
  });
}

const std::optional<score::Divergence>& Subject::divergence() {
  return cmd::once(divergence_, [&] { return score::divergence(graph, reference.value().graph); });
}

std::optional<double> Subject::kld() {
  return divergence() ? std::optional(divergence()->kld) : std::nullopt;
}

std::optional<double> Subject::overconfidence() {
  return divergence() ? std::optional(divergence()->overconfidence) : std::nullopt;
}

const graph::Order& Row::order() {
  return cmd::once(order_,
                   [&] { return cmd::order_by(method, of.methods, of.graph, of.variables); });
}

elim::Wide Row::ec() {
  return elim::elimination_complexity(of.variables.pattern, order());
}

std::optional<solve::Elimination>& Row::elimination() {
  auto& result = cmd::once(elimination_,
                           [&] { return score::eliminated(of.problem(), of.values(), order()); });
  of.singular = of.singular || !result;
  return result;
}

std::optional<double> Row::log_det() {
  if (!elimination()) return std::nullopt;
  return solve::log_determinant(*elimination());
}

const std::vector<score::PoseSigma>& Row::sigmas() {
  return cmd::once(of.sigmas_, [&] {
    if (!elimination()) return std::vector<score::PoseSigma>{};
    return score::pose_sigmas(of.problem(), of.values(), *elimination());
  });
}

std::optional<double> Row::sigma_mean() {
  if (sigmas().empty()) return std::nullopt;
  const auto sum = [](double all, const auto& pose) { return all + pose.sigma; };
  return std::accumulate(sigmas().begin(), sigmas().end(), 0.0, sum) /
         static_cast<double>(sigmas().size());
}

std::optional<double> Row::sigma_max() {
  if (sigmas().empty()) return std::nullopt;
  return std::ranges::max(sigmas(), {}, &score::PoseSigma::sigma).sigma;
}

const std::vector<cmd::Column<Row>> columns{
    {"file", "The file", [](Row& row) { return row.of.file; }, "several files"},
    {"vertices", "How many there are", [](Row& row) { return row.of.graph.vertices(); }},
    {"edges", "How many there are", [](Row& row) { return row.of.graph.edges(); }},
    {"log_trees", "Logarithm of the weighted number of spanning trees",
     [](Row& row) { return row.of.log_trees(); }},
    {"lambda2", "Algebraic connectivity", [](Row& row) { return row.of.lambda2(); }},
    {"dopt", "Log determinant of the information at the file's estimate", &Row::log_det},
    {"sigma_mean", "Mean standard deviation of a pose's position", &Row::sigma_mean},
    {"sigma_max", "The largest", &Row::sigma_max},
    {"avg_obs", "Mean number of observations a landmark",
     [](Row& row) { return graph::average_observations(row.of.graph); }},
    {"matched", "Poses that graph and reference share",
     [](Row& row) { return row.of.error().matched; }, "--reference"},
    {"ate_rmse", "Absolute trajectory error, root mean square",
     [](Row& row) { return row.of.error().ate; }, "--reference"},
    {"rpe_rmse", "Relative pose error, its root mean square",
     [](Row& row) { return row.of.error().rpe; }, "--reference"},
    {"kld", "Divergence of the reference's Gaussian", [](Row& row) { return row.of.kld(); },
     "--reference"},
    {"overconfidence", "How many times too small a variance is",
     [](Row& row) { return row.of.overconfidence(); }, "--reference"},
    {"order", "The ordering", [](Row& row) { return row.method.label; }},
    {"ec", "Elimination complexity", &Row::ec},
};

}  // namespace sg::scoring
