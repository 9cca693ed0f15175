#include "lib/prune/sample.h"

#include <algorithm>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/uniform_int_distribution.hpp>

namespace sg::prune {

std::vector<bool> sample(std::size_t n, std::size_t count, std::uint64_t seed) {
  boost::random::mt19937_64 bits(seed);
  std::vector<bool> chosen(n, false);
  std::size_t wanted = std::min(n, count);
  for (std::size_t i = 0; i < n && wanted > 0; ++i) {
    const boost::random::uniform_int_distribution<std::uint64_t> draw(0, n - i - 1);
    if (draw(bits) >= wanted) continue;
    chosen[i] = true;
    --wanted;
  }
  return chosen;
}

}  // namespace sg::prune
