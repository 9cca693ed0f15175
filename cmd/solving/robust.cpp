#include "cmd/solving/robust.h"

#include "cmd/common/options.h"
#include "lib/factor/residuals.h"
#include "lib/graph/replay.h"
#include "lib/text/nearest.h"
#include "lib/text/words.h"

namespace sg::solving {
namespace {

factor::Kernel parse_kernel(const std::string& text) {
  if (text.empty()) return {};
  const auto colon = text.find(':');
  const auto* const shape = factor::find_kernel_shape(text.substr(0, colon));
  const auto width =
      text::parse<double>(colon == text.npos ? "" : std::string_view(text).substr(colon + 1));
  if (shape && width && *width > 0) return {shape, *width};
  throw text::usage_error("--kernel wants NAME:W with W above 0, not '" + text + "'; there are " +
                          text::listed(text::names_of(factor::kernel_shapes())));
}

bool is_on(const std::string& on, graph::EdgeRole role) {
  if (on == "loops") return role == graph::EdgeRole::loop_closure;
  if (on == "observations") return role == graph::EdgeRole::observation;
  return on == "all" || role != graph::EdgeRole::odometry;
}

std::vector<bool> edges_on(const std::string& on, const Graph& graph) {
  std::vector<bool> result;
  for (const graph::EdgeRole role : graph::edge_roles(graph, graph::pose_index(graph)))
    result.push_back(is_on(on, role));
  return result;
}

}  // namespace

void add_robust(CLI::App& app, RobustOptions& options) {
  app.add_option("--kernel", options.kernel,
                 cmd::wrapped_list("Robust: ", text::names_of(factor::kernel_shapes()), ", "))
      ->option_text("NAME:W");
  app.add_option("--kernel-on", options.on, "loops, observations, all (default: all but odometry)")
      ->option_text("WHAT")
      ->check(cmd::one_of({"loops", "observations", "all"}));
  app.add_flag("--gnc", options.gnc, "Graduated non-convexity: leave false edges out");
  app.add_option("--quantile", options.quantile, "Beyond which an edge is false (default: 0.99999)")
      ->option_text("P")
      ->check(cmd::number(0, 1));
}

void check_robust(const CLI::App& app, const RobustOptions& options) {
  parse_kernel(options.kernel);
  cmd::at_most_one(app, {{"--kernel", "weighs edges"}, {"--gnc", "keeps or leaves them out"}});
  if (options.kernel.empty() && !options.gnc)
    cmd::refuse(app, {"--kernel-on"}, "without --kernel or --gnc");
  if (!options.gnc) cmd::refuse(app, {"--quantile"}, "without --gnc");
  if (options.quantile <= 0 || options.quantile >= 1)
    throw text::usage_error("--quantile is above 0 and below 1");
}

factor::Loss loss(const RobustOptions& options, const Graph& graph) {
  if (options.kernel.empty()) return {};
  return {parse_kernel(options.kernel), edges_on(options.on, graph), {}};
}

solve::GncOptions gnc_options(const RobustOptions& options, const factor::Problem& problem,
                              solve::BatchOptions batch) {
  solve::GncOptions result{std::move(batch), edges_on(options.on, *problem.graph), {}};
  for (Index e = 0; e < problem.graph->edges(); ++e) {
    const int degrees = factor::degrees_of_freedom(problem, e);
    result.doubtful[e] = result.doubtful[e] && degrees > 0;  // what says nothing is not false
    result.bound.push_back(factor::chi2_of_quantile(options.quantile, degrees));
  }
  return result;
}

}  // namespace sg::solving
