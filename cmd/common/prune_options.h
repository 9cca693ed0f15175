// What the pruning commands share: what may go, how much stays, and writing what is left.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "cmd/common/command.h"
#include "lib/prune/candidates.h"

namespace sg::cmd {

struct PruneOptions {
  Input input;             // add_input
  std::string candidates;  // --candidates observations|loops|both; empty: the graph's natural ones
  Index min_obs = 1;       // --min-obs: landmarks left with fewer observations leave
  OutputOptions output;
};
// --candidates, --min-obs, and the output.
void add_pruning(Command& command, PruneOptions& options);
// The same for a command whose candidates are its own affair.
void add_pruned_output(Command& command, PruneOptions& options);

// -r, -p, -k, --like: how many candidates stay. Exactly one of them.
struct Amount {
  std::optional<Index> rate;
  std::optional<double> fraction;
  std::optional<std::int64_t> count;
  std::string like;
};
void add_amount(Command& command, Amount& amount);
void check_amount(const Command& command);  // throws a usage Error

// A graph about to be pruned.
struct Prunable {
  Graph graph;
  graph::PoseIndex poses;
  prune::Candidates kind;
  std::vector<Index> candidates;  // edges, in file order
};
Prunable read_prunable(const PruneOptions& options);
// At most all candidates. --like reads its file with the options of the input.
std::size_t kept_count(const Amount& amount, const Prunable& prunable,
                       const formats::ReadOptions& options);

// Whether less than all candidates are asked for.
bool asks_to_prune(const Amount& amount);
// `kept`: of every candidate, whether it stays.
void warn_if_nothing_goes(const Command& command, const Prunable& prunable,
                          const std::vector<bool>& kept, bool asked);

// The changes to a graph that a removal makes, after a sweep of its landmarks; -v reports them.
formats::Changes pruned(const Graph& graph, const graph::PoseIndex& poses, Index min_obs,
                        prune::Removal removal);
// Writes the graph without what a removal makes leave.
void write_pruned(const Command& command, const PruneOptions& options, const Prunable& prunable,
                  prune::Removal removal);
// The same for a policy that says of every candidate whether it stays. `asked`: whether the call asks to
// remove any; that none goes is told then.
void prune(const Command& command, const PruneOptions& options, bool asked,
           const std::function<std::vector<bool>(const Prunable&)>& kept);

}  // namespace sg::cmd
