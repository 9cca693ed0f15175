// sg-tgreedy's choice, and what it would take to compute every candidate's resistance in every
// round. The latter is timed on a few rounds in the middle of the run, with the same factor and the
// same solves, and extrapolated to all rounds: `naive_s` in seconds, `speedup` against the whole
// lazy run.
#include <benchmark/benchmark.h>

#include <chrono>
#include <memory>

#include "formats/formats.h"
#include "lib/prune/candidates.h"
#include "lib/prune/tgreedy.h"
#include "lib/trees/spanning_trees.h"
#include "lib/world/sine.h"
#include "tests/bench/worlds.h"

using namespace sg;

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

Graph sine_graph() {
  std::string bytes;
  world::Out out{[&](std::string_view piece) { bytes += piece; }};
  world::write_graph(world::sine(world::Sine{}), world::Copy::noisy, out);
  world::flush(out);
  return formats::read_graph_text(text::text_of(std::move(bytes)), "sine");
}

struct Choice {
  Graph graph;
  std::vector<Index> candidates;
  std::size_t count;  // to keep
};

Choice choice(Graph graph, std::size_t one_in) {
  auto candidates =
      prune::candidate_edges(graph, graph::pose_index(graph), prune::natural_candidates(graph));
  const std::size_t count = candidates.size() / one_in;
  return {std::move(graph), std::move(candidates), count};
}

std::vector<trees::Edge> links_of(const Graph& graph) {
  const trees::Nodes nodes = trees::tree_nodes(graph);
  std::vector<trees::Edge> links;
  for (Index e = 0; e < graph.edges(); ++e)
    links.push_back({nodes.node[graph.edge(e)[0]], nodes.node[graph.edge(e)[1]]});
  return links;
}

// Seconds of one round after `accepted` choices: a solve for every candidate that is left.
double naive_round(const Choice& choice, std::span<const prune::Accepted> accepted) {
  const std::vector<trees::Edge> links = links_of(choice.graph);
  std::vector<double> weight(links.size(), 1);
  for (Index e : choice.candidates) weight[e] = 0;
  for (const prune::Accepted& step : accepted) weight[step.edge] = 1;
  trees::SpanningTrees spanning =
      trees::spanning_trees(trees::tree_nodes(choice.graph).count, links, weight);
  const auto start = Clock::now();
  double best = 0;
  for (Index e : choice.candidates) {
    if (weight[e] == 0) best = std::max(best, trees::gain(spanning, links[e], 1));
  }
  benchmark::DoNotOptimize(best);
  return seconds_since(start);
}

constexpr int sampled_rounds = 5;

void tgreedy_run(benchmark::State& state, const Choice& choice) {
  std::vector<prune::Accepted> accepted;
  double lazy = 0;
  for (auto _ : state) {
    const auto start = Clock::now();
    accepted = prune::tgreedy(choice.graph, choice.candidates, choice.count, trees::Weights::unit);
    lazy += seconds_since(start) / static_cast<double>(state.max_iterations);
  }
  double round = 0;  // mean over rounds at the middle of equal parts of the run
  for (int k = 0; k < sampled_rounds; ++k) {
    const std::size_t before = accepted.size() * (2 * k + 1) / (2 * sampled_rounds);
    round += naive_round(choice, std::span(accepted).first(before)) / sampled_rounds;
  }
  const double naive = round * static_cast<double>(accepted.size());
  state.counters["naive_s"] = naive;
  state.counters["speedup"] = naive / lazy;
}

void add(const std::string& name, const std::function<Choice()>& make) {
  benchmark::RegisterBenchmark(("tgreedy/" + name).c_str(), [make](benchmark::State& state) {
    tgreedy_run(state, make());
  })->Unit(benchmark::kMillisecond);
}

const bool registered = [] {
  for (const auto& path : bench::public_graphs({"city10000.g2o"}))
    add("city10000_half", [path] { return choice(formats::read_graph(path), 2); });
  add("sine_quarter", [] { return choice(sine_graph(), 4); });
  return true;
}();

}  // namespace
