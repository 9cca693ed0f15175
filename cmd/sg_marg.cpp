// sg-marg: take vertices out, and keep what their edges knew as factors among their neighbours.
#include <algorithm>
#include <array>
#include <fstream>
#include <numbers>

#include "cmd/common/command.h"
#include "cmd/common/options.h"
#include "cmd/common/ranges.h"
#include "lib/marginalize/marginalize.h"
#include "lib/order/order.h"
#include "lib/prune/keyframes.h"
#include "lib/text/words.h"

using namespace sg;

namespace {

struct Options {
  cmd::Input input;
  cmd::OutputOptions output;
  std::vector<std::string> ids;
  prune::KeyframeRule rule;
  double degrees = 0;
  std::optional<Index> older_than;
  std::string landmarks;
  std::string topology = "tree";
  std::string as;
  std::string cluster = "online";
  marginalize::Sparsity sparsity;
  std::optional<Index> pairs;
  std::optional<double> ec, ec_part;
  bool conservative = false;
};

void add_selection(CLI::App& app, Options& options) {
  app.add_option("--ids", options.ids, "Take out these vertices (or those that FILE lists),")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->option_text("ID,FIRST:LAST,...|FILE");
  app.add_option("-r,--rate", options.rule.rate, "all poses but every R-th,")
      ->type_name("R")
      ->transform(cmd::whole(1));
  app.add_option("--dist", options.rule.distance, "all but one every D metres travelled, or")
      ->type_name("D")
      ->check(cmd::above_zero());
  app.add_option("--angle", options.degrees, "every A degrees turned,")
      ->type_name("A")
      ->check(cmd::above_zero());
  app.add_option("--older-than", options.older_than, "what no step from STEP on looks at,")
      ->type_name("STEP")
      ->transform(cmd::whole(0));
  app.add_option("--landmarks", options.landmarks,
                 "and landmarks: all, or those with fewer than\nN observations")
      ->option_text("all|N");
}

void add_options(cmd::Command& command, Options& options) {
  cmd::add_input(command, options.input);
  CLI::App& app = command.app;
  add_selection(app, options);
  app.add_option("--topology", options.topology,
                 "Of what comes instead: dense, tree (default),\nsubgraph, l1, seif, ec")
      ->option_text("KIND")
      ->check(cmd::one_of(marginalize::topology_names()));
  app.add_option("--as", options.as,
                 "factors: linear and exact (default of dense), or\nposes: relative measurements")
      ->option_text("WHAT")
      ->check(cmd::one_of({"factors", "poses"}));
  app.add_option("--cluster", options.cluster,
                 "What goes at once: online (default), one by one;\nbatch, runs; global, all that "
                 "is connected")
      ->option_text("HOW")
      ->check(cmd::one_of({"online", "batch", "global"}));
  app.add_option("-k,--pairs", options.pairs, "subgraph: pairs beyond the tree")
      ->type_name("K")
      ->transform(cmd::whole(0));
  app.add_option("--penalty", options.sparsity.penalty, "l1: of a pair (default: 1)")
      ->type_name("P")
      ->check(cmd::number(0));
  app.add_option("--threshold", options.sparsity.threshold,
                 "seif: of a link's correlation (default: 0.1)")
      ->type_name("T")
      ->check(cmd::number(0, 1));
  app.add_option("--price", options.sparsity.price,
                 "ec: what EC has to bring, as a multiple of what\na tree loses (default: 1)")
      ->type_name("P")
      ->check(cmd::number(0));
  app.add_option("--ec", options.ec, "ec: as much as leaves an EC of EC, or")
      ->type_name("EC")
      ->check(cmd::above_zero());
  app.add_option("--ec-part", options.ec_part, "of this part of the whole graph's")
      ->type_name("PART")
      ->check(cmd::above_zero());
  app.add_flag("--conservative", options.conservative, "Never know more than there was known");
  cmd::add_unused_seed(app);
  cmd::add_filter_output(command, options.output);
}

void check_call(const cmd::Command& command, const Options& options) {
  const auto given = [&](const char* option) { return cmd::given(command.app, option); };
  constexpr std::array selections{"--ids",   "-r",           "--dist",
                                  "--angle", "--older-than", "--landmarks"};
  if (std::ranges::none_of(selections, given))
    throw text::usage_error(
        "which vertices? Give --ids, -r, --dist or --angle, --older-than or --landmarks");
  constexpr auto question = "which poses?";
  cmd::at_most_one(command.app, {{"-r", "leaves every R-th"}, {"--dist", "one every D metres"}},
                   question);
  cmd::at_most_one(command.app, {{"-r", "leaves every R-th"}, {"--angle", "one every A degrees"}},
                   question);
  if (!options.landmarks.empty() && options.landmarks != "all" &&
      text::parse<Index>(options.landmarks).value_or(0) < 1)
    throw text::usage_error("--landmarks wants all, or a number of observations, not '" +
                            options.landmarks + "'");
  if (options.as == "factors" && options.topology != "dense")
    throw text::usage_error("--as factors is of --topology dense: a sparse one has poses");
  const bool linear = options.topology == "dense" && options.as != "poses";
  if (linear)
    cmd::refuse(command.app, {"--cluster", "--conservative"}, "on linear factors, which are exact");
  if (options.topology != "subgraph")
    cmd::refuse(command.app, {"-k"}, "but with --topology subgraph");
  if (options.topology != "l1") cmd::refuse(command.app, {"--penalty"}, "but with --topology l1");
  if (options.topology != "seif")
    cmd::refuse(command.app, {"--threshold"}, "but with --topology seif");
  if (options.topology != "ec")
    cmd::refuse(command.app, {"--price", "--ec", "--ec-part"}, "but with --topology ec");
  cmd::at_most_one(command.app,
                   {{"--price", "says what EC has to bring"},
                    {"--ec", "how much of it there may be"},
                    {"--ec-part", "what part of it"}},
                   "how much EC?");
}

// What --ids says: a list of ids and ranges, or the name of a file that holds them; and what they are called in a message.
struct Ids {
  std::vector<std::string> words;
  std::string name;
};
Ids ids_of(const Options& options) {
  if (options.ids.size() != 1 ||
      options.ids[0].find_first_not_of("0123456789:") == std::string::npos)
    return {options.ids, "--ids"};
  const std::string& path = options.ids[0];
  std::ifstream file(path);
  Ids ids{{}, "--ids " + path + ":"};
  for (std::string word; file >> word;) ids.words.push_back(word);
  if (!file.is_open() || file.bad())
    throw text::usage_error("--ids " + path +
                            " is neither a list of ids nor a file that can be read");
  return ids;
}

// The last pose that looks at every vertex, by pose index; of a pose its own; -1 of what none looks at.
std::vector<Index> last_looks(const Graph& graph, const graph::PoseIndex& poses) {
  std::vector<Index> last = poses.index;
  for (Index e = 0; e < graph.edges(); ++e) {
    Index pose = -1;
    for (const Index v : graph.edge(e)) pose = std::max(pose, poses.index[v]);
    for (const Index v : graph.edge(e)) {
      if (poses.index[v] < 0) last[v] = std::max(last[v], pose);
    }
  }
  return last;
}

void choose_landmarks(const Graph& graph, const std::string& which, std::vector<bool>& removed) {
  const bool all = which == "all";
  const Index least = all ? 0 : *text::parse<Index>(which);
  std::vector<Index> seen(graph.vertices(), 0);
  for (Index e = 0; e < graph.edges(); ++e) {
    const auto ends = graph.edge(e);
    if (std::ranges::any_of(ends, [&](Index v) { return graph.role(v) == graph::Role::pose; }))
      for (const Index v : ends) ++seen[v];
  }
  for (Index v = 0; v < graph.vertices(); ++v) {
    if (graph.role(v) == graph::Role::landmark && (all || seen[v] < least)) removed[v] = true;
  }
}

std::vector<bool> chosen_vertices(const Graph& graph, const Options& options) {
  std::vector<bool> removed(graph.vertices(), false);
  const graph::PoseIndex poses = graph::pose_index(graph);
  prune::KeyframeRule rule = options.rule;
  rule.angle = options.degrees * std::numbers::pi / 180;
  if (rule.rate > 0 || rule.distance > 0 || rule.angle > 0) {
    const auto keyframe =
        prune::choose_keyframes(graph, poses, prune::odometry_steps(graph, poses), rule);
    for (std::size_t k = 0; k < keyframe.size(); ++k) removed[poses.pose[k]] = !keyframe[k];
  }
  if (options.older_than) {
    const std::vector<Index> last = last_looks(graph, poses);
    for (Index v = 0; v < graph.vertices(); ++v) {
      if (last[v] < *options.older_than) removed[v] = true;
    }
  }
  if (!options.landmarks.empty()) choose_landmarks(graph, options.landmarks, removed);
  for (Index v = 0; v < graph.vertices(); ++v) {
    if (graph.fixed[v]) removed[v] = false;
  }
  if (options.ids.empty()) return removed;
  const Ids ids = ids_of(options);
  for (const auto& [first, last] : cmd::ranges_of_vertices(graph, ids.name, ids.words)) {
    for (auto id = std::ranges::lower_bound(graph.id, first); id != graph.id.end() && *id <= last;
         ++id) {
      const auto v = static_cast<Index>(id - graph.id.begin());
      if (graph.fixed[v])
        throw text::usage_error("--ids " + std::to_string(*id) +
                                ": a FIX line holds this vertex: it is a constant");
      removed[v] = true;
    }
  }
  return removed;
}

elim::Wide complexity(const graph::Pattern& pattern) {
  return elim::elimination_complexity(pattern, order::elimination_order("wmf", pattern));
}

// A warning where what is left costs more than it may.
void check_budget(const cmd::Command& command, const marginalize::Rule& rule, const Graph& graph,
                  const marginalize::Marginalization& result) {
  if (!rule.sparsity.ec) return;
  const elim::Wide ec = complexity(marginalize::pattern_left(graph, result).pattern);
  if (elim::to_double(ec) > *rule.sparsity.ec)
    cmd::warn(command, "an EC of " + text::format_number(*rule.sparsity.ec) +
                           " is less than that of the sparsest graph found, " +
                           elim::to_string(ec));
}

marginalize::Rule rule_of(const Options& options, const Graph& graph) {
  marginalize::Rule rule;
  rule.sparsity = options.sparsity;
  rule.sparsity.topology = *marginalize::topology(options.topology);
  rule.sparsity.extra = options.pairs.value_or(-1);
  rule.linear = options.topology == "dense" && options.as != "poses";
  rule.conservative = options.conservative;
  rule.sparsity.ec = options.ec;
  if (options.ec_part)
    rule.sparsity.ec =
        *options.ec_part * elim::to_double(complexity(graph::graph_pattern(graph).pattern));
  if (options.cluster == "batch") rule.clusters = marginalize::Clusters::batch;
  if (options.cluster == "global") rule.clusters = marginalize::Clusters::global;
  return rule;
}

void run(const cmd::Command& command, const Options& options) {
  check_call(command, options);
  const Graph graph = cmd::read(options.input);
  const std::vector<bool> removed = chosen_vertices(graph, options);
  const auto count = std::ranges::count(removed, true);
  if (count == 0) cmd::warn(command, graph.file + ": no vertex goes");
  if (count == graph.vertices())
    throw text::usage_error("all vertices of " + graph.file + " would go");
  if (graph.edges_only)
    throw text::input_error(graph.file, 0,
                            "there are no VERTEX lines, hence no estimates to linearize at "
                            "(sg-solve adds them)");
  cmd::stage("remove", count);
  const factor::Problem problem = factor::make_problem(graph);
  const factor::Values values = factor::file_values(problem);
  const marginalize::Rule rule = rule_of(options, graph);
  marginalize::Marginalization result = marginalize::marginalize(
      {problem, values}, removed, rule, [](Index gone) { cmd::progress(gone); });
  check_budget(command, rule, graph, result);
  cmd::note("took out " + std::to_string(count) + " of " + std::to_string(graph.vertices()) +
            " vertices, " + std::to_string(std::ranges::count(result.edge, true)) + " of " +
            std::to_string(graph.edges()) + " edges; " + std::to_string(result.factors.size()) +
            " come instead, divergence " + text::format_number(result.divergence));
  formats::Changes changes = formats::unchanged(graph);
  changes.drop_vertex = std::move(result.vertex);
  changes.drop_edge = std::move(result.edge);
  changes.append = std::move(result.lines);
  cmd::write_filtered(command, options.output, graph, std::move(changes));
}

}  // namespace

int main(int argc, char** argv) {
  return cmd::run(cmd::Command("sg-marg", "Take vertices out; keep what their edges knew."), argc,
                  argv, add_options, run);
}
