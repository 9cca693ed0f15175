#include "cmd/common/method.h"

#include <algorithm>

#include "cmd/common/complete.h"
#include "cmd/common/options.h"
#include "lib/text/nearest.h"

namespace sg::cmd {
namespace {

void add(Command& command, MethodOptions& options, const char* type, int most) {
  command.app
      .add_option("-m,--method", options.names,
                  "Orderings of sg-order(1). Default: the file's own\n"
                  "if sg-order left one, " +
                      std::string(order::default_ordering) + " otherwise")
      ->option_text(type)
      ->delimiter(',')
      ->check(suggests(text::names_of(order::orderings())))
      ->allow_extra_args(false)
      ->expected(1, most);
  add_seed(command.app, options.seed, "Seed of orderings that draw");
}

}  // namespace

void add_methods(Command& command, MethodOptions& options) {
  add(command, options, "METHOD,...", CLI::detail::expected_max_vector_size);
}

void add_method(Command& command, MethodOptions& options) {
  add(command, options, "METHOD", 1);
}

void add_budget(CLI::App& app, std::string& budget) {
  app.add_option("--budget", budget, "Of best: seconds, or Nt for N tries (default: 200t)")
      ->option_text("SECONDS|Nt");
}

void check_budget(const Command& command, const MethodOptions& options) {
  if (std::ranges::find(options.names, "best") == options.names.end()) {
    refuse(command.app, {"--budget"}, "without -m best");
  }
  if (!options.budget.empty()) order::parse_budget(options.budget);
}

void check(const MethodOptions& options) {
  for (const auto& name : options.names) order::find_ordering(name);
}

void stop_when_interrupted(const order::Ordering& ordering, order::OrderOptions& options) {
  if (&ordering != &order::find_ordering("best")) return;
  finish_first();
  options.stop = interrupted;
}

std::vector<Method> methods(const MethodOptions& options, const Graph& graph) {
  if (options.names.empty()) {
    if (graph.order_method.empty())
      return {
          {std::string(order::default_ordering), &order::find_ordering(order::default_ordering)}};
    return {{"file:" + graph.order_method, &order::find_ordering("file")}};
  }
  std::vector<Method> chosen;
  for (const auto& name : options.names) chosen.push_back({name, &order::find_ordering(name)});
  return chosen;
}

graph::Order order_by(const Method& method, const MethodOptions& options, const Graph& graph,
                      const graph::GraphPattern& variables) {
  order::OrderOptions order_options = order::order_options(graph, variables);
  order_options.seed = order::draw_of(options.seed);
  if (!options.budget.empty()) order_options.budget = order::parse_budget(options.budget);
  stop_when_interrupted(*method.ordering, order_options);
  return order::elimination_order(*method.ordering, variables.pattern, order_options);
}

NamedOrder named_order(const MethodOptions& options, const Graph& graph,
                       const graph::GraphPattern& variables) {
  const Method method = methods(options, graph).front();
  return {method.label, order_by(method, options, graph, variables)};
}

}  // namespace sg::cmd
