// Which vertices that go are eliminated together before what they leave is made sparse.
#pragma once

#include <cstdint>
#include <vector>

#include "lib/graph/graph.h"

namespace sg::marginalize {

// Every vertex alone, by ascending id; runs of poses without one that stays between them, landmarks alone; all that
// edges connect, as long as what they leave has no more than most_scalars.
enum class Clusters : std::uint8_t { online, batch, global };
constexpr int most_scalars = 48;

std::vector<std::vector<Index>> clusters(const Graph& graph, const std::vector<bool>& removed,
                                         Clusters kind);

}  // namespace sg::marginalize
