// Options that several commands have, each declared once. (Those of a graph's reading and writing are in
// command.h, orderings in method.h, what pruning shares in prune_options.h.)
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "cmd/common/command.h"

namespace sg::cmd {

// Checks of an option's value, which add nothing to the help. What they say begins with the value; parse() (call.h) puts
// the option before it. A whole number may be written 1e5 or 100000.0 and is rewritten as 100000: ->transform(whole(1)).
CLI::Validator whole(std::int64_t least = 0, std::int64_t most = std::numeric_limits<Index>::max());
CLI::Validator number(double least = 0, double most = std::numeric_limits<double>::infinity());
CLI::Validator above_zero();
CLI::Validator one_of(const std::vector<std::string>& words);

// --seed N; 1 where nobody says.
CLI::Option* add_seed(CLI::App& app, std::uint64_t& seed, const std::string& what);

// The same of a pruning command that draws nothing: whoever sweeps over commands need not know.
void add_unused_seed(CLI::App& app);

// A replay's --min-obs M: "a landmark enters with its M-th observation"; `who` begins the sentence.
CLI::Option* add_entry(CLI::App& app, Index& min_obs, const std::string& who);
// A replay's --every K; `which` begins "every K-th step, and the last".
CLI::Option* add_every(CLI::App& app, Index& every, const std::string& which);

// --weights KIND of links in counting spanning trees (lib/trees), "unit" by default; `of` says what they
// weigh.
void add_weights(CLI::App& app, std::string& weights, const std::string& of);

// Names after `first`, in lines that fit a terminal beside the options.
std::string wrapped_list(std::string first, const std::vector<std::string>& names,
                         std::string_view separator);

}  // namespace sg::cmd
