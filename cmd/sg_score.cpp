// sg-score: what a graph is worth, and what it costs, in one row.
#include <algorithm>
#include <iterator>

#include "cmd/common/command.h"
#include "cmd/common/method.h"
#include "cmd/common/options.h"
#include "cmd/common/table.h"
#include "cmd/scoring/columns.h"
#include "lib/prune/keyframes.h"

using namespace sg;

namespace {

struct Options {
  cmd::Inputs inputs;
  cmd::OutputOptions output;
  cmd::TableOptions table;
  cmd::MethodOptions method;
  std::string weights = "unit";
  std::string reference;
  std::string fill;
  std::string align = "se";
  bool per_pose = false;
};

struct PoseRow {
  scoring::Subject& of;
  Index vertex;
  std::optional<double> sigma;
};

const std::vector<cmd::Column<PoseRow>> pose_columns{
    {"file", "The file", [](PoseRow& row) { return row.of.file; }, "several files"},
    {"id", "Of the pose", [](PoseRow& row) { return row.of.graph.id[row.vertex]; }},
    {"sigma", "Standard deviation of its position", &PoseRow::sigma},
};

void add_options(cmd::Command& command, Options& options) {
  cmd::add_inputs(command, options.inputs);
  cmd::add_weights(command.app, options.weights, "Of log_trees and lambda2");
  command.app
      .add_option("--reference", options.reference,
                  "A graph, or for ATE and RPE alone a\ntrajectory (TUM, KITTI)")
      ->option_text("FILE");
  command.app
      .add_option(
          "--fill", options.fill,
          "With --reference: place poses that were dropped\nfrom this graph by its odometry")
      ->option_text("FULL");
  command.app
      .add_option("--align", options.align,
                  "Move onto it: se (rigidly; the default), sim (and\nscale), none")
      ->option_text("HOW")
      ->check(cmd::one_of({"se", "sim", "none"}));
  command.app.add_flag("--per-pose", options.per_pose, "A row for every pose")->option_text(" ");
  cmd::add_methods(command, options.method);
  cmd::add_output(command, options.output);
  cmd::add_table(
      command, options.table,
      {{"", cmd::headings(scoring::columns)}, {"With --per-pose:", cmd::headings(pose_columns)}});
}

// A graph's or a trajectory's file, of any format: it need not be that of the graphs.
scoring::Reference read_reference(const std::string& path, formats::ReadOptions options) {
  options.format.clear();
  cmd::begin_reading(path);
  return {formats::read_graph(path, options)};
}

score::Odometry read_odometry(const std::string& path, formats::ReadOptions options) {
  options.format.clear();
  cmd::begin_reading(path);
  const Graph graph = formats::read_graph(path, options);
  const graph::PoseIndex poses = graph::pose_index(graph);
  const graph::Lists<> steps = prune::odometry_steps(graph, poses);
  score::Odometry odometry;
  for (Index k = 0; k < steps.size(); ++k) {
    odometry.id.push_back(graph.id[poses.pose[k]]);
    auto& step = odometry.step.emplace_back();
    if (!steps[k].empty()) step = prune::mean(prune::step_motion(graph, poses, steps, k));
  }
  return odometry;
}

// Columns of a reference are asked for in vain without one, and options without their columns.
void check_columns(const CLI::App& app, const Options& options) {
  const auto asks = [&](std::string_view name) {
    return std::ranges::count(options.table.columns, name) > 0;
  };
  for (const auto& column : scoring::columns) {
    if (asks(column.name) && column.needs == "--reference" && options.reference.empty())
      throw text::usage_error("column '" + column.name + "' wants a --reference");
  }
  const auto shows = [&](std::initializer_list<std::string_view> names) {
    return options.table.columns.empty() || std::ranges::any_of(names, asks);
  };
  if (!shows({"log_trees", "lambda2"}))
    cmd::refuse(app, {"--weights"}, "without a column log_trees or lambda2");
  if (!shows({"order", "ec", "dopt", "sigma_mean", "sigma_max"}))
    cmd::refuse(app, {"-m", "--seed"}, "on columns for which nothing is eliminated");
}

// What makes a comparison other than it looks.
void warn_of_reference(const cmd::Command& command, const Options& options,
                       scoring::Subject& subject) {
  const score::Trajectory &own = subject.trajectory(),
                          &reference = subject.reference.value().trajectory;
  std::vector<Id> shared;
  std::ranges::set_intersection(own.id, reference.id, std::back_inserter(shared));
  const std::string both = subject.graph.file + " and " + text::input_name(options.reference);
  if (shared.empty()) {
    cmd::warn(command, both + " have no pose in common (poses are matched by id)");
  } else if (score::is_planar(own) != score::is_planar(reference)) {
    cmd::warn(command, both + ": one is planar, the other is not; errors are taken in space");
  }
}

void warn_if_singular(const cmd::Command& command, scoring::Subject& subject) {
  if (!subject.singular) return;
  cmd::warn(command, subject.graph.file + ": no dopt and no sigma: " +
                         score::singular_error(subject.problem(), subject.values()).what());
}

void print_poses(cmd::Table<PoseRow>& table, scoring::Subject& subject, const cmd::Method& method) {
  scoring::Row row{subject, method};
  for (const score::PoseSigma& pose : row.sigmas()) table.row({subject, pose.vertex, pose.sigma});
  if (!subject.singular) return;
  for (Index v = 0; v < subject.graph.vertices(); ++v) {
    if (subject.graph.role(v) == graph::Role::pose) table.row({subject, v, {}});
  }
}

void check_call(const cmd::Command& command, const Options& options) {
  cmd::check_form(command.app);
  if (options.reference.empty())
    cmd::refuse(command.app, {"--align", "--fill"}, "without --reference");
  if (options.per_pose) {
    cmd::refuse(command.app, {"--reference", "--weights"}, "with --per-pose");
    if (options.method.names.size() > 1)
      throw text::usage_error("-m: one ordering with --per-pose: sigma does not depend on it");
  } else {
    check_columns(command.app, options);
  }
  cmd::check(options.method);
}

void run(const cmd::Command& command, const Options& options) {
  check_call(command, options);
  const cmd::Given given{{"several files", options.inputs.paths.size() > 1},
                         {"--reference", !options.reference.empty()}};
  cmd::Output output(options.output.path);
  std::optional<cmd::Table<scoring::Row>> table;
  std::optional<cmd::Table<PoseRow>> poses;
  if (options.per_pose) {
    poses.emplace(options.table, pose_columns, given, output);
  } else {
    table.emplace(options.table, scoring::columns, given, output);
  }
  output.keep_rows();
  std::optional<scoring::Reference> reference;
  if (!options.reference.empty())
    reference = read_reference(options.reference, options.inputs.options);
  std::optional<score::Odometry> odometry;
  if (!options.fill.empty()) odometry = read_odometry(options.fill, options.inputs.options);
  const score::Alignment alignment = score::alignment(options.align).value();
  const trees::Weights weights = trees::tree_weights(options.weights).value();
  for (const auto& path : options.inputs.paths) {
    const Graph graph = cmd::read(options.inputs, path);
    cmd::stage("score");
    scoring::Subject subject{options.method, alignment, reference, odometry, path, graph, weights};
    if (reference) warn_of_reference(command, options, subject);
    for (const cmd::Method& method : cmd::methods(options.method, graph)) {
      if (table) table->row({subject, method});
      if (poses) print_poses(*poses, subject, method);
    }
    warn_if_singular(command, subject);
  }
  output.commit();
}

}  // namespace

int main(int argc, char** argv) {
  return cmd::run(cmd::Command("sg-score", "Score what a graph is worth, and what it costs."), argc,
                  argv, add_options, run);
}
