// sg-order: put a graph's variables in elimination order.
#include <cstdio>
#include <ctime>
#include <iostream>

#include "cmd/common/estimates.h"
#include "cmd/common/method.h"
#include "cmd/common/options.h"
#include "formats/order_file.h"
#include "formats/reorder.h"
#include "lib/factor/initialize.h"
#include "lib/order/order.h"
#include "lib/text/error.h"

namespace {

struct Options {
  sg::Input input;
  sg::OutputOptions output;
  std::string method = sg::default_method;
  std::string apply;
  bool print = false;
  std::vector<sg::Id> last;
  std::uint64_t seed = 0;
  std::string budget = "200t";
};

void add_options(sg::Command& command, Options& options) {
  sg::add_input(command, options.input);
  auto& app = command.app;
  std::vector<std::string> methods;
  for (const sg::Ordering& ordering : sg::orderings()) methods.emplace_back(ordering.name);
  auto* method =
      app.add_option("-m,--method", options.method,
                     sg::wrapped_list("Default: " + options.method + "; one of ", methods, ", "))
          ->option_text("METHOD");
  app.add_option("--apply", options.apply, "Take the order from FILE: ids in its first column")
      ->option_text("FILE")
      ->excludes(method);
  app.add_option("--last", options.last, "Eliminate these vertices after all others")
      ->option_text("ID,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  sg::add_seed(app, options.seed, "Seed of methods that draw or break ties");
  app.add_option("--budget", options.budget, "Of best: seconds, or Nt for N tries (default: 200t)")
      ->option_text("SECONDS|Nt");
  app.add_flag("--print", options.print, "Print the ids in their order instead of the graph");
  sg::add_filter_output(command, options.output);
}

std::vector<sg::Index> last_variables(const Options& options, const sg::Graph& graph,
                                      const sg::GraphPattern& variables) {
  std::vector<sg::Index> last;
  for (const sg::Id id : options.last) {
    const auto v = sg::find_vertex(graph, id);
    if (!v) throw sg::usage_error("--last: vertex " + std::to_string(id) + " is not in the graph");
    const sg::Index j = variables.vertex_variable[*v];
    if (j < 0) throw sg::usage_error("--last: vertex " + std::to_string(id) + " is fixed");
    last.push_back(j);
  }
  return last;
}

void print_improvement(const sg::Improvement& better) {
  char text[64];
  std::snprintf(text, sizeof text, " after %d tries, %.2f s\n", better.tries, better.seconds);
  std::cerr << "sg-order: " << better.how << ": EC " << sg::to_string(better.ec) << text;
}

void print_cost(const std::string& method, const sg::Pattern& pattern, const sg::Order& order,
                double seconds) {
  const std::string ec = sg::to_string(sg::elimination_complexity(pattern, order));
  std::cerr << "sg-order: " << method << ": EC " << ec << " in " << seconds << " s of CPU time\n";
}

sg::Order computed_order(const sg::Command& command, const Options& options, const sg::Graph& graph,
                         const sg::GraphPattern& variables) {
  sg::OrderOptions order_options = sg::order_options(graph, variables);
  order_options.last = last_variables(options, graph, variables);
  order_options.seed = options.seed;
  order_options.budget = sg::parse_budget(options.budget);
  if (command.verbose) order_options.report = print_improvement;
  const std::clock_t start = std::clock();
  sg::Order order = sg::elimination_order(options.method, variables.pattern, order_options);
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  if (command.verbose) print_cost(options.method, variables.pattern, order, seconds);
  return order;
}

// The order of --apply, --last being kept all the same.
sg::Order applied_order(const Options& options, const sg::Graph& graph,
                        const sg::GraphPattern& variables) {
  const sg::Text text = sg::read_text(options.apply);
  const std::string file = options.apply == "-" ? "<stdin>" : options.apply;
  sg::OrderOptions order_options;
  order_options.file_order = sg::parse_order(text.view, file, graph, variables);
  order_options.last = last_variables(options, graph, variables);
  return sg::elimination_order("file", variables.pattern, order_options);
}

// The order's vertices, and after them the fixed ones as the file has them.
std::vector<sg::Index> vertices_in_order(const sg::Graph& graph, const sg::GraphPattern& variables,
                                         const sg::Order& order) {
  std::vector<sg::Index> vertices;
  vertices.reserve(graph.vertices());
  for (const sg::Index j : order) vertices.push_back(variables.variable_vertex[j]);
  for (const sg::Index v : sg::file_order(graph)) {
    if (graph.fixed[v]) vertices.push_back(v);
  }
  return vertices;
}

void print_ids(const Options& options, const sg::Graph& graph, const sg::GraphPattern& variables,
               const sg::Order& order) {
  sg::Output output(options.output.path);
  for (const sg::Index j : order) {
    output.write(std::to_string(graph.id[variables.variable_vertex[j]]) + "\n");
  }
  output.commit();
}

void write_graph(const sg::Command& command, const Options& options, const sg::Graph& graph,
                 const std::vector<sg::Index>& vertices) {
  sg::Changes changes = sg::unchanged(graph);
  if (graph.edges_only) {
    const sg::Problem problem = sg::make_problem(graph);
    changes.edits.push_back(sg::vertex_lines(problem, sg::initial_values(problem), vertices));
  } else {
    changes.edits = sg::reordered(graph, vertices);
  }
  for (const sg::Offset line : graph.order_lines) {
    const auto [begin, end] = sg::line_extent(graph, line);
    changes.edits.push_back({begin, end, ""});
  }
  const std::string marker =
      "# sg-order: " + (options.apply.empty() ? options.method : "apply") + "\n";
  sg::Output output(options.output.path);
  sg::write_changed(graph, std::move(changes), sg::trace_comment(command, options.output) + marker,
                    output);
  output.commit();
}

void order(const sg::Command& command, const Options& options) {
  sg::find_ordering(options.method);  // before a long read
  sg::parse_budget(options.budget);
  if (options.apply == "-" && options.input.path == "-") {
    throw sg::usage_error("graph and order cannot both come from standard input");
  }
  const sg::Graph graph = sg::read(options.input);
  const sg::GraphPattern variables = sg::graph_pattern(graph);
  const sg::Order order = options.apply.empty() ? computed_order(command, options, graph, variables)
                                                : applied_order(options, graph, variables);
  if (options.print) return print_ids(options, graph, variables, order);
  write_graph(command, options, graph, vertices_in_order(graph, variables, order));
}

}  // namespace

int main(int argc, char** argv) {
  return sg::run(sg::Command("sg-order", "Put the variables of a graph in elimination order."),
                 argc, argv, add_options, order);
}
