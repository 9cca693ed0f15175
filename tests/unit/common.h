// What unit tests share: numbers drawn at random, patterns, graphs from text and from files. Each case seeds a generator
// of its own, so that it draws the same alone as among others.
#pragma once

#include <boost/random/mersenne_twister.hpp>
#include <optional>
#include <string>
#include <vector>

#include "formats/write.h"
#include "lib/graph/graph.h"
#include "lib/graph/pattern.h"
#include "lib/order/order.h"

namespace sg::test {

using Random = boost::random::mt19937;

int draw(Random& random, int least, int most);  // in [least, most]
// In [least, limit); least where both are equal.
double uniform(Random& random, double least, double limit);
graph::Order shuffled(Random& random, Index n);

template <class T>
void shuffle(Random& random, std::vector<T>& items) {
  for (std::size_t k = items.size(); k > 1; --k)
    std::swap(items[k - 1], items[draw(random, 0, static_cast<int>(k) - 1)]);
}

graph::Pattern make_pattern(std::vector<int> dim, const std::vector<std::vector<Index>>& rows);

// n variables of dimension 1 to `most_dim`, and all that a graph file can lead to: no rows, rows without variables (all
// of them fixed), unary rows, rows of many variables (in one pattern of four), the same row twice, parts that nothing
// connects.
graph::Pattern odd_pattern(Random& random, Index n, int most_dim = 6);

// What a writer writes.
struct StringSink final : formats::Sink {
  std::string text;
  void write(std::string_view bytes) override { text += bytes; }
};

Graph graph_of(const std::string& text);    // that calls itself test.g2o
Graph test_graph(const std::string& name);  // of testdata

// The folder of the public graphs. Where there is none, the case says so and ctest counts it as skipped.
std::optional<std::string> public_graphs();

}  // namespace sg::test
