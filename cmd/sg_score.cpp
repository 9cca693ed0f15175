// sg-score: what a graph is worth, and what it costs, in one row.
#include <algorithm>

#include "cmd/common/command.h"
#include "cmd/common/method.h"
#include "cmd/common/options.h"
#include "cmd/common/table.h"
#include "formats/tum.h"
#include "lib/elim/score.h"
#include "lib/factor/initialize.h"
#include "lib/geometry/numbers.h"
#include "lib/graph/summary.h"
#include "lib/score/dopt.h"
#include "lib/score/trajectory.h"
#include "lib/trees/connectivity.h"

namespace {

struct Options {
  sg::Inputs inputs;
  sg::OutputOptions output;
  sg::TableOptions table;
  sg::MethodOptions method;
  std::string weights = "unit";
  std::string reference;
  std::string align = "se";
};

struct Row {
  const Options& options;
  const std::optional<sg::Trajectory>& reference;
  const std::string& file;
  const sg::Graph& graph;
  sg::TreeWeights weights;
  sg::GraphPattern variables;
  sg::Method method;
  std::optional<sg::Order> order_ = {};
  std::optional<sg::TrajectoryError> error_ = {};

  const sg::Order& order() {
    return sg::once(order_, [&] { return sg::order_by(method, options.method, graph, variables); });
  }
  sg::Wide ec() { return sg::elimination_complexity(variables.pattern, order()); }
  double log_det() {
    const sg::Problem problem = sg::make_problem(graph);
    return sg::log_det_information(problem, sg::start_values(problem), order());
  }
  const sg::TrajectoryError& error() {
    return sg::once(error_, [&] {
      return sg::trajectory_error(sg::trajectory(graph), reference.value(),
                                  sg::alignment(options.align).value());
    });
  }
};

const std::vector<sg::Column<Row>> columns{
    {"file", "The file", [](Row& row) { return row.file; }, "several files"},
    {"vertices", "How many there are", [](Row& row) { return row.graph.vertices(); }},
    {"edges", "How many there are", [](Row& row) { return row.graph.edges(); }},
    {"log_trees", "Logarithm of the weighted number of spanning trees",
     [](Row& row) { return sg::log_trees(row.graph, row.weights); }},
    {"lambda2", "Algebraic connectivity",
     [](Row& row) { return sg::algebraic_connectivity(row.graph, row.weights); }},
    {"dopt", "Log determinant of the information at the file's estimate", &Row::log_det},
    {"avg_obs", "Mean number of observations a landmark",
     [](Row& row) { return sg::average_observations(row.graph); }},
    {"matched", "Poses that graph and reference share",
     [](Row& row) { return row.error().matched; }, "--reference"},
    {"ate_rmse", "Absolute trajectory error, its root mean square",
     [](Row& row) { return row.error().ate; }, "--reference"},
    {"rpe_rmse", "Relative pose error, its root mean square",
     [](Row& row) { return row.error().rpe; }, "--reference"},
    {"order", "The ordering", [](Row& row) { return row.method.label; }},
    {"ec", "Elimination complexity", &Row::ec},
};

void add_options(sg::Command& command, Options& options) {
  sg::add_inputs(command, options.inputs);
  sg::add_weights(command.app, options.weights, "Of log_trees and lambda2");
  command.app
      .add_option("--reference", options.reference, "A graph or a TUM trajectory, for ATE and RPE")
      ->option_text("FILE");
  command.app
      .add_option("--align", options.align,
                  "Move onto it: se (rigidly; the default), sim (and\nscale), none")
      ->option_text("HOW")
      ->check(sg::one_of({"se", "sim", "none"}));
  sg::add_method(command, options.method);
  sg::add_output(command, options.output);
  sg::add_table(command, options.table, columns);
}

sg::Trajectory read_trajectory(const std::string& path, const sg::ReadOptions& options) {
  const sg::Text text = sg::read_text(path);
  if (!sg::looks_like_tum(text.view))
    return sg::trajectory(sg::read_graph_text(text, path, options));
  sg::Trajectory result;
  for (const auto& [id, n] : sg::read_tum(text.view, path)) {
    result.id.push_back(id);
    result.pose.push_back(sg::normalized(sg::se3(n.data())));
  }
  return result;
}

// Columns of a reference are asked for in vain without one.
void check_columns(const Options& options) {
  for (const auto& column : columns) {
    const auto& asked = options.table.columns;
    const bool wanted = std::find(asked.begin(), asked.end(), column.name) != asked.end();
    if (wanted && column.needs == "--reference" && options.reference.empty())
      throw sg::usage_error("column '" + column.name + "' wants a --reference");
  }
}

void score(const sg::Command& /*command*/, const Options& options) {
  sg::check(options.method);
  check_columns(options);
  const sg::Given given{{"several files", options.inputs.paths.size() > 1},
                        {"--reference", !options.reference.empty()}};
  sg::Output output(options.output.path);
  sg::Table table(options.table, columns, given, output);
  std::optional<sg::Trajectory> reference;
  if (!options.reference.empty())
    reference = read_trajectory(options.reference, options.inputs.options);
  const sg::TreeWeights weights = sg::tree_weights(options.weights).value();
  for (const auto& path : options.inputs.paths) {
    const sg::Graph graph = sg::read(options.inputs, path);
    const sg::Method method = sg::methods(options.method, graph).front();
    table.row({options, reference, path, graph, weights, sg::graph_pattern(graph), method});
  }
  output.commit();
}

}  // namespace

int main(int argc, char** argv) {
  return sg::run(sg::Command("sg-score", "Score what a graph is worth, and what it costs."), argc,
                 argv, add_options, score);
}
