// A random permutation: what an ordering has to beat.
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/uniform_int_distribution.hpp>
#include <utility>

#include "lib/order/methods.h"

namespace sg::order::methods {

// Fisher and Yates, written out: std::shuffle draws differently from library to library.
graph::Order random(const graph::Pattern& pattern, const OrderOptions& options) {
  boost::random::mt19937_64 generator(options.seed);
  graph::Order order = id(pattern, options);
  for (Index k = pattern.variables() - 1; k > 0; --k) {
    std::swap(order[k], order[boost::random::uniform_int_distribution<Index>(0, k)(generator)]);
  }
  return order;
}

}  // namespace sg::order::methods
