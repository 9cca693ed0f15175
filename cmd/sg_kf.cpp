// sg-kf: keep keyframes, by rate, distance or angle, and compose the odometry between them.
#include <numbers>

#include "cmd/common/options.h"
#include "cmd/common/prune_options.h"
#include "lib/prune/keyframes.h"

namespace {

struct Options {
  sg::PruneOptions pruning;
  sg::KeyframeRule rule;
  double degrees = 0;
  std::string loops = "move";
};

void add_options(sg::Command& command, Options& options) {
  const auto positive = CLI::PositiveNumber.description("");
  sg::add_input(command, options.pruning.input);
  command.app.add_option("-r,--rate", options.rule.rate, "Every R-th pose stays")
      ->type_name("R")
      ->check(sg::at_least_one());
  command.app
      .add_option("--dist", options.rule.distance, "A keyframe every D metres travelled, or")
      ->type_name("D")
      ->check(positive);
  command.app.add_option("--angle", options.degrees, "every A degrees turned")
      ->type_name("A")
      ->check(positive);
  command.app
      .add_option(
          "--loops", options.loops,
          "Loop closures of dropped poses: move to the\nnearest keyframe (default), or drop")
      ->option_text("FATE")
      ->check(sg::one_of({"move", "drop"}));
  sg::add_pruned_output(command, options.pruning);
}

void report(const sg::Command& command, const sg::Keyframing& keyframing) {
  if (keyframing.dropped_priors > 0) {
    sg::warn(command, "left out " + std::to_string(keyframing.dropped_priors) +
                          " unary edges (priors) of dropped poses");
  }
  if (command.verbose && keyframing.collapsed_loops > 0) {
    sg::warn(command, "left out " + std::to_string(keyframing.collapsed_loops) +
                          " loop closures whose ends have the same nearest keyframe");
  }
}

void prune(const sg::Command& command, const Options& options) {
  sg::KeyframeRule rule = options.rule;
  rule.angle = options.degrees * std::numbers::pi / 180;
  const bool travelled = rule.distance > 0 || rule.angle > 0;
  if ((rule.rate > 0) == travelled)
    throw sg::usage_error("how many keyframes? Give -r, or --dist and --angle or one of them");
  const sg::Graph graph = sg::read(options.pruning.input);
  const sg::PoseIndex poses = sg::pose_index(graph);
  const sg::Lists<> odometry = sg::odometry_steps(graph, poses);
  const auto keyframes = sg::choose_keyframes(graph, poses, odometry, rule);
  sg::Keyframing keyframing =
      sg::keyframing(graph, poses, odometry, keyframes, options.loops == "move");
  report(command, keyframing);
  sg::Changes changes =
      sg::pruned(command, graph, poses, options.pruning.min_obs, std::move(keyframing.removal));
  changes.late_edge = keyframing.late;
  changes.edge_line = [&](sg::Index e) -> std::optional<std::string> {
    if (!keyframing.rewritten[e]) return std::nullopt;
    return sg::rewritten_line(keyframing, e);
  };
  sg::write_filtered(command, options.pruning.output, graph, std::move(changes));
}

}  // namespace

int main(int argc, char** argv) {
  return sg::run(sg::Command("sg-kf", "Keep keyframes; compose the odometry between them."), argc,
                 argv, add_options, prune);
}
