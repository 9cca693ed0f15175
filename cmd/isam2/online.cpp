#include "cmd/isam2/online.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "cmd/common/table.h"
#include "lib/factor/space.h"
#include "lib/score/covariance.h"
#include "lib/solve/isam2_covariance.h"

namespace sg::isam2 {
namespace {

std::optional<SE3> estimated(const solve::Isam2Replay& replay, Index v) {
  const factor::Problem& problem = *replay.problem;
  std::vector<double> numbers(problem.value_at[v + 1] - problem.value_at[v]);
  factor::to_file(problem.space[v], replay.isam.estimate.data() + problem.value_at[v],
                  numbers.data());
  return score::pose_of(problem.space[v], numbers);
}

std::optional<SE3> true_pose(const score::Trajectory& truth, Id id) {
  const auto found = std::ranges::lower_bound(truth.id, id);
  if (found == truth.id.end() || *found != id) return {};
  return truth.pose[found - truth.id.begin()];
}

// By nearest rank.
double percentile(std::vector<double>& numbers, int percent) {
  const auto rank = (numbers.size() * percent + 99) / 100;
  const auto at = numbers.begin() + static_cast<std::ptrdiff_t>(std::max<std::size_t>(rank, 1) - 1);
  std::ranges::nth_element(numbers, at);
  return *at;
}

std::string spread(const std::string& what, std::vector<double> numbers) {
  std::string line = what + ":";
  for (const int percent : {50, 95, 99})
    line += " p" + std::to_string(percent) + " " + cmd::text(percentile(numbers, percent));
  return line + " max " + cmd::text(*std::ranges::max_element(numbers));
}

}  // namespace

std::optional<double> online_error(const solve::Isam2Replay& replay, const score::Trajectory& truth,
                                   Index step) {
  const Graph& graph = *replay.problem->graph;
  const Index first = replay.poses.pose.front(), newest = replay.poses.pose[step];
  const auto a = true_pose(truth, graph.id[first]), b = true_pose(truth, graph.id[newest]);
  const auto from = estimated(replay, first), to = estimated(replay, newest);
  if (!a || !b || !from || !to) return {};
  return (compose(*a, between(*from, *to)).t - b->t).norm();
}

double online_sigma(solve::Isam2Replay& replay, Index step) {
  const factor::Problem& problem = *replay.problem;
  const Index v = replay.poses.pose[step], j = problem.variables.vertex_variable[v];
  if (j < 0 || factor::is_held(problem, j)) return 0;
  const Eigen::MatrixXd covariance = solve::covariance(replay.isam, j);
  const double* x = replay.isam.estimate.data() + problem.value_at[v];
  return std::sqrt(score::position_covariance(problem.space[v], x, covariance).trace());
}

void add(Calibration& c, double ec, double seconds) {
  constexpr double kept = 0.99;
  c.weight = kept * c.weight + 1;
  c.x = kept * c.x + ec;
  c.y = kept * c.y + seconds;
  c.xx = kept * c.xx + ec * ec;
  c.xy = kept * c.xy + ec * seconds;
}

double ec_of(const Calibration& c, double seconds) {
  constexpr double usual = 1e-9;  // seconds per EC, until something is known
  if (c.weight < 2) return std::max(1.0, seconds / usual);
  const double spread = c.xx - c.x * c.x / c.weight;
  double slope = spread > 0 ? (c.xy - c.x * c.y / c.weight) / spread : 0;
  if (!(slope > 0)) slope = c.y / c.x;
  const double fixed = std::max(0.0, (c.y - slope * c.x) / c.weight);
  return std::max(1.0, (seconds - fixed) / slope);
}

std::vector<std::string> lines(const Summary& summary, const solve::Isam2Window& window,
                               bool budget) {
  std::vector<std::string> result{spread("update_s", summary.seconds),
                                  spread("ec_step", summary.ec)};
  if (!summary.error.empty()) {
    const double sum = std::accumulate(summary.error.begin(), summary.error.end(), 0.0);
    result.push_back("error: mean " + cmd::text(sum / static_cast<double>(summary.error.size())) +
                     " max " + cmd::text(*std::ranges::max_element(summary.error)));
  }
  if (window.dropped > 0)
    result.push_back(std::to_string(window.dropped) +
                     " edges named what had left, and were dropped");
  if (budget && window.working > 0)
    result.push_back("choosing: " + cmd::text(window.choosing / window.working) +
                     " of the time of the steps");
  if (budget)
    result.push_back(
        summary.violations == 0
            ? "no step ended above the budget"
            : std::to_string(summary.violations) +
                  " steps ended above the budget: it is less than what has to stay costs");
  return result;
}

}  // namespace sg::isam2
