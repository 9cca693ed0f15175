// sg-score: what a graph is worth, and what it costs, in one row.
#include <cmath>

#include "cmd/common/command.h"
#include "cmd/common/method.h"
#include "cmd/common/table.h"
#include "formats/tum.h"
#include "lib/elim/score.h"
#include "lib/factor/initialize.h"
#include "lib/geometry/numbers.h"
#include "lib/score/connectivity.h"
#include "lib/score/dopt.h"
#include "lib/score/trajectory.h"

namespace {

const std::vector<std::string_view> columns{"file",     "vertices", "edges",   "log_trees",
                                            "lambda2",  "dopt",     "avg_obs", "matched",
                                            "ate_rmse", "rpe_rmse", "order",   "ec"};

struct Options {
  sg::Inputs inputs;
  sg::OutputOptions output;
  sg::TableOptions table;
  sg::MethodOptions method;
  std::string weights = "unit";
  std::string reference;
  std::string align = "se";
};

void add_options(sg::Command& command, Options& options) {
  sg::add_inputs(command, options.inputs);
  command.app
      .add_option("--weights", options.weights,
                  "Of log_trees and lambda2: unit (default),\ntranslation, rotation, dopt")
      ->type_name("KIND")
      ->check(CLI::IsMember({"unit", "translation", "rotation", "dopt"}).description(""));
  command.app
      .add_option("--reference", options.reference, "A graph or a TUM trajectory, for ATE and RPE")
      ->type_name("FILE");
  command.app
      .add_option("--align", options.align,
                  "Move onto it: se (rigidly; the default), sim (and\nscale), none")
      ->type_name("HOW")
      ->check(CLI::IsMember({"se", "sim", "none"}).description(""));
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

sg::Cell cell(const std::optional<double>& value) {
  return value ? sg::Cell(*value) : sg::Cell();
}

sg::Cell log_det(const sg::Graph& graph, const sg::Order& order) {
  const sg::Problem problem = sg::make_problem(graph);
  return sg::log_det_information(problem, sg::start_values(problem), order);
}

void score_file(sg::Table& table, const std::string& path, const Options& options,
                const std::optional<sg::Trajectory>& reference) {
  const sg::Graph graph = sg::read(options.inputs, path);
  const sg::TreeWeights weights = sg::tree_weights(options.weights).value();
  const sg::GraphPattern variables = sg::graph_pattern(graph);
  const sg::Method method = sg::methods(options.method, graph).front();
  const bool eliminates = table.wants("ec") || table.wants("dopt");
  const sg::Order order =
      eliminates ? sg::order_by(method, options.method, graph, variables) : sg::Order{};
  sg::TrajectoryError error;
  if (reference && (table.wants("ate_rmse") || table.wants("rpe_rmse") || table.wants("matched"))) {
    error = sg::trajectory_error(sg::trajectory(graph), *reference,
                                 sg::alignment(options.align).value());
  }
  table.row({path, std::int64_t{graph.vertices()}, std::int64_t{graph.edges()},
             table.wants("log_trees") ? sg::Cell(sg::log_trees(graph, weights)) : sg::Cell(),
             table.wants("lambda2") ? cell(sg::algebraic_connectivity(graph, weights)) : sg::Cell(),
             table.wants("dopt") ? log_det(graph, order) : sg::Cell(),
             cell(sg::average_observations(graph)), static_cast<std::int64_t>(error.matched),
             cell(error.ate), cell(error.rpe), method.label,
             table.wants("ec") ? sg::Cell(sg::elimination_complexity(variables.pattern, order))
                               : sg::Cell()});
}

bool is_trajectory_column(std::string_view name) {
  return name == "matched" || name == "ate_rmse" || name == "rpe_rmse";
}

// All columns, without `file` where there is one file, and without those that want a reference
// where there is none.
sg::TableOptions with_default_columns(const Options& options) {
  sg::TableOptions table = options.table;
  for (const auto& name : table.columns) {
    if (is_trajectory_column(name) && options.reference.empty())
      throw sg::usage_error("column '" + name + "' wants a --reference");
  }
  if (!table.columns.empty()) return table;
  for (const auto name : columns) {
    if (name == "file" && options.inputs.paths.size() < 2) continue;
    if (is_trajectory_column(name) && options.reference.empty()) continue;
    table.columns.emplace_back(name);
  }
  return table;
}

void score(const Options& options) {
  sg::check(options.method);
  const sg::TableOptions table_options = with_default_columns(options);
  std::optional<sg::Trajectory> reference;
  if (!options.reference.empty())
    reference = read_trajectory(options.reference, options.inputs.options);
  sg::Output output(options.output.path);
  sg::Table table(table_options, columns, output);
  for (const auto& path : options.inputs.paths) score_file(table, path, options, reference);
  output.commit();
}

}  // namespace

int main(int argc, char** argv) {
  sg::Command command("sg-score", "Score what a graph is worth, and what it costs.");
  Options options;
  add_options(command, options);
  return sg::run(command, argc, argv, [&] { score(options); });
}
