// sg-kf: keep keyframes, by rate, distance or angle, and compose the odometry between them.
#include <algorithm>
#include <numbers>

#include "cmd/common/options.h"
#include "cmd/common/prune_options.h"
#include "lib/prune/keyframes.h"

using namespace sg;

namespace {

struct Options {
  cmd::PruneOptions pruning;
  prune::KeyframeRule rule;
  double degrees = 0;
  std::string loops = "move";
};

void add_options(cmd::Command& command, Options& options) {
  cmd::add_input(command, options.pruning.input);
  command.app.add_option("-r,--rate", options.rule.rate, "Every R-th pose stays")
      ->type_name("R")
      ->transform(cmd::whole(1));
  command.app
      .add_option("--dist", options.rule.distance, "A keyframe every D metres travelled, or")
      ->type_name("D")
      ->check(cmd::above_zero());
  command.app.add_option("--angle", options.degrees, "every A degrees turned")
      ->type_name("A")
      ->check(cmd::above_zero());
  command.app
      .add_option(
          "--loops", options.loops,
          "Loop closures of dropped poses: move to the\nnearest keyframe (default), or drop")
      ->option_text("FATE")
      ->check(cmd::one_of({"move", "drop"}));
  cmd::add_unused_seed(command.app);
  cmd::add_pruned_output(command, options.pruning);
}

void report(const cmd::Command& command, const prune::Keyframing& keyframing) {
  if (keyframing.dropped_priors > 0) {
    cmd::warn(command, "left out " + std::to_string(keyframing.dropped_priors) +
                           " unary edges (priors) of dropped poses");
  }
  if (keyframing.collapsed_loops > 0) {
    cmd::note("left out " + std::to_string(keyframing.collapsed_loops) +
              " loop closures whose ends have the same nearest keyframe");
  }
}

void run(const cmd::Command& command, const Options& options) {
  constexpr auto question = "how many keyframes?";
  cmd::at_most_one(command.app, {{"-r", "keeps every R-th pose"}, {"--dist", "one every D metres"}},
                   question);
  cmd::at_most_one(command.app,
                   {{"-r", "keeps every R-th pose"}, {"--angle", "one every A degrees"}}, question);
  prune::KeyframeRule rule = options.rule;
  rule.angle = options.degrees * std::numbers::pi / 180;
  const bool travelled = rule.distance > 0 || rule.angle > 0;
  if ((rule.rate > 0) == travelled)
    throw text::usage_error("how many keyframes? Give -r, or --dist and --angle or one of them");
  const Graph graph = cmd::read(options.pruning.input);
  cmd::stage("prune");
  const graph::PoseIndex poses = graph::pose_index(graph);
  const graph::Lists<> odometry = prune::odometry_steps(graph, poses);
  const auto keyframes = prune::choose_keyframes(graph, poses, odometry, rule);
  prune::Keyframing keyframing =
      prune::keyframing(graph, poses, odometry, keyframes, options.loops == "move");
  if (rule.rate != 1 && std::ranges::find(keyframes, false) == keyframes.end())
    cmd::warn(command, graph.file + ": no pose was dropped: all " +
                           std::to_string(keyframes.size()) +
                           " are keyframes (the first of a segment, and fixed ones, always are)");
  report(command, keyframing);
  formats::Changes changes =
      cmd::pruned(graph, poses, options.pruning.min_obs, std::move(keyframing.removal));
  changes.late_edge = keyframing.late;
  changes.edge_line = [&](Index e) -> std::optional<std::string> {
    if (!keyframing.rewritten[e]) return std::nullopt;
    return prune::rewritten_line(keyframing, e);
  };
  cmd::write_filtered(command, options.pruning.output, graph, std::move(changes));
}

}  // namespace

int main(int argc, char** argv) {
  return cmd::run(cmd::Command("sg-kf", "Keep keyframes; compose the odometry between them."), argc,
                  argv, add_options, run);
}
