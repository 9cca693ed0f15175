#include "cmd/common/method.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "cmd/common/calibration.h"
#include "cmd/common/complete.h"
#include "cmd/common/options.h"
#include "cmd/common/stage.h"
#include "cmd/common/table.h"
#include "lib/solve/forecast.h"
#include "lib/text/nearest.h"

namespace sg::cmd {
namespace {

void add(Command& command, MethodOptions& options, const char* type, int most) {
  command.app
      .add_option(
          "-m,--method", options.names,
          "Of sg-order(1) (default: the file's, else " + std::string(order::default_ordering) + ")")
      ->option_text(type)
      ->delimiter(',')
      ->check(suggests(text::names_of(order::orderings())))
      ->allow_extra_args(false)
      ->expected(1, most);
  add_seed(command.app, options.seed, "Seed of orderings that draw");
}

constexpr std::array<std::string_view, 4> prices{"ec", "seconds", "factor_bytes", "peak_bytes"};

using Price = std::function<double(const graph::Pattern&, const graph::Order&)>;

// Of what best is asked to minimize; empty for EC.
Price price(const std::string& what) {
  if (what == "seconds") {
    return [times = read_calibration().value()](const graph::Pattern& pattern,
                                                const graph::Order& order) {
      return solve::seconds(solve::forecast(pattern, order).work, times);
    };
  }
  const auto bytes = [](std::int64_t solve::Forecast::*which) -> Price {
    return [which](const graph::Pattern& pattern, const graph::Order& order) {
      return static_cast<double>(solve::forecast(pattern, order).*which);
    };
  };
  if (what == "factor_bytes") return bytes(&solve::Forecast::factor_bytes);
  if (what == "peak_bytes") return bytes(&solve::Forecast::peak_bytes);
  return {};
}

}  // namespace

void add_methods(Command& command, MethodOptions& options) {
  add(command, options, "METHOD,...", CLI::detail::expected_max_vector_size);
}

void add_method(Command& command, MethodOptions& options) {
  add(command, options, "METHOD", 1);
}

void add_best(Command& command, BestOptions& options) {
  command.app
      .add_option("--budget", options.budget, "Of best: seconds, or Nt for N tries (default: 200t)")
      ->option_text("SECONDS|Nt");
  command.app
      .add_option("--minimize", options.minimize,
                  "Of best: " + text::listed({prices.begin(), prices.end()}) + " [ec]")
      ->option_text("WHAT")
      ->check(one_of({prices.begin(), prices.end()}));
  options.report = &command.verbose;
}

void check_best(const Command& command, bool asked, const BestOptions& options) {
  if (!asked) refuse(command.app, {"--budget", "--minimize"}, "without -m best");
  if (!options.budget.empty()) order::parse_budget(options.budget);
  if (options.minimize == "seconds" && !read_calibration())
    throw text::usage_error(
        "--minimize seconds: nobody knows how long things take here until "
        "sg-solve --calibrate has been run");
}

void set_best(const BestOptions& options, order::OrderOptions& order_options) {
  if (!options.budget.empty()) order_options.budget = order::parse_budget(options.budget);
  order_options.price = price(options.minimize);
  if (!options.report || !*options.report) return;
  order_options.report = [what = options.minimize](const order::Improvement& better) {
    char text[64];
    std::snprintf(text, sizeof text, " after %d tries, %.2f s", better.tries, better.seconds);
    std::string line = std::string(better.how) + ": EC " + elim::to_string(better.ec);
    if (what != "ec") line += ", " + what + " " + rounded(better.price, 6);
    say(line + text);
  };
}

bool asks_for_best(const MethodOptions& options) {
  return std::ranges::find(options.names, "best") != options.names.end();
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
  set_best(options.best, order_options);
  stop_when_interrupted(*method.ordering, order_options);
  return order::elimination_order(*method.ordering, variables.pattern, order_options);
}

NamedOrder named_order(const MethodOptions& options, const Graph& graph,
                       const graph::GraphPattern& variables) {
  const Method method = methods(options, graph).front();
  return {method.label, order_by(method, options, graph, variables)};
}

}  // namespace sg::cmd
