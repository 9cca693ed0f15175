// What the pruning commands share: what may go, how much stays, and writing what is left.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "cmd/common/command.h"
#include "lib/prune/candidates.h"

namespace sg {

// --candidates observations|loops|both
void add_candidates(Command& command, std::string& name);
// The kind of that name; an empty name means the graph's natural candidates.
Candidates candidates_named(const std::string& name, const Graph& graph);

// --min-obs M: landmarks left with fewer observations leave.
void add_min_obs(Command& command, Index& min_obs);

// -r, -p, -k, --like: how many candidates stay. Exactly one of them.
struct Amount {
  std::optional<Index> rate;
  std::optional<double> fraction;
  std::optional<std::int64_t> count;
  std::string like;
};
void add_amount(Command& command, Amount& amount);
// At most `candidates`. --like reads its file with the options of the input.
std::size_t kept_count(const Amount& amount, std::size_t candidates, Candidates kind,
                       const ReadOptions& options);

// CLI11's check of a number that has to be 1 or more.
CLI::Validator at_least_one();

// The changes to a graph that a removal makes, after a sweep of its landmarks; -v reports them.
Changes pruned(const Command& command, const Graph& graph, const PoseIndex& poses, Index min_obs,
               Removal removal);

}  // namespace sg
