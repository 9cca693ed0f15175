#include <numbers>

#include "cmd/common/prune_options.h"
#include "lib/prune/keyframes.h"

namespace {

struct Options {
  sg::Input input;
  sg::OutputOptions output;
  sg::KeyframeRule rule;
  double degrees = 0;
  std::string loops = "move";
  sg::Index min_obs = 1;
};

void add_options(sg::Command& command, Options& options) {
  const auto positive = CLI::PositiveNumber.description("");
  sg::add_input(command, options.input);
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
      ->type_name("FATE")
      ->check(CLI::IsMember({"move", "drop"}).description(""));
  sg::add_min_obs(command, options.min_obs);
  sg::add_filter_output(command, options.output);
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

void prune(const sg::Command& command, Options options) {
  options.rule.angle = options.degrees * std::numbers::pi / 180;
  const bool travelled = options.rule.distance > 0 || options.rule.angle > 0;
  if ((options.rule.rate > 0) == travelled)
    throw sg::usage_error("how many keyframes? Give -r, or --dist and --angle or one of them");
  const sg::Graph graph = sg::read(options.input);
  const sg::PoseIndex poses = sg::pose_index(graph);
  const sg::Lists<> odometry = sg::odometry_steps(graph, poses);
  const auto keyframes = sg::choose_keyframes(graph, poses, odometry, options.rule);
  sg::Keyframing keyframing =
      sg::keyframing(graph, poses, odometry, keyframes, options.loops == "move");
  report(command, keyframing);
  sg::Changes changes =
      sg::pruned(command, graph, poses, options.min_obs, std::move(keyframing.removal));
  changes.late_edge = keyframing.late;
  changes.edge_line = [&](sg::Index e) -> std::optional<std::string> {
    if (!keyframing.rewritten[e]) return std::nullopt;
    return sg::rewritten_line(keyframing, e);
  };
  sg::write_filtered(command, options.output, graph, std::move(changes));
}

}  // namespace

int main(int argc, char** argv) {
  sg::Command command("sg-kf", "Keep keyframes; compose the odometry between them.");
  Options options;
  add_options(command, options);
  return sg::run(command, argc, argv, [&] { prune(command, options); });
}
