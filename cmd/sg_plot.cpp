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

namespace {

struct Options {
  std::string what;
  sg::Input input;
  sg::OutputOptions output;
  sg::MethodOptions method;
  std::string plane = "xy";
  bool cost = false;
  sg::PageSize size{600, 600};
};

void add_options(sg::Command& command, Options& options) {
  auto& app = command.app;
  app.add_option("WHAT", options.what,
                 "map: where everything is\npattern: R and its fill\ntree: the Bayes tree")
      ->required()
      ->check(sg::one_of({"map", "pattern", "tree"}))
      ->option_text(" ");
  sg::add_input(command, options.input);
  sg::add_method(command, options.method);
  app.add_flag("--cost", options.cost, "Of a map: colour what costs by its share of EC")
      ->option_text(" ");
  app.add_option("--plane", options.plane, "Of a map: xy (default), xz or yz")
      ->check(sg::one_of({"xy", "xz", "yz"}))
      ->option_text("PLANE");
  app.add_option("--width", options.size.width,
                 "Of the picture, in points or pixels (default: 600)")
      ->check(CLI::Range(64, 20000).description(""))
      ->option_text("N");
  app.add_option("--height", options.size.height, "The same (default: 600)")
      ->check(CLI::Range(64, 20000).description(""))
      ->option_text("N");
  sg::add_output(command, options.output);
}

void draw(cairo_t* page, const Options& options, const sg::Graph& graph) {
  const bool map = options.what == "map";
  const std::array axes{options.plane[0] - 'x', options.plane[1] - 'x'};
  if (map && !options.cost) return sg::draw_map(page, options.size, graph, axes);
  const sg::GraphPattern variables = sg::graph_pattern(graph);
  const auto [name, order] = sg::named_order(options.method, graph, variables);
  if (map) {
    return sg::draw_cost_map(page, options.size, graph, axes, sg::costs(variables, order, name));
  }
  if (options.what == "pattern") {
    return sg::draw_pattern(page, options.size, variables.pattern, order);
  }
  sg::draw_tree(page, options.size, sg::symbolic(variables.pattern, order));
}

void plot(const sg::Command& /*command*/, const Options& options) {
  const sg::PictureFormat format = sg::picture_format(options.output.path);
  if (options.cost && options.what != "map") throw sg::usage_error("--cost belongs to map");
  sg::check(options.method);
  const sg::Graph graph = sg::read(options.input);
  const std::string bytes = sg::picture(format, options.size.width, options.size.height,
                                        [&](cairo_t* page) { draw(page, options, graph); });
  sg::Output output(options.output.path);
  output.write(bytes);
  output.commit();
}

}  // namespace

int main(int argc, char** argv) {
  return sg::run(
      sg::Command("sg-plot", "Draw a graph, its factor, or its Bayes tree (svg, png, pdf)."), argc,
      argv, add_options, plot);
}
