#include "cmd/report/policies.h"

#include "cmd/common/method.h"
#include "cmd/common/prune_options.h"
#include "cmd/ecgreedy/budget.h"
#include "cmd/kf/changes.h"
#include "formats/applied.h"
#include "lib/prune/covisible.h"
#include "lib/prune/decimate.h"
#include "lib/prune/sample.h"
#include "lib/prune/tgreedy.h"
#include "lib/text/words.h"

namespace sg::report {
namespace {

using Commands = std::vector<std::string>;

std::string with_rate(const char* command, Index rate) {
  return std::string(command) + " -r " + std::to_string(rate);
}

constexpr prune::CovisibleRule covisible_rule{0.9, 3};
constexpr double ecgreedy_behind_keyframes = 0.5;

std::string ecgreedy_command(double part) {
  return "sg-ecgreedy --ec-part " + text::format_number(part);
}

// The graph with the candidates that are kept; `kept` is asked of what may go.
std::optional<Graph> with_kept(const Graph& graph, const Pruning& pruning, const auto& kept) {
  const graph::PoseIndex poses = graph::pose_index(graph);
  const auto candidates = prune::candidate_edges(graph, poses, prune::natural_candidates(graph));
  const std::optional<std::vector<bool>> stays = kept(poses, candidates);
  if (!stays) return std::nullopt;
  return formats::applied(
      graph,
      cmd::pruned(graph, poses, pruning.min_obs, prune::removal_of_rest(graph, candidates, *stays)),
      pruning.reading);
}

std::optional<Graph> keyframes(const Graph& graph, const Pruning& pruning, const auto& choose) {
  const graph::PoseIndex poses = graph::pose_index(graph);
  const graph::Lists<> odometry = prune::odometry_steps(graph, poses);
  const std::vector<bool> chosen = choose(poses, odometry);
  const prune::Keyframing keyframing = prune::keyframing(graph, poses, odometry, chosen, {});
  return formats::applied(graph, kf::changes(keyframing, pruning.min_obs), pruning.reading);
}

std::optional<Graph> by_rate(const Graph& graph, const Pruning& pruning) {
  return keyframes(graph, pruning, [&](const auto& poses, const auto& odometry) {
    return prune::choose_keyframes(graph, poses, odometry, {.rate = pruning.rate});
  });
}

std::optional<Graph> covisible(const Graph& graph, const Pruning& pruning) {
  return keyframes(graph, pruning, [&](const auto& poses, const auto& odometry) {
    return prune::covisible_keyframes(graph, poses, odometry, covisible_rule);
  });
}

template <prune::DecimationOffset offset>
std::optional<Graph> decimated(const Graph& graph, const Pruning& pruning) {
  return with_kept(graph, pruning, [&](const auto& poses, const auto& candidates) {
    return std::optional(prune::decimate(graph, poses, candidates, pruning.rate, offset, 1));
  });
}

std::optional<Graph> at_random(const Graph& graph, const Pruning& pruning) {
  return with_kept(graph, pruning, [&](const auto& /*poses*/, const auto& candidates) {
    return std::optional(
        prune::sample(candidates.size(), prune::one_in(pruning.rate, candidates.size()), 1));
  });
}

std::optional<Graph> by_trees(const Graph& graph, const Pruning& pruning) {
  return with_kept(graph, pruning, [&](const auto& /*poses*/, const auto& candidates) {
    bool whole = true;
    const auto accepted =
        prune::tgreedy(graph, candidates, prune::one_in(pruning.rate, candidates.size()),
                       trees::Weights::unit, [&](std::size_t) { return whole = pruning.go_on(); });
    if (!whole) return std::optional<std::vector<bool>>();
    return std::optional(prune::kept_by(candidates, accepted));
  });
}

std::optional<Graph> by_accuracy(const Graph& graph, const Pruning& pruning, double part) {
  return with_kept(graph, pruning, [&](const auto& poses, const auto& candidates) {
    const cmd::MethodOptions method{{"wmf"}};
    bool whole = true;
    prune::EcGreedyOptions greedy;
    greedy.seed = order::draw_of(method.seed);
    greedy.order = [&](const graph::GraphPattern& variables) {
      return cmd::order_by(cmd::methods(method, graph).front(), method, graph, variables);
    };
    greedy.go_on = [&](Index) { return whole = pruning.go_on(); };
    greedy.ec = greedy.start_ec = ecgreedy::part_of_ec(graph, part, greedy);
    std::vector<bool> kept =
        ecgreedy::kept_within({graph, poses, candidates, pruning.min_obs}, greedy);
    return whole ? std::optional(std::move(kept)) : std::nullopt;
  });
}

const std::vector<Policy> table{
    {"full", "the whole graph", false, [](Index) { return Commands{}; },
     [](const Graph& graph, const Pruning&) { return std::optional(graph); }},
    {"kf", "every R-th pose is a keyframe, and stays", true,
     [](Index rate) { return Commands{with_rate("sg-kf", rate)}; }, by_rate},
    {"dec", "of every landmark, observations from every R-th pose", true,
     [](Index rate) { return Commands{with_rate("sg-dec", rate)}; },
     decimated<prune::DecimationOffset::first>},
    {"aligned", "the same, from the same poses for all landmarks", true,
     [](Index rate) { return Commands{with_rate("sg-dec", rate) + " --offset aligned"}; },
     decimated<prune::DecimationOffset::aligned>},
    {"rand", "one in R at random", true,
     [](Index rate) { return Commands{with_rate("sg-rand", rate)}; }, at_random},
    {"covisible", "keyframes that see what others do not", false,
     [](Index) {
       return Commands{"sg-kf --covisible " + text::format_number(covisible_rule.part) + "," +
                       std::to_string(covisible_rule.others)};
     },
     covisible},
    {"ecgreedy", "what tells most for its EC, until that is one R-th of the whole", true,
     [](Index rate) { return Commands{ecgreedy_command(1.0 / rate)}; },
     [](const Graph& graph, const Pruning& pruning) {
       return by_accuracy(graph, pruning, 1.0 / pruning.rate);
     }},
    {"kf|ecgreedy", "keyframes, and of them what tells most for half of their EC", true,
     [](Index rate) {
       return Commands{with_rate("sg-kf", rate), ecgreedy_command(ecgreedy_behind_keyframes)};
     },
     [](const Graph& graph, const Pruning& pruning) {
       const std::optional<Graph> kept = by_rate(graph, pruning);
       return by_accuracy(*kept, pruning, ecgreedy_behind_keyframes);
     }},
    {"tgreedy", "one in R: those that add most to the number of spanning trees", true,
     [](Index rate) { return Commands{with_rate("sg-tgreedy", rate)}; }, by_trees},
};

}  // namespace

std::span<const Policy> policies() {
  return table;
}

}  // namespace sg::report
