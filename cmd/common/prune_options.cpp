#include "cmd/common/prune_options.h"

#include <algorithm>
#include <cmath>

#include "cmd/common/options.h"

namespace sg::cmd {
namespace {

std::string counted(std::ptrdiff_t count, std::size_t of, const char* things) {
  return std::to_string(count) + " of " + std::to_string(of) + " " + things;
}

// The kind of that name; an empty name means the graph's natural candidates.
}  // namespace

void add_pruning(Command& command, PruneOptions& options) {
  command.app
      .add_option("--candidates", options.candidates,
                  "What may go: observations, loops or both;\n"
                  "observations if there are landmarks, else loops")
      ->option_text("KIND")
      ->check(one_of({"observations", "loops", "both"}));
  add_pruned_output(command, options);
}

void add_pruned_output(Command& command, PruneOptions& options) {
  command.app
      .add_option("--min-obs", options.min_obs, "Landmarks with fewer observations go (default: 1)")
      ->option_text("M")
      ->transform(whole(1));
  add_filter_output(command, options.output);
}

void add_amount(Command& command, Amount& amount) {
  CLI::App& app = command.app;
  app.add_option("-r,--rate", amount.rate, "How many candidates stay: one in R,")
      ->type_name("R")
      ->transform(whole(1));
  app.add_option("-p,--part", amount.fraction, "or this part of them (0 to 1),")
      ->type_name("FRACTION")
      ->check(number(0, 1));
  app.add_option("-k,--keep", amount.count, "or so many,")
      ->type_name("COUNT")
      ->transform(whole(0, std::numeric_limits<std::int64_t>::max()));
  app.add_option("--like", amount.like, "or as many as FILE has")->type_name("FILE");
}

void check_amount(const Command& command) {
  exactly_one(command.app,
              {{"-r", "keeps one in R"},
               {"-p", "this part of them"},
               {"-k", "so many"},
               {"--like", "as many as FILE has"}},
              "how many candidates stay?");
}

Prunable read_prunable(const PruneOptions& options) {
  Prunable result;
  result.graph = read(options.input);
  result.poses = graph::pose_index(result.graph);
  result.kind = prune::candidates_named(options.candidates, result.graph);
  result.candidates = prune::candidate_edges(result.graph, result.poses, result.kind);
  return result;
}

bool asks_to_prune(const Amount& amount) {
  return amount.rate.value_or(2) > 1 && amount.fraction.value_or(0) < 1;
}

std::size_t kept_count(const Amount& amount, const Prunable& prunable,
                       const formats::ReadOptions& options) {
  const std::size_t candidates = prunable.candidates.size();
  if (amount.rate) return prune::one_in(*amount.rate, candidates);
  if (amount.fraction)
    return static_cast<std::size_t>(
        std::llround(*amount.fraction * static_cast<double>(candidates)));
  if (amount.count) return std::min(candidates, static_cast<std::size_t>(*amount.count));
  const Graph like = formats::read_graph(amount.like, options);
  return std::min(candidates,
                  prune::candidate_edges(like, graph::pose_index(like), prunable.kind).size());
}

formats::Changes pruned(const Graph& graph, const graph::PoseIndex& poses, Index min_obs,
                        prune::Removal removal) {
  prune::sweep_landmarks(graph, poses, min_obs, removal);
  const auto vertices = std::count(removal.vertex.begin(), removal.vertex.end(), true);
  const auto edges = std::count(removal.edge.begin(), removal.edge.end(), true);
  note("removed " + counted(vertices, removal.vertex.size(), "vertices") + ", " +
       counted(edges, removal.edge.size(), "edges"));
  formats::Changes changes;
  changes.drop_vertex = std::move(removal.vertex);
  changes.drop_edge = std::move(removal.edge);
  return changes;
}

void write_pruned(const Command& command, const PruneOptions& options, const Prunable& prunable,
                  prune::Removal removal) {
  const auto& [graph, poses, kind, candidates] = prunable;
  write_filtered(command, options.output, graph,
                 pruned(graph, poses, options.min_obs, std::move(removal)));
}

void warn_if_nothing_goes(const Command& command, const Prunable& prunable,
                          const std::vector<bool>& kept, bool asked) {
  if (!asked || std::ranges::find(kept, false) != kept.end()) return;
  const bool loops = prunable.kind == prune::Candidates::loops;
  const std::string kind = loops ? "loop closures"
                           : prunable.kind == prune::Candidates::observations
                               ? "observations of landmarks"
                               : "loop closures and observations";
  warn(command, prunable.graph.file +
                    (kept.empty() ? ": there was nothing to prune: no " + kind +
                                        " among its edges (odometry, and what joins other "
                                        "vertices than poses and landmarks, never goes)"
                                  : ": nothing was pruned: all " + std::to_string(kept.size()) +
                                        " " + kind + " stay"));
}

void prune(const Command& command, const PruneOptions& options, bool asked,
           const std::function<std::vector<bool>(const Prunable&)>& kept) {
  const Prunable prunable = read_prunable(options);
  stage("prune");
  const std::vector<bool> stays = kept(prunable);
  warn_if_nothing_goes(command, prunable, stays, asked);
  write_pruned(command, options, prunable,
               prune::removal_of_rest(prunable.graph, prunable.candidates, stays));
}

}  // namespace sg::cmd
