// sg-kf: keep keyframes, by rate, distance, angle or covisibility, and compose the odometry between them; merge revisits.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "cmd/common/options.h"
#include "cmd/common/prune_options.h"
#include "cmd/kf/changes.h"
#include "lib/prune/covisible.h"
#include "lib/prune/keyframes.h"
#include "lib/text/words.h"

using namespace sg;

namespace {

struct Options {
  cmd::PruneOptions pruning;
  prune::KeyframeRule rule;
  double degrees = 0;
  std::string covisible;
  std::string revisit;
  std::string loops = "move";
  bool fuse = false;
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
      .add_option("--covisible", options.covisible,
                  "A keyframe goes if PART of its landmarks is seen\nfrom N others")
      ->option_text("PART,N");
  command.app
      .add_option("--revisit", options.revisit,
                  "A keyframe that a closure ties to an earlier one\nwithin DIST metres and ANGLE "
                  "degrees joins it")
      ->option_text("DIST,ANGLE");
  command.app
      .add_option(
          "--loops", options.loops,
          "Loop closures of dropped poses: move to the\nnearest keyframe (default), or drop")
      ->option_text("FATE")
      ->check(cmd::one_of({"move", "drop"}));
  command.app.add_flag("--fuse", options.fuse, "Join edges that come to join the same keyframes")
      ->option_text(" ");
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
  if (keyframing.merged > 0) {
    cmd::note("merged " + std::to_string(keyframing.merged) +
              " keyframes into earlier ones that they revisit");
  }
  if (!keyframing.fused.empty())
    cmd::note("made " + std::to_string(keyframing.fused.size()) + " edges of several");
}

// "X,Y"
std::optional<std::array<double, 2>> two_numbers(std::string_view text) {
  const auto comma = std::min(text.find(','), text.size());
  const auto first = text::parse<double>(text.substr(0, comma));
  const auto second = text::parse<double>(text.substr(std::min(comma + 1, text.size())));
  if (!first || !second || !std::isfinite(*first) || !std::isfinite(*second)) return std::nullopt;
  return {{*first, *second}};
}

std::optional<prune::CovisibleRule> covisible_rule(const std::string& text) {
  if (text.empty()) return std::nullopt;
  const auto numbers = two_numbers(text);
  if (numbers) {
    const auto [part, others] = *numbers;
    const bool whole = others >= 1 && others <= 1e9 && others == std::floor(others);
    if (part > 0 && part <= 1 && whole) return {{part, static_cast<Index>(others)}};
  }
  throw text::usage_error(
      "--covisible wants PART,N, a part in (0, 1] and a count of 1 or more, not '" + text + "'");
}

std::optional<prune::Revisit> revisit_rule(const std::string& text) {
  if (text.empty()) return std::nullopt;
  const auto numbers = two_numbers(text);
  if (numbers && (*numbers)[0] >= 0 && (*numbers)[1] >= 0)
    return {{(*numbers)[0], (*numbers)[1] * std::numbers::pi / 180}};
  throw text::usage_error("--revisit wants DIST,ANGLE, metres and degrees of 0 or more, not '" +
                          text + "'");
}

// Throws a usage Error unless the call says once how many keyframes there are. With --revisit all will do.
void check_call(const cmd::Command& command, const Options& options) {
  constexpr auto question = "how many keyframes?";
  const cmd::Choice rate{"-r", "keeps every R-th pose"}, dist{"--dist", "one every D metres"},
      angle{"--angle", "one every A degrees"}, covisible{"--covisible", "those that see the most"};
  cmd::at_most_one(command.app, {rate, dist, covisible}, question);
  cmd::at_most_one(command.app, {rate, angle, covisible}, question);
  const bool travelled = options.rule.distance > 0 || options.degrees > 0;
  if (options.rule.rate == 0 && !travelled && options.covisible.empty() && options.revisit.empty())
    throw text::usage_error(
        "how many keyframes? Give -r, --covisible or --revisit, or --dist and --angle or one of "
        "them");
  if (!options.revisit.empty() && options.loops == "drop")
    throw text::usage_error("--loops drop: --revisit follows loop closures");
}

std::vector<bool> chosen_keyframes(const Options& options, const Graph& graph,
                                   const graph::PoseIndex& poses, const graph::Lists<>& odometry) {
  if (const auto rule = covisible_rule(options.covisible))
    return prune::covisible_keyframes(graph, poses, odometry, *rule);
  prune::KeyframeRule rule = options.rule;
  rule.angle = options.degrees * std::numbers::pi / 180;
  if (rule.rate == 0 && rule.distance == 0 && rule.angle == 0) rule.rate = 1;  // --revisit alone
  return prune::choose_keyframes(graph, poses, odometry, rule);
}

void run(const cmd::Command& command, const Options& options) {
  check_call(command, options);
  covisible_rule(options.covisible);  // a wrong call is told before a long read
  const auto revisit = revisit_rule(options.revisit);
  const Graph graph = cmd::read(options.pruning.input);
  cmd::stage("prune");
  const graph::PoseIndex poses = graph::pose_index(graph);
  const graph::Lists<> odometry = prune::odometry_steps(graph, poses);
  const auto keyframes = chosen_keyframes(options, graph, poses, odometry);
  const prune::Keyframing keyframing = prune::keyframing(
      graph, poses, odometry, keyframes, {options.loops == "move", revisit, options.fuse});
  if (options.rule.rate != 1 && keyframing.merged == 0 &&
      std::ranges::find(keyframes, false) == keyframes.end())
    cmd::warn(command, graph.file + ": no pose was dropped: all " +
                           std::to_string(keyframes.size()) +
                           " are keyframes (the first of a segment, and fixed ones, always are)");
  report(command, keyframing);
  cmd::write_filtered(command, options.pruning.output, graph,
                      kf::changes(keyframing, options.pruning.min_obs));
}

}  // namespace

int main(int argc, char** argv) {
  return cmd::run(cmd::Command("sg-kf", "Keep keyframes; compose the odometry between them."), argc,
                  argv, add_options, run);
}
