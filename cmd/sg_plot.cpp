// sg-plot: pictures of a graph, of its factor, of its Bayes tree, of a table.
#include <malloc.h>

#include <algorithm>
#include <array>
#include <optional>

#include "cmd/common/command.h"
#include "cmd/common/method.h"
#include "cmd/common/options.h"
#include "cmd/common/table.h"
#include "cmd/plot/curves.h"
#include "cmd/plot/heat.h"
#include "cmd/plot/overlay.h"
#include "cmd/plot/picture.h"
#include "cmd/plot/scenes.h"
#include "cmd/plot/unsolved.h"
#include "cmd/plot/words.h"
#include "lib/factor/initialize.h"
#include "lib/order/order.h"
#include "lib/score/covariance.h"
#include "lib/text/error.h"

using namespace sg;

namespace {

struct Options {
  std::string what;
  cmd::Inputs inputs;
  cmd::OutputOptions output;
  cmd::MethodOptions method;
  std::string plane;
  std::vector<double> view;  // azimuth, elevation
  bool cost = false;
  bool sigma = false;
  std::vector<std::string> only;
  std::string overlay;
  std::vector<std::string> columns;
  std::vector<std::string> log;  // axes
  plot::PageSize size{600, 600};
};

void add_options(cmd::Command& command, Options& options) {
  auto& app = command.app;
  app.add_option("WHAT", options.what,
                 "map: where everything is\npattern: R and its fill\ntree: the Bayes tree\ncurves: "
                 "the columns of a table")
      ->required()
      ->check(cmd::one_of({"map", "pattern", "tree", "curves"}))
      ->option_text(" ");
  cmd::add_inputs(command, options.inputs);
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
  app.add_option("--overlay", options.overlay, "Of a map: a second graph, or a trajectory, over it")
      ->option_text("FILE");
  app.add_option("-f,--fields", options.columns, "Of curves: these columns, the first to the right")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->option_text("NAME,...");
  app.add_option("--log", options.log, "Of curves: these axes are logarithmic: x, y")
      ->check(cmd::one_of({"x", "y"}))
      ->delimiter(',')
      ->allow_extra_args(false)
      ->option_text("AXIS,...");
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

std::optional<plot::Overlay> overlay(const Options& options, const Graph& graph) {
  if (options.overlay.empty()) return {};
  formats::ReadOptions read = options.inputs.options;
  read.format.clear();  // a file of any format
  cmd::begin_reading(options.overlay);
  const Graph other = formats::read_graph(options.overlay, read);
  return plot::overlay(graph, other.file, score::trajectory(other));
}

std::string error_in_words(const plot::Overlay& overlay) {
  return "ATE " + cmd::rounded(*overlay.error.ate, 4) + " m over " +
         plot::counted(static_cast<Index>(overlay.error.matched), "pose", "poses") + " of " +
         overlay.name;
}

// What is left of an elimination for a map. (The pattern is as large as the graph, and not kept.)
struct Eliminated {
  std::string title;
  graph::Order order;
  plot::Costs costs;  // where they are asked for
};

Eliminated eliminated(const Options& options, const Graph& graph) {
  const auto variables = graph::graph_pattern(graph);
  auto [name, order] = cmd::named_order(options.method, graph, variables);
  if (options.cost) {
    plot::Costs costs = plot::costs(variables, order);
    return {name, std::move(order), std::move(costs)};
  }
  const elim::Wide ec = elim::column_score(elim::symbolic(variables.pattern, order)).ec;
  return {plot::title(graph, ec, name), std::move(order), {}};
}

void draw_map(cairo_t* page, const Options& options, Graph& graph) {
  const std::string hint = options.cost ? "" : plot::unsolved_hint(graph);
  // Where estimates are not composed along edges nobody asks for their lines any more, and an order takes much.
  if (!options.sigma && !options.cost && !graph.edges_only) graph.edge_line = std::vector<Offset>();
  const Eliminated known = eliminated(options, graph);
  const plot::View view = seen_from(options, graph);
  if (options.cost)
    return plot::draw_cost_map(page, options.size, graph, view, known.costs,
                               plot::cost_heading(graph, known.costs, known.title));
  plot::Heading heading{known.title, hint};
  if (options.sigma)
    return plot::draw_sigma_map(page, options.size, graph, view, ellipses(graph, known.order, view),
                                heading);
  const std::optional<plot::Overlay> other = overlay(options, graph);
  if (other)
    heading.below = error_in_words(*other) + (heading.below.empty() ? "" : "; " + heading.below);
  plot::draw_map(page, options.size, graph, view, heading, shown_edges(options),
                 other ? &*other : nullptr);
}

void draw_elimination(cairo_t* page, const Options& options, const Graph& graph) {
  const auto variables = graph::graph_pattern(graph);
  const auto [name, order] = cmd::named_order(options.method, graph, variables);
  const elim::Symbolic symbolic = elim::symbolic(variables.pattern, order);
  const elim::Score score = elim::column_score(symbolic);
  const std::string title = plot::title(graph, score.ec, name);
  if (options.what == "tree") return plot::draw_tree(page, options.size, symbolic, {title});
  const elim::Wide fill = score.nnz - elim::system_nnz(variables.pattern);
  plot::draw_pattern(page, options.size, variables.pattern, order,
                     {title, "R in the order of " + name + ": " + elim::to_string(score.nnz) +
                                 " entries, " + elim::to_string(fill) + " of them fill"});
}

std::string picture_of_curves(const Options& options, plot::PictureFormat format) {
  std::vector<text::Text> texts;
  std::vector<plot::TableText> tables;
  for (const std::string& path : options.inputs.paths) {
    texts.push_back(cmd::read_text({path, options.inputs.options}));
    tables.push_back({text::input_name(path), texts.back().view});
  }
  const plot::Curves curves = plot::read_curves(tables, options.columns);
  const auto is_log = [&](const char* axis) {
    return std::ranges::find(options.log, axis) != options.log.end();
  };
  cmd::stage("draw");
  return plot::picture(format, options.size.width, options.size.height, [&](cairo_t* page) {
    plot::draw_curves(page, options.size, curves, {is_log("x"), is_log("y")});
  });
}

void write(const Options& options, const std::string& bytes) {
  cmd::Output output(options.output.path);
  output.write(bytes);
  output.commit();
}

void run(const cmd::Command& command, const Options& options) {
  if (options.what != "map")
    cmd::refuse(command.app, {"--cost", "--sigma", "--plane", "--view", "--only", "--overlay"},
                "on a " + options.what + ", only on a map");
  cmd::at_most_one(command.app,
                   {{"--plane", "looks along an axis"}, {"--view", "from where it says"}});
  cmd::at_most_one(command.app, {{"--cost", "colours what costs"}, {"--sigma", "draws ellipses"}});
  if (options.cost)
    cmd::refuse(command.app, {"--only", "--overlay"}, "with --cost, which colours all edges");
  if (options.sigma)
    cmd::refuse(command.app, {"--only", "--overlay"}, "with --sigma, whose edges are faint");
  const plot::PictureFormat format = plot::picture_format(options.output.path);
  if (options.what == "curves") {
    cmd::refuse(
        command.app,
        {"-m", "--seed", "--from", "--vertex", "--edge", "--params", "--alias", "--skip-unknown"},
        "on curves, which are those of a table");
    return write(options, picture_of_curves(options, format));
  }
  cmd::refuse(command.app, {"--log", "-f"}, "on a " + options.what + ", only on curves");
  if (options.inputs.paths.size() > 1)
    throw text::usage_error("a " + options.what + " is one graph's: give it one FILE");
  cmd::check(options.method);
#ifdef M_MMAP_THRESHOLD
  // What is freed of a large graph on its way goes back at once: glibc would keep it for blocks that do not come.
  ::mallopt(M_MMAP_THRESHOLD, 1 << 20);
#endif
  const cmd::Input input{options.inputs.paths.front(), options.inputs.options};
  Graph graph = options.sigma ? cmd::read(input) : cmd::read_thinly(input);
  cmd::stage("draw");
  const std::string bytes =
      plot::picture(format, options.size.width, options.size.height, [&](cairo_t* page) {
        if (options.what == "map")
          draw_map(page, options, graph);
        else
          draw_elimination(page, options, graph);
      });
  write(options, bytes);
}

}  // namespace

int main(int argc, char** argv) {
  return cmd::run(
      cmd::Command("sg-plot",
                   "Draw a graph, its factor, its Bayes tree, or a table (svg, png, pdf)."),
      argc, argv, add_options, run);
}
