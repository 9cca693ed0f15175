// sg-cov: how sure a graph is of its vertices: marginal covariances at its estimate, of each and of pairs.
#include <array>
#include <cmath>
#include <limits>

#include "cmd/common/command.h"
#include "cmd/common/method.h"
#include "cmd/common/options.h"
#include "cmd/common/table.h"
#include "lib/factor/initialize.h"
#include "lib/score/covariance.h"

using namespace sg;
using Eigen::MatrixXd;

namespace {

struct Options {
  cmd::Input input;
  cmd::OutputOptions output;
  cmd::TableOptions table;
  cmd::MethodOptions method;
  std::vector<Id> ids;
  std::vector<Id> pairs;
  bool all = false;
  bool ellipse = false;
};

cmd::NumberList upper_triangle(const MatrixXd& matrix) {
  cmd::NumberList numbers;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    for (Eigen::Index j = i; j < matrix.cols(); ++j) numbers.push_back(matrix(i, j));
  }
  return numbers;
}

struct Row {
  const factor::Problem& problem;
  const factor::Values& values;
  Index vertex;
  const MatrixXd& covariance;
  std::optional<MatrixXd> position_ = {};

  const MatrixXd& position() {
    return cmd::once(position_, [&] {
      return score::position_covariance(problem.space[vertex],
                                        values.data() + problem.value_at[vertex], covariance);
    });
  }
};

const std::vector<cmd::Column<Row>> columns{
    {"id", "Of the vertex", [](Row& row) { return row.problem.graph->id[row.vertex]; }},
    {"tag", "Its type", [](Row& row) { return row.problem.graph->type_of_vertex(row.vertex).tag; }},
    {"sigma", "Standard deviation of its position",
     [](Row& row) { return std::sqrt(row.position().trace()); }},
    {"axes", "Half axes of its position's ellipse",
     [](Row& row) { return score::ellipse(row.position()).axes; }, "--ellipse"},
    {"angle", "Of the longest, in the xy plane, in radians",
     [](Row& row) { return score::ellipse(row.position()).angle; }, "--ellipse"},
    {"covariance", "The upper triangle, row by row",
     [](Row& row) { return upper_triangle(row.covariance); }},
};

struct PairRow {
  Id first, second;
  MatrixXd covariance;
};

const std::vector<cmd::Column<PairRow>> pair_columns{
    {"first", "Id of the first vertex", [](PairRow& row) { return row.first; }},
    {"second", "Id of the second", [](PairRow& row) { return row.second; }},
    {"covariance", "Of both, the upper triangle, row by row",
     [](PairRow& row) { return upper_triangle(row.covariance); }},
};

void add_options(cmd::Command& command, Options& options) {
  cmd::add_input(command, options.input);
  auto& app = command.app;
  const auto add_ids = [&](const char* name, std::vector<Id>& ids, const char* what) {
    return app.add_option(name, ids, what)
        ->delimiter(',')
        ->allow_extra_args(false)
        ->transform(cmd::whole(0, std::numeric_limits<Id>::max()));
  };
  add_ids("--ids", options.ids, "Of these vertices; without, of all poses")->option_text("ID,...");
  app.add_flag("--all", options.all, "Of all vertices");
  add_ids("--pairs", options.pairs, "Joint ones of two vertices, again and again")
      ->option_text("ID,ID,...");
  app.add_flag("--ellipse", options.ellipse, "Axes of the positions' ellipses as well");
  cmd::add_method(command, options.method);
  cmd::add_output(command, options.output);
  cmd::add_table(command, options.table,
                 {{"", cmd::headings(columns)}, {"With --pairs:", cmd::headings(pair_columns)}});
}

Index vertex_of(const Graph& graph, const std::string& option, Id id) {
  if (const auto v = graph::find_vertex(graph, id)) return *v;
  throw text::usage_error(option + " " + std::to_string(id) + ": the graph has no such vertex");
}

std::vector<Index> chosen_vertices(const Options& options, const Graph& graph) {
  std::vector<Index> chosen;
  for (const Id id : options.ids) chosen.push_back(vertex_of(graph, "--ids", id));
  if (!chosen.empty()) return chosen;
  for (Index v = 0; v < graph.vertices(); ++v) {
    if (options.all || graph.role(v) == graph::Role::pose) chosen.push_back(v);
  }
  return chosen;
}

std::vector<std::array<Index, 2>> chosen_pairs(const Options& options, const Graph& graph) {
  std::vector<std::array<Index, 2>> chosen;
  for (std::size_t k = 0; k < options.pairs.size(); k += 2)
    chosen.push_back({vertex_of(graph, "--pairs", options.pairs[k]),
                      vertex_of(graph, "--pairs", options.pairs[k + 1])});
  return chosen;
}

void check_call(const cmd::Command& command, const Options& options) {
  cmd::check_form(command.app);
  cmd::at_most_one(command.app, {{"--ids", "names vertices"},
                                 {"--all", "takes all of them"},
                                 {"--pairs", "takes them by two"}});
  if (!options.pairs.empty()) cmd::refuse(command.app, {"--ellipse"}, "with --pairs");
  if (options.pairs.size() % 2 != 0)
    throw text::usage_error("--pairs wants two ids, or four, or six, not " +
                            std::to_string(options.pairs.size()));
  cmd::check(options.method);
}

void run(const cmd::Command& command, const Options& options) {
  check_call(command, options);
  cmd::Output output(options.output.path);
  std::optional<cmd::Table<Row>> table;
  std::optional<cmd::Table<PairRow>> pair_table;
  if (options.pairs.empty()) {
    table.emplace(options.table, columns, cmd::Given{{"--ellipse", options.ellipse}}, output);
  } else {
    pair_table.emplace(options.table, pair_columns, cmd::Given{}, output);
  }
  const Graph graph = cmd::read(options.input);
  const auto vertices = chosen_vertices(options, graph);
  const auto pairs = chosen_pairs(options, graph);
  cmd::stage("order");
  const graph::Order order =
      cmd::named_order(options.method, graph, graph::graph_pattern(graph)).order;
  cmd::stage("eliminate");
  const factor::Problem problem = factor::make_problem(graph);
  const factor::Values values = factor::start_values(problem);
  auto elimination = score::eliminated(problem, values, order);
  if (!elimination) throw score::singular_error(problem, values);
  for (const auto& [a, b] : pairs)
    pair_table->row(
        {graph.id[a], graph.id[b], score::joint_covariance(problem, *elimination, a, b)});
  if (table) {
    const std::vector<MatrixXd> covariance = score::vertex_covariances(problem, *elimination);
    for (const Index v : vertices) table->row({problem, values, v, covariance[v]});
  }
  output.commit();
}

}  // namespace

int main(int argc, char** argv) {
  return cmd::run(cmd::Command("sg-cov", "Marginal covariances of a graph's vertices."), argc, argv,
                  add_options, run);
}
