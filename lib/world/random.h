// Random numbers that are the same on every machine: Boost.Random's generator and distributions,
// which, unlike the standard library's, are specified by their code.
//
// A world draws from several independent streams of one seed. So the noise of a measurement can be
// drawn again when the measurement is written after the estimate that it entered, and a change of
// the noise moves no landmark.
#pragma once

#include <boost/random/mersenne_twister.hpp>
#include <cstdint>

namespace sg::world {

using Random = boost::random::mt19937_64;

enum class Stream : std::uint32_t {
  structure = 1,
  odometry,
  measurements,
  estimates,
  false_edges,
  false_measurements
};

Random random_stream(std::uint64_t seed, Stream stream);

double uniform(Random& random, double from, double to);  // in [from, to)
double normal(Random& random, double sigma);             // of mean 0
int below(Random& random, int end);                      // in 0 .. end-1
bool chance(Random& random, double probability);

}  // namespace sg::world
