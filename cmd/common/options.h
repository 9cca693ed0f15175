// Options that several commands have, each declared once. (Those of a graph's reading and writing are in
// command.h, orderings in method.h, what pruning shares in prune_options.h.)
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "cmd/common/command.h"

namespace sg::cmd {

// CLI11's checks, of a number that has to be 1 or more and of a word among some, that add nothing to
// the help.
CLI::Validator at_least_one();
CLI::Validator one_of(const std::vector<std::string>& words);

// --seed N. Orderings have 0, which draws nothing where ties can do without; what is made by drawing
// has 1.
void add_seed(CLI::App& app, std::uint64_t& seed, const std::string& what);

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
