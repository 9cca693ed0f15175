#include "cmd/common/prune_options.h"

#include <algorithm>
#include <cmath>

namespace sg {
namespace {

std::string counted(std::ptrdiff_t count, std::size_t of, const char* things) {
  return std::to_string(count) + " of " + std::to_string(of) + " " + things;
}

}  // namespace

void add_candidates(Command& command, std::string& name) {
  command.app
      .add_option("--candidates", name,
                  "What may go: observations, loops or both;\n"
                  "observations if there are landmarks, else loops")
      ->type_name("KIND")
      ->check(CLI::IsMember({"observations", "loops", "both"}));
}

Candidates candidates_named(const std::string& name, const Graph& graph) {
  if (name == "observations") return Candidates::observations;
  if (name == "loops") return Candidates::loops;
  return name == "both" ? Candidates::both : natural_candidates(graph);
}

CLI::Validator at_least_one() {
  return CLI::Range(Index{1}, std::numeric_limits<Index>::max()).description("");
}

void add_min_obs(Command& command, Index& min_obs) {
  command.app.add_option("--min-obs", min_obs, "Landmarks left with fewer observations leave (1)")
      ->type_name("M")
      ->check(at_least_one());
}

void add_amount(Command& command, Amount& amount) {
  auto* group = command.app.add_option_group("How many candidates stay (one of these)");
  group->add_option("-r,--rate", amount.rate, "One in R stays")
      ->type_name("R")
      ->check(at_least_one());
  group->add_option("-p,--part", amount.fraction, "This part of them stays, 0 to 1")
      ->type_name("FRACTION")
      ->check(CLI::Range(0.0, 1.0).description(""));
  group->add_option("-k,--keep", amount.count, "So many stay")
      ->type_name("COUNT")
      ->check(CLI::NonNegativeNumber.description(""));
  group->add_option("--like", amount.like, "As many stay as FILE has")->type_name("FILE");
  group->require_option(1);
}

std::size_t kept_count(const Amount& amount, std::size_t candidates, Candidates kind,
                       const ReadOptions& options) {
  if (amount.rate) return (candidates + *amount.rate / 2) / *amount.rate;
  if (amount.fraction)
    return static_cast<std::size_t>(
        std::llround(*amount.fraction * static_cast<double>(candidates)));
  if (amount.count) return std::min(candidates, static_cast<std::size_t>(*amount.count));
  const Graph like = read_graph(amount.like, options);
  return std::min(candidates, candidate_edges(like, pose_index(like), kind).size());
}

Changes pruned(const Command& command, const Graph& graph, const PoseIndex& poses, Index min_obs,
               Removal removal) {
  sweep_landmarks(graph, poses, min_obs, removal);
  if (command.verbose) {
    const auto vertices = std::count(removal.vertex.begin(), removal.vertex.end(), true);
    const auto edges = std::count(removal.edge.begin(), removal.edge.end(), true);
    warn(command, "removed " + counted(vertices, removal.vertex.size(), "vertices") + ", " +
                      counted(edges, removal.edge.size(), "edges"));
  }
  Changes changes;
  changes.drop_vertex = std::move(removal.vertex);
  changes.drop_edge = std::move(removal.edge);
  return changes;
}

}  // namespace sg
