// sg-plot: pictures of a graph, of its factor, of its Bayes tree.
#include <array>

#include "cmd/common/command.h"
#include "cmd/common/method.h"
#include "cmd/common/options.h"
#include "cmd/plot/heat.h"
#include "cmd/plot/picture.h"
#include "cmd/plot/scenes.h"
#include "lib/order/order.h"
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

void draw(cairo_t* page, const Options& options, const Graph& graph) {
  const bool map = options.what == "map";
  const std::array axes{options.plane[0] - 'x', options.plane[1] - 'x'};
  if (map && !options.cost) return plot::draw_map(page, options.size, graph, axes);
  const graph::GraphPattern variables = graph::graph_pattern(graph);
  const auto [name, order] = cmd::named_order(options.method, graph, variables);
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
    cmd::refuse(command.app, {"--cost", "--plane"}, "on a " + options.what + ", only on a map");
  if (options.what == "map" && !options.cost)
    cmd::refuse(command.app, {"-m", "--seed"}, "on a map without --cost");
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
