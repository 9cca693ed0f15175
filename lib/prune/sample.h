// A random choice, for comparison with policies that know what they do.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sg::prune {

// Marks `count` of n things; every subset of that size is equally likely. All of them if count >=
// n. Selection sampling (Knuth, The Art of Computer Programming, vol. 2, algorithm 3.4.2 S). O(n).
std::vector<bool> sample(std::size_t n, std::size_t count, std::uint64_t seed);

}  // namespace sg::prune
