#include "lib/world/random.h"

#include <array>
#include <boost/random/normal_distribution.hpp>
#include <boost/random/seed_seq.hpp>
#include <boost/random/uniform_01.hpp>

namespace sg::world {

Random random_stream(std::uint64_t seed, Stream stream) {
  const std::array<std::uint32_t, 3> words{static_cast<std::uint32_t>(seed),
                                           static_cast<std::uint32_t>(seed >> 32),
                                           static_cast<std::uint32_t>(stream)};
  boost::random::seed_seq sequence(words.begin(), words.end());
  return Random(sequence);
}

double uniform(Random& random, double from, double to) {
  return from + (to - from) * boost::random::uniform_01<double>()(random);
}

double normal(Random& random, double sigma) {
  return boost::random::normal_distribution<double>(0, sigma)(random);
}

int below(Random& random, int end) {
  return static_cast<int>(uniform(random, 0, end));
}

bool chance(Random& random, double probability) {
  return uniform(random, 0, 1) < probability;
}

}  // namespace sg::world
