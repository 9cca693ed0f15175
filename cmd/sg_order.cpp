// sg-order: put a graph's variables in elimination order.
#include "cmd/common/complete.h"
#include "cmd/common/estimates.h"
#include "cmd/common/method.h"
#include "cmd/common/options.h"
#include "formats/order_file.h"
#include "formats/reorder.h"
#include "lib/factor/initialize.h"
#include "lib/order/order.h"
#include "lib/order/polish.h"
#include "lib/text/error.h"

using namespace sg;

namespace {

struct Options {
  cmd::Input input;
  cmd::OutputOptions output;
  std::string method{order::default_ordering};
  std::string apply;
  bool print = false;
  bool polish = false;
  std::vector<Id> last;
  std::uint64_t seed = 1;
  cmd::BestOptions best;
};

void add_options(cmd::Command& command, Options& options) {
  cmd::add_input(command, options.input);
  auto& app = command.app;
  std::vector<std::string> methods;
  for (const order::Ordering& ordering : order::orderings()) methods.emplace_back(ordering.name);
  app.add_option("-m,--method", options.method,
                 cmd::wrapped_list("Default: " + options.method + "; one of ", methods, ", "))
      ->check(cmd::suggests(methods))
      ->option_text("METHOD");
  app.add_option("--apply", options.apply, "Take the order from FILE: ids in its first column")
      ->option_text("FILE");
  app.add_option("--last", options.last, "Eliminate these vertices after all others")
      ->option_text("ID,...")
      ->delimiter(',')
      ->transform(cmd::whole(0, std::numeric_limits<Id>::max()))
      ->allow_extra_args(false);
  cmd::add_seed(app, options.seed, "Seed of methods that draw or break ties");
  cmd::add_best(command, options.best);
  app.add_flag("--polish", options.polish, "Then reorder parts of it wherever that lowers EC");
  app.add_flag("--print", options.print, "Print the ids in their order instead of the graph");
  cmd::add_filter_output(command, options.output);
}

std::vector<Index> last_variables(const Options& options, const Graph& graph,
                                  const graph::GraphPattern& variables) {
  std::vector<Index> last;
  for (const Id id : options.last) {
    const auto v = graph::find_vertex(graph, id);
    if (!v)
      throw text::usage_error("--last: vertex " + std::to_string(id) + " is not in the graph");
    const Index j = variables.vertex_variable[*v];
    if (j < 0) throw text::usage_error("--last: vertex " + std::to_string(id) + " is fixed");
    last.push_back(j);
  }
  return last;
}

graph::Order computed_order(const cmd::Command& command, const Options& options, const Graph& graph,
                            const graph::GraphPattern& variables) {
  order::OrderOptions order_options = order::order_options(graph, variables);
  order_options.last = last_variables(options, graph, variables);
  order_options.seed = order::draw_of(options.seed);
  cmd::set_best(options.best, order_options);
  cmd::stop_when_interrupted(order::find_ordering(options.method), order_options);
  cmd::stage("order");
  graph::Order order = order::elimination_order(options.method, variables.pattern, order_options);
  if (command.verbose) {
    cmd::note(options.method + ": EC " +
              elim::to_string(elim::elimination_complexity(variables.pattern, order)));
  }
  return order;
}

// The order of --apply, --last being kept all the same.
graph::Order applied_order(const Options& options, const Graph& graph,
                           const graph::GraphPattern& variables) {
  const text::Text text = text::read_text(options.apply);
  const std::string file = options.apply == "-" ? "<stdin>" : options.apply;
  order::OrderOptions order_options;
  order_options.file_order = formats::parse_order(text.view, file, graph, variables);
  order_options.last = last_variables(options, graph, variables);
  return order::elimination_order("file", variables.pattern, order_options);
}

void polish(const cmd::Command& command, const Options& options, const Graph& graph,
            const graph::GraphPattern& variables, graph::Order& order) {
  cmd::finish_first();
  cmd::stage("polish");
  order::Polished polished =
      order::polish(variables.pattern, order,
                    {.last = last_variables(options, graph, variables),
                     .stop = [](double /*seconds*/) { return cmd::interrupted(); }});
  if (command.verbose) cmd::note("EC " + elim::to_string(polished.ec));
  order = std::move(polished.order);
}

// The order's vertices, and after them the fixed ones as the file has them.
std::vector<Index> vertices_in_order(const Graph& graph, const graph::GraphPattern& variables,
                                     const graph::Order& order) {
  std::vector<Index> vertices;
  vertices.reserve(graph.vertices());
  for (const Index j : order) vertices.push_back(variables.variable_vertex[j]);
  for (const Index v : graph::file_order(graph)) {
    if (graph.fixed[v]) vertices.push_back(v);
  }
  return vertices;
}

void print_ids(const Options& options, const Graph& graph, const graph::GraphPattern& variables,
               const graph::Order& order) {
  cmd::Output output(options.output.path);
  for (const Index j : order) {
    output.row(std::to_string(graph.id[variables.variable_vertex[j]]) + "\n");
  }
  output.commit();
}

void write_graph(const cmd::Command& command, const Options& options, const Graph& graph,
                 const std::vector<Index>& vertices) {
  formats::Changes changes = formats::unchanged(graph);
  if (graph.edges_only) {
    const factor::Problem problem = factor::make_problem(graph);
    changes.edits.push_back(cmd::vertex_lines(problem, factor::initial_values(problem), vertices));
  } else {
    changes.edits = formats::reordered(graph, vertices);
  }
  for (const Offset line : graph.order_lines) {
    const auto [begin, end] = formats::line_extent(graph, line);
    changes.edits.push_back({begin, end, ""});
  }
  const std::string marker =
      "# sg-order: " + (options.apply.empty() ? options.method : "apply") + "\n";
  cmd::stage("write");
  cmd::Output output(options.output.path);
  formats::write_changed(graph, std::move(changes),
                         cmd::trace_comment(command, options.output) + marker, output);
  output.commit();
}

void run(const cmd::Command& command, const Options& options) {
  const CLI::App& app = command.app;
  cmd::at_most_one(app, {{"-m", "computes an order"}, {"--apply", "takes the one of a file"}});
  if (!options.apply.empty()) cmd::refuse(app, {"--seed"}, "with --apply");
  if (options.print) cmd::refuse(app, {"--no-trace-comment"}, "with --print");
  order::find_ordering(options.method);  // before a long read
  cmd::check_best(command, options.method == "best", options.best);
  if (options.apply == "-" && options.input.path == "-") {
    throw text::usage_error("graph and order cannot both come from standard input");
  }
  const Graph graph = cmd::read(options.input);
  const graph::GraphPattern variables = graph::graph_pattern(graph);
  graph::Order order = options.apply.empty() ? computed_order(command, options, graph, variables)
                                             : applied_order(options, graph, variables);
  if (options.polish) polish(command, options, graph, variables, order);
  if (options.print) return print_ids(options, graph, variables, order);
  write_graph(command, options, graph, vertices_in_order(graph, variables, order));
}

}  // namespace

int main(int argc, char** argv) {
  return cmd::run(cmd::Command("sg-order", "Put the variables of a graph in elimination order."),
                  argc, argv, add_options, run);
}
