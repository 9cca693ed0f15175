// Pruning: what may go, and the policies that choose.
#include <optional>

#include "cmd/common/prune_options.h"
#include "cmd/ecgreedy/budget.h"
#include "cmd/kf/changes.h"
#include "formats/applied.h"
#include "lib/order/order.h"
#include "lib/prune/decimate.h"
#include "lib/prune/ecgreedy.h"
#include "lib/prune/keyframes.h"
#include "lib/prune/sample.h"
#include "lib/prune/tgreedy.h"
#include "python/bind.h"

namespace sg::python {
namespace {

// What the policies choose from.
struct Subject {
  const Graph& graph;
  graph::PoseIndex poses;
  std::vector<Index> candidates;
};
Subject subject_of(const Graph& graph, const std::string& kind) {
  Subject subject{graph, graph::pose_index(graph), {}};
  subject.candidates =
      prune::candidate_edges(graph, subject.poses, prune::candidates_named(kind, graph));
  return subject;
}

Graph without_rest(const Subject& from, const std::vector<bool>& kept, Index min_obs) {
  return formats::applied(from.graph,
                          cmd::pruned(from.graph, from.poses, min_obs,
                                      prune::removal_of_rest(from.graph, from.candidates, kept)),
                          {});
}

template <class Choose>  // of a Subject: whether each candidate stays
SharedGraph pruned(const Graph& graph, const std::string& kind, Index min_obs,
                   const Choose& choose) {
  return unlocked([&] {
    const Subject from = subject_of(graph, kind);
    return shared(without_rest(from, choose(from), min_obs));
  });
}

SharedGraph decimate(const Graph& graph, Index rate, const std::string& offset,
                     const std::string& kind, Index min_obs, std::uint64_t seed) {
  const auto which = offset == "first"     ? prune::DecimationOffset::first
                     : offset == "aligned" ? prune::DecimationOffset::aligned
                                           : prune::DecimationOffset::random;
  if (which == prune::DecimationOffset::random && offset != "random")
    throw text::usage_error("offset: first, aligned or random, not '" + offset + "'");
  if (rate < 1) throw text::usage_error("rate: 1 or more");
  return pruned(graph, kind, min_obs, [&](const Subject& from) {
    return prune::decimate(graph, from.poses, from.candidates, rate, which, seed);
  });
}

SharedGraph sample(const Graph& graph, std::size_t keep, const std::string& kind, Index min_obs,
                   std::uint64_t seed) {
  return pruned(graph, kind, min_obs, [&](const Subject& from) {
    return prune::sample(from.candidates.size(), keep, seed);
  });
}

SharedGraph tgreedy(const Graph& graph, std::size_t keep, const std::string& weights,
                    const std::string& kind, Index min_obs) {
  const auto weigh = trees::tree_weights(weights);
  if (!weigh) throw text::usage_error("weights: '" + weights + "' are none (see sg-tgreedy(1))");
  return pruned(graph, kind, min_obs, [&](const Subject& from) {
    return prune::kept_by(from.candidates, prune::tgreedy(graph, from.candidates, keep, *weigh));
  });
}

SharedGraph ec_greedy(const Graph& graph, std::optional<double> ec, std::optional<double> sigma,
                      std::optional<Index> keep, const std::string& method, const std::string& kind,
                      Index min_obs, std::uint64_t seed) {
  if (ec.has_value() + sigma.has_value() + keep.has_value() != 1)
    throw text::usage_error("how much stays? One of ec, sigma and keep");
  return pruned(graph, kind, min_obs, [&](const Subject& from) {
    prune::EcGreedyOptions options;
    options.seed = order::draw_of(seed);
    if (ec) options.ec = ecgreedy::rounded(*ec);
    options.start_ec = options.ec;
    options.sigma = sigma;
    options.kept = keep;
    options.order = [&](const graph::GraphPattern& variables) {
      return chosen_order({method, {}}, 1, graph, variables);
    };
    return ecgreedy::kept_within({graph, from.poses, from.candidates, min_obs}, options);
  });
}

SharedGraph keyframes(const Graph& graph, Index rate, double distance, double angle,
                      bool move_loops, bool fuse, Index min_obs) {
  if (rate < 0 || (rate == 0 && distance <= 0 && angle <= 0))
    throw text::usage_error("how many keyframes? rate, or distance and angle or one of them");
  return unlocked([&] {
    const graph::PoseIndex poses = graph::pose_index(graph);
    const graph::Lists<> odometry = prune::odometry_steps(graph, poses);
    const prune::Keyframing keyframing =
        prune::keyframing(graph, poses, odometry,
                          prune::choose_keyframes(graph, poses, odometry, {rate, distance, angle}),
                          {move_loops, std::nullopt, fuse});
    return shared(formats::applied(graph, kf::changes(keyframing, min_obs), {}));
  });
}

}  // namespace

void bind_pruning(py::module_& module) {
  using namespace py::literals;
  const auto kind = "candidates"_a = "";
  const auto min_obs = "min_obs"_a = 1;
  module.def(
      "candidates",
      [](const Graph& graph, const std::string& of) {
        return unlocked([&] { return subject_of(graph, of).candidates.size(); });
      },
      "graph"_a, kind,
      "How many edges pruning chooses from: observations, loops, both, or what the graph has.");
  module.def("decimate", &decimate, "graph"_a, "rate"_a, py::kw_only(), "offset"_a = "first", kind,
             min_obs, "seed"_a = 1, "Keep every rate-th observation of each landmark: sg-dec(1).");
  module.def("keyframes", &keyframes, "graph"_a, py::kw_only(), "rate"_a = 0, "distance"_a = 0.0,
             "angle"_a = 0.0, "move_loops"_a = true, "fuse"_a = false, min_obs,
             "Keep keyframes, and compose the odometry between them: sg-kf(1). angle: in radians.");
  module.def("sample", &sample, "graph"_a, "keep"_a, py::kw_only(), kind, min_obs, "seed"_a = 1,
             "Keep so many candidates, drawn at random: sg-rand(1).");
  module.def("tgreedy", &tgreedy, "graph"_a, "keep"_a, py::kw_only(), "weights"_a = "unit", kind,
             min_obs, "Keep the candidates that carry most spanning trees: sg-tgreedy(1).");
  module.def("ecgreedy", &ec_greedy, "graph"_a, py::kw_only(), "ec"_a = py::none(),
             "sigma"_a = py::none(), "keep"_a = py::none(), "order"_a = "wmf", kind, min_obs,
             "seed"_a = 1,
             "Keep the candidates that add most accuracy for their elimination complexity: "
             "sg-ecgreedy(1).\nUp to an EC, to a mean sigma of positions, or to a count.");
}

}  // namespace sg::python
