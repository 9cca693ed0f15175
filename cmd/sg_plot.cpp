// sg-plot: pictures of a graph, of its factor, of its Bayes tree.
#include <array>

#include "cmd/common/command.h"
#include "cmd/common/method.h"
#include "cmd/common/options.h"
#include "cmd/plot/heat.h"
#include "cmd/plot/picture.h"
#include "cmd/plot/scenes.h"
#include "lib/factor/initialize.h"
#include "lib/order/order.h"
#include "lib/score/covariance.h"
#include "lib/text/error.h"

using namespace sg;

namespace {

struct Options {
  std::string what;
  cmd::Input input;
  cmd::OutputOptions output;
  cmd::MethodOptions method;
  std::string plane = "xy";
  bool cost = false;
  bool sigma = false;
  plot::PageSize size{600, 600};
};

void add_options(cmd::Command& command, Options& options) {
  auto& app = command.app;
  app.add_option("WHAT", options.what,
                 "map: where everything is\npattern: R and its fill\ntree: the Bayes tree")
      ->required()
      ->check(cmd::one_of({"map", "pattern", "tree"}))
      ->option_text(" ");
  cmd::add_input(command, options.input);
  cmd::add_method(command, options.method);
  app.add_flag("--cost", options.cost, "Of a map: colour what costs by its share of EC")
      ->option_text(" ");
  app.add_flag("--sigma", options.sigma, "Of a map: ellipses of one standard deviation")
      ->option_text(" ");
  app.add_option("--plane", options.plane, "Of a map: xy (default), xz or yz")
      ->check(cmd::one_of({"xy", "xz", "yz"}))
      ->option_text("PLANE");
  app.add_option("--width", options.size.width,
                 "Of the picture, in points or pixels (default: 600)")
      ->transform(cmd::whole(64, 20000))
      ->option_text("N");
  app.add_option("--height", options.size.height, "The same (default: 600)")
      ->transform(cmd::whole(64, 20000))
      ->option_text("N");
  cmd::add_output(app, options.output, "Write to FILE, whole or not at all", cmd::Writes::other);
}

// Of every vertex, its position's in the plane of two axes.
std::vector<score::Ellipse> ellipses(const Graph& graph, const graph::Order& order,
                                     const std::array<int, 2>& axes) {
  const factor::Problem problem = factor::make_problem(graph);
  const factor::Values values = factor::start_values(problem);
  auto elimination = score::eliminated(problem, values, order);
  if (!elimination) throw score::singular_error(problem, values);
  const auto covariances = score::vertex_covariances(problem, *elimination);
  std::vector<score::Ellipse> result;
  for (Index v = 0; v < graph.vertices(); ++v) {
    const Eigen::MatrixXd position = score::position_covariance(
        problem.space[v], values.data() + problem.value_at[v], covariances[v]);
    Eigen::Matrix3d in_space = Eigen::Matrix3d::Zero();
    in_space.topLeftCorner(position.rows(), position.cols()) = position;
    result.push_back(score::ellipse(in_space(axes, axes)));
  }
  return result;
}

void draw(cairo_t* page, const Options& options, const Graph& graph) {
  const bool map = options.what == "map";
  const std::array axes{options.plane[0] - 'x', options.plane[1] - 'x'};
  if (map && !options.cost && !options.sigma)
    return plot::draw_map(page, options.size, graph, axes);
  const graph::GraphPattern variables = graph::graph_pattern(graph);
  const auto [name, order] = cmd::named_order(options.method, graph, variables);
  if (options.sigma) {
    return plot::draw_sigma_map(page, options.size, graph, axes, ellipses(graph, order, axes));
  }
  if (map) {
    return plot::draw_cost_map(page, options.size, graph, axes,
                               plot::costs(variables, order, name));
  }
  if (options.what == "pattern") {
    return plot::draw_pattern(page, options.size, variables.pattern, order);
  }
  plot::draw_tree(page, options.size, elim::symbolic(variables.pattern, order));
}

void run(const cmd::Command& command, const Options& options) {
  if (options.what != "map")
    cmd::refuse(command.app, {"--cost", "--sigma", "--plane"},
                "on a " + options.what + ", only on a map");
  cmd::at_most_one(command.app, {{"--cost", "colours what costs"}, {"--sigma", "draws ellipses"}});
  if (options.what == "map" && !options.cost && !options.sigma)
    cmd::refuse(command.app, {"-m", "--seed"}, "on a map without --cost or --sigma");
  const plot::PictureFormat format = plot::picture_format(options.output.path);
  cmd::check(options.method);
  const Graph graph = cmd::read(options.input);
  cmd::stage("draw");
  const std::string bytes = plot::picture(format, options.size.width, options.size.height,
                                          [&](cairo_t* page) { draw(page, options, graph); });
  cmd::Output output(options.output.path);
  output.write(bytes);
  output.commit();
}

}  // namespace

int main(int argc, char** argv) {
  return cmd::run(
      cmd::Command("sg-plot", "Draw a graph, its factor, or its Bayes tree (svg, png, pdf)."), argc,
      argv, add_options, run);
}
