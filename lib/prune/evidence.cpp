#include "lib/prune/evidence.h"

#include <Eigen/Eigenvalues>

#include "lib/factor/gauge.h"
#include "lib/factor/space.h"
#include "lib/graph/components.h"

namespace sg::prune {
namespace {

Index count_poses(const Graph& graph) {
  Index poses = 0;
  for (Index v = 0; v < graph.vertices(); ++v) poses += graph.role(v) == graph::Role::pose;
  return poses;
}

constexpr double least_motion = 1e-9;  // beside the largest, squared

// An orthonormal basis of what these columns span.
Eigen::MatrixXd basis(const Eigen::MatrixXd& columns) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> spectrum(columns.transpose() * columns);
  const Eigen::VectorXd& squares = spectrum.eigenvalues();
  Eigen::MatrixXd result(columns.rows(), 0);
  for (Eigen::Index k = 0; k < squares.size(); ++k) {
    if (!(squares(k) > least_motion * squares(squares.size() - 1))) continue;
    result.conservativeResize(Eigen::NoChange, result.cols() + 1);
    result.rightCols(1) = columns * spectrum.eigenvectors().col(k) / std::sqrt(squares(k));
  }
  return result;
}

// Closes a row of this height whose variables, and whose numbers but for b, are there.
void close_row(Evidence& evidence, int height) {
  evidence.pattern.rows.close();
  evidence.numbers.insert(evidence.numbers.end(), height, 0.0);
  evidence.height.push_back(height);
  evidence.begin.push_back(static_cast<Offset>(evidence.numbers.size()));
}

// A difference of its first variable to each of the others, and to the ground for all constants.
void add_tree_row(Evidence& evidence, std::span<const Index> variables, bool constants) {
  const auto n = static_cast<int>(variables.size());
  const int height = n == 0 ? 0 : n - 1 + (constants ? 1 : 0);
  evidence.pattern.rows.items.insert(evidence.pattern.rows.items.end(), variables.begin(),
                                     variables.end());
  for (int k = 0; k < n; ++k) {
    for (int i = 0; i < height; ++i) evidence.numbers.push_back(k == 0 ? 1 : (i == k - 1 ? -1 : 0));
  }
  close_row(evidence, height);
}

}  // namespace

Evidence measured_evidence(const factor::Problem& problem, const factor::Values& values) {
  factor::LinearSystem system = factor::linearized(problem, values);
  Evidence evidence;
  evidence.pattern = problem.variables.pattern;
  evidence.height = std::move(system.height);
  evidence.begin = std::move(system.begin);
  evidence.numbers = std::move(system.numbers);
  evidence.step_at = problem.step_at;
  evidence.poses = count_poses(*problem.graph);
  evidence.held = problem.held >= 0;
  evidence.variable_vertex = problem.variables.variable_vertex;
  evidence.vertex_variable = problem.variables.vertex_variable;
  Eigen::MatrixXd motions = factor::rigid_motions(problem, values);
  for (Index j = 0; j < evidence.pattern.variables(); ++j) {
    const Index v = evidence.variable_vertex[j];
    for (int k = 0; k < evidence.pattern.dim[j]; ++k) {
      const bool places =
          problem.graph->role(v) == graph::Role::pose && !factor::is_turn(problem.space[v], k);
      evidence.position.push_back(places && j != problem.held);
      if (!places) motions.row(evidence.step_at[j] + k).setZero();
    }
  }
  evidence.drift = basis(motions);
  return evidence;
}

Evidence tree_evidence(const Graph& graph) {
  graph::GraphPattern variables = graph::graph_pattern(graph);
  const Index n = variables.pattern.variables();
  Evidence evidence;
  evidence.pattern.dim.assign(n, 1);
  evidence.begin.push_back(0);
  evidence.position.assign(n, false);
  evidence.step_at = factor::starts(evidence.pattern.dim);
  evidence.poses = count_poses(graph);
  std::vector<bool> grounded(graph.vertices(), false);  // components, by their first vertex
  const graph::Components parts = graph::components(graph);
  for (Index v = 0; v < graph.vertices(); ++v) {
    if (graph.fixed[v]) grounded[parts.of[v]] = true;
  }
  for (Index e = 0; e < graph.edges(); ++e) {
    const auto row = variables.pattern.rows[e];
    bool constants = false;
    for (const Index v : graph.edge(e)) constants = constants || graph.fixed[v];
    add_tree_row(evidence, row, constants);
  }
  for (Index j = 0; j < n; ++j) {
    const Index part = parts.of[variables.variable_vertex[j]];
    if (grounded[part]) continue;
    grounded[part] = true;
    add_tree_row(evidence, std::span(&j, 1), true);
  }
  evidence.variable_vertex = std::move(variables.variable_vertex);
  evidence.vertex_variable = std::move(variables.vertex_variable);
  return evidence;
}

}  // namespace sg::prune
