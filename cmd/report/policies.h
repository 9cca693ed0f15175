// The policies that a page compares: what each of them leaves of a graph, and the commands that do the same.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "formats/formats.h"
#include "lib/graph/graph.h"

namespace sg::report {

using GoOn = std::function<bool()>;

// How much goes, and what of it all policies share.
struct Pruning {
  const formats::ReadOptions& reading;  // which teach the tags that the graph was read with
  Index rate;
  Index min_obs;  // landmarks with fewer observations go
  GoOn go_on;
};

struct Policy {
  std::string_view name;
  std::string_view what;
  bool rated;                                        // false: the rate says nothing to it
  std::vector<std::string> (*commands)(Index rate);  // which --min-obs follows
  std::optional<Graph> (*prune)(const Graph& graph,
                                const Pruning& pruning);  // nothing where go_on ended it
};

// The first leaves the graph as it is.
std::span<const Policy> policies();

}  // namespace sg::report
