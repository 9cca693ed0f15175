#include "tests/unit/common.h"

#include <algorithm>
#include <boost/random/uniform_01.hpp>
#include <boost/random/uniform_int_distribution.hpp>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <numeric>

#include "formats/formats.h"

namespace sg::test {

int draw(Random& random, int least, int most) {
  return boost::random::uniform_int_distribution<int>(least, most)(random);
}

double uniform(Random& random, double least, double limit) {
  return least + (limit - least) * boost::random::uniform_01<double>()(random);
}

graph::Order shuffled(Random& random, Index n) {
  graph::Order order(n);
  std::iota(order.begin(), order.end(), 0);
  shuffle(random, order);
  return order;
}

graph::Pattern make_pattern(std::vector<int> dim, const std::vector<std::vector<Index>>& rows) {
  graph::Pattern pattern{std::move(dim), {}};
  for (const auto& row : rows) pattern.rows.add(row);
  return pattern;
}

graph::Pattern odd_pattern(Random& random, Index n, int most_dim) {
  std::vector<int> dim(n);
  for (int& d : dim) d = draw(random, 1, most_dim);
  const bool wide = draw(random, 0, 3) == 0;
  const int most = draw(random, 1, 5);
  std::vector<std::vector<Index>> rows;
  for (int r = draw(random, 0, std::max<Index>(1, 2 * n)); r > 0; --r) {
    std::vector<Index> row = shuffled(random, n);
    row.resize(std::min<Index>(n, draw(random, 0, wide && draw(random, 0, 9) == 0 ? n : most)));
    rows.push_back(row);
    if (draw(random, 0, 4) == 0) rows.push_back(row);
  }
  return make_pattern(std::move(dim), rows);
}

Graph graph_of(const std::string& text) {
  return formats::read_graph_text(text::text_of(text), "test.g2o");
}

Graph test_graph(const std::string& name) {
  return formats::read_graph(SGTOOLS_TESTDATA "/" + name);
}

std::optional<std::string> public_graphs() {
  if (const char* folder = std::getenv("SGTOOLS_DATA")) return folder;
  WARN("skipped: SGTOOLS_DATA is not set");
  return std::nullopt;
}

}  // namespace sg::test
