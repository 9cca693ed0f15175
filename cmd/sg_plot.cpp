// sg-plot: pictures of a graph, of its factor, of its Bayes tree.
#include <algorithm>
#include <array>

#include "cmd/common/command.h"
#include "cmd/common/method.h"
#include "cmd/common/options.h"
#include "cmd/plot/heat.h"
#include "cmd/plot/picture.h"
#include "cmd/plot/scenes.h"
#include "cmd/plot/words.h"
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
  std::string plane;
  std::vector<double> view;  // azimuth, elevation
  bool cost = false;
  bool sigma = false;
  std::vector<std::string> only;
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
  app.add_option("--plane", options.plane, "Of a map: xy, xz or yz (default: where it is widest)")
      ->check(cmd::one_of({"xy", "xz", "yz"}))
      ->option_text("PLANE");
  app.add_option("--view", options.view, "Of a map: from where, in degrees; 0,90: above")
      ->delimiter(',')
      ->expected(2)
      ->allow_extra_args(false)
      ->option_text("AZIMUTH,ELEVATION");
  app.add_option("--only", options.only, "Of a map: these edges: odometry, loops, observations")
      ->check(cmd::one_of({"odometry", "loops", "observations"}))
      ->delimiter(',')
      ->allow_extra_args(false)
      ->option_text("KIND,...");
  app.add_option("--width", options.size.width,
                 "Of the picture, in points or pixels (default: 600)")
      ->transform(cmd::whole(64, 20000))
      ->option_text("N");
  app.add_option("--height", options.size.height, "The same (default: 600)")
      ->transform(cmd::whole(64, 20000))
      ->option_text("N");
  cmd::add_output(app, options.output, "Write to FILE, whole or not at all", cmd::Writes::other);
}

// Of every vertex, its position's, as the map shows it.
std::vector<score::Ellipse> ellipses(const Graph& graph, const graph::Order& order,
                                     const plot::View& view) {
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
    result.push_back(score::ellipse(view * in_space * view.transpose()));
  }
  return result;
}

// "walk.g2o: 5 poses, 2 landmarks, 11 edges, EC 697 (colamd)"
std::string title(const Graph& graph, const graph::GraphPattern& variables, const std::string& name,
                  const graph::Order& order) {
  const elim::Wide ec = elim::column_score(elim::symbolic(variables.pattern, order)).ec;
  return plot::counted(graph) + ", EC " + elim::to_string(ec) + " (" + name + ")";
}

struct EdgeKind {
  std::string_view name;
  graph::EdgeRole role;
};
constexpr std::array edge_kinds{EdgeKind{"odometry", graph::EdgeRole::odometry},
                                EdgeKind{"loops", graph::EdgeRole::loop_closure},
                                EdgeKind{"observations", graph::EdgeRole::observation}};

std::vector<graph::EdgeRole> shown_edges(const Options& options) {
  std::vector<graph::EdgeRole> roles;
  for (const EdgeKind& kind : edge_kinds) {
    if (options.only.empty() || std::ranges::find(options.only, kind.name) != options.only.end())
      roles.push_back(kind.role);
  }
  return roles;
}

plot::View seen_from(const Options& options, const Graph& graph) {
  if (!options.view.empty()) return plot::view_from(options.view[0], options.view[1]);
  return options.plane.empty() ? plot::best_view(graph) : plot::plane_view(options.plane);
}

void draw(cairo_t* page, const Options& options, const Graph& graph) {
  const bool map = options.what == "map";
  const graph::GraphPattern variables = graph::graph_pattern(graph);
  const auto [name, order] = cmd::named_order(options.method, graph, variables);
  const plot::View view = map ? seen_from(options, graph) : plot::View{};
  if (map && !options.cost && !options.sigma)
    return plot::draw_map(page, options.size, graph, view, title(graph, variables, name, order),
                          shown_edges(options));
  if (options.sigma) {
    return plot::draw_sigma_map(page, options.size, graph, view, ellipses(graph, order, view));
  }
  if (map) {
    return plot::draw_cost_map(page, options.size, graph, view,
                               plot::costs(variables, order, name));
  }
  if (options.what == "pattern") {
    plot::draw_pattern(page, options.size, variables.pattern, order);
    const elim::Wide nnz = elim::column_score(elim::symbolic(variables.pattern, order)).nnz;
    const elim::Wide fill = nnz - elim::system_nnz(variables.pattern);
    return plot::draw_title(page, options.size,
                            title(graph, variables, name, order) + ", " + elim::to_string(nnz) +
                                " entries, " + elim::to_string(fill) + " of them fill",
                            12, 9, 8);
  }
  plot::draw_tree(page, options.size, elim::symbolic(variables.pattern, order));
  plot::draw_title(page, options.size, title(graph, variables, name, order), 12, 9, 8);
}

void run(const cmd::Command& command, const Options& options) {
  if (options.what != "map")
    cmd::refuse(command.app, {"--cost", "--sigma", "--plane", "--view", "--only"},
                "on a " + options.what + ", only on a map");
  cmd::at_most_one(command.app,
                   {{"--plane", "looks along an axis"}, {"--view", "from where it says"}});
  cmd::at_most_one(command.app, {{"--cost", "colours what costs"}, {"--sigma", "draws ellipses"}});
  if (options.cost) cmd::refuse(command.app, {"--only"}, "with --cost, which colours all edges");
  if (options.sigma) cmd::refuse(command.app, {"--only"}, "with --sigma, whose edges are faint");
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
