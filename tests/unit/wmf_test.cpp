#include "lib/order/wmf.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdint>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "formats/formats.h"
#include "lib/order/fill_graph.h"
#include "lib/order/min_queue.h"
#include "lib/order/order.h"
#include "lib/order/quotient_graph.h"
#include "tests/unit/common.h"

using namespace sg::test;

namespace {

using sg::Index;
using sg::graph::Order;
using sg::graph::Pattern;
using Row = std::vector<Index>;

std::vector<int> odd_stages(Random& random, Index n) {
  std::vector<int> stage(n);
  for (int& s : stage) s = draw(random, 0, 2);
  return stage;
}

bool is_permutation_of(Order order, Index n) {
  std::sort(order.begin(), order.end());
  Order all(n);
  std::iota(all.begin(), all.end(), 0);
  return order == all;
}

// The elimination graph, literally: sets of neighbours, variable by variable.
struct Literal {
  std::vector<int> dim;
  std::vector<std::set<Index>> neighbours;

  explicit Literal(const Pattern& pattern) : dim(pattern.dim), neighbours(pattern.dim.size()) {
    for (Index r = 0; r < pattern.rows.size(); ++r) {
      for (Index a : pattern.rows[r]) {
        for (Index b : pattern.rows[r]) {
          if (a != b) neighbours[a].insert(b);
        }
      }
    }
  }
  void eliminate(Index v) {
    for (Index a : neighbours[v]) {
      neighbours[a].erase(v);
      for (Index b : neighbours[v]) {
        if (a != b) neighbours[a].insert(b);
      }
    }
  }
  // Neighbours of the set, without the set itself.
  std::set<Index> around(const std::set<Index>& set) const {
    std::set<Index> result;
    for (Index v : set) result.insert(neighbours[v].begin(), neighbours[v].end());
    for (Index v : set) result.erase(v);
    return result;
  }
  std::int64_t weight(const std::set<Index>& set) const {
    std::int64_t sum = 0;
    for (Index v : set) sum += dim[v];
    return sum;
  }
  std::int64_t fill(const std::set<Index>& clique) const {
    std::int64_t sum = 0;
    for (Index a : clique) {
      for (Index b : clique) {
        if (a < b && !neighbours[a].count(b)) sum += std::int64_t{dim[a]} * dim[b];
      }
    }
    return sum;
  }
};

std::set<Index> members(const sg::order::Supervariables& variables, Index v) {
  std::set<Index> result;
  for (Index m = v; m >= 0; m = variables.next[m]) result.insert(m);
  return result;
}

Index some_alive(const sg::order::Supervariables& variables, Random& random) {
  std::vector<Index> alive;
  for (Index v = 0; v < static_cast<Index>(variables.dim.size()); ++v) {
    if (variables.alive[v]) alive.push_back(v);
  }
  return alive.empty() ? -1 : alive[draw(random, 0, static_cast<int>(alive.size()) - 1)];
}

// Follows what was eliminated since `done`; returns the sum of the costs.
sg::elim::Wide follow(Literal& literal, const Order& order, std::size_t& done) {
  sg::elim::Wide cost = 0;
  for (; done < order.size(); ++done) {
    const Index v = order[done];
    const std::int64_t front = literal.dim[v] + literal.weight(literal.neighbours[v]);
    cost += sg::elim::elimination_cost(literal.dim[v], front);
    literal.eliminate(v);
  }
  return cost;
}

// However many they are: what took quadratic time would not end.
bool is_ordered(const Pattern& pattern) {
  return is_permutation_of(sg::order::wmf(pattern), pattern.variables());
}

Pattern star(Index n) {
  std::vector<Row> rows;
  for (Index j = 1; j < n; ++j) rows.push_back({0, j});
  return make_pattern(std::vector<int>(n, 3), rows);
}

Pattern path(Index n) {
  std::vector<Row> rows;
  for (Index j = 1; j < n; ++j) rows.push_back({j - 1, j});
  return make_pattern(std::vector<int>(n, 6), rows);
}

sg::elim::Wide ec(const Pattern& pattern, const Order& order) {
  return sg::elim::elimination_complexity(pattern, order);
}

}  // namespace

TEST_CASE("the fill graph knows every fill and degree exactly", "[wmf]") {
  Random random(1);
  for (int trial = 0; trial < 400; ++trial) {
    const Index n = draw(random, 0, 24);
    const Pattern pattern = odd_pattern(random, n);
    const std::vector<int> stage = trial % 2 == 0 ? std::vector<int>{} : odd_stages(random, n);
    Literal literal(pattern);
    std::size_t done = 0;
    sg::elim::Wide cost = 0;
    sg::order::FillGraph graph =
        sg::order::fill_graph(sg::graph::adjacency(pattern), pattern.dim, stage, 1'000'000);
    REQUIRE(graph.exact);
    for (Index v; (v = some_alive(graph.variables, random)) >= 0; sg::order::eliminate(graph, v)) {
      cost += follow(literal, graph.variables.order, done);
      for (Index u = 0; u < n; ++u) {
        if (!graph.variables.alive[u]) continue;
        const std::set<Index> around = literal.around(members(graph.variables, u));
        REQUIRE(graph.fill[u].fill == literal.fill(around));
        REQUIRE(graph.degree[u] == literal.weight(around));
      }
    }
    cost += follow(literal, graph.variables.order, done);
    REQUIRE(is_permutation_of(graph.variables.order, n));
    REQUIRE(graph.variables.ec == cost);
  }
}

TEST_CASE("the quotient graph's fronts are exact, its degrees and fills bounds", "[wmf]") {
  Random random(2);
  for (int trial = 0; trial < 400; ++trial) {
    const Index n = draw(random, 0, 24);
    const Pattern pattern = odd_pattern(random, n);
    const std::vector<int> stage = trial % 2 == 0 ? std::vector<int>{} : odd_stages(random, n);
    Literal literal(pattern);
    std::size_t done = 0;
    sg::elim::Wide cost = 0;
    sg::order::QuotientGraph graph = sg::order::quotient_graph(
        sg::order::fill_graph(sg::graph::adjacency(pattern), pattern.dim, stage, 0));
    for (Index v; (v = some_alive(graph.variables, random)) >= 0;) {
      sg::order::eliminate(graph, v);
      cost += follow(literal, graph.variables.order, done);
      std::set<Index> front;
      for (Index i : graph.members[v]) front.merge(members(graph.variables, i));
      REQUIRE(front == literal.neighbours[graph.variables.order.back()]);
      for (Index u = 0; u < n; ++u) {
        if (!graph.variables.alive[u]) continue;
        const std::set<Index> around = literal.around(members(graph.variables, u));
        REQUIRE(graph.fill[u] >= literal.fill(around));
        REQUIRE(graph.degree[u] >= literal.weight(around));
        for (Index e : graph.elements[u]) {
          if (graph.is_element[e]) REQUIRE_FALSE(graph.members[e].empty());
        }
      }
    }
    REQUIRE(is_permutation_of(graph.variables.order, n));
    REQUIRE(graph.variables.ec >= cost);
  }
}

TEST_CASE(
    "the work of an elimination is foretold: pairs to be joined, by one list entry each at least",
    "[wmf]") {
  const std::vector<Row> rows{{0, 1}, {0, 2}, {0, 3}, {0, 4}};
  const Pattern star_of_five = make_pattern({3, 6, 6, 6, 6}, rows);
  const sg::order::FillGraph graph = sg::order::fill_graph(
      sg::graph::adjacency(star_of_five), star_of_five.dim, {0, 1, 2, 3, 4}, 1 << 20);
  REQUIRE(graph.exact);
  CHECK(sg::order::least_work(graph, 0) == 6 * 4);  // 6 pairs, in lists of 4
  CHECK(sg::order::least_work(graph, 1) == 0);
}

TEST_CASE("better_first finds a cheaper pair that leaves the same graph", "[wmf]") {
  Random random(3);
  int found = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const Pattern pattern = odd_pattern(random, draw(random, 2, 13));
    const sg::order::FillGraph graph =
        sg::order::fill_graph(sg::graph::adjacency(pattern), pattern.dim, {}, 1'000'000);
    const Index v = some_alive(graph.variables, random);
    sg::order::FillGraph one = graph;
    const Index first = sg::order::better_first(one, v);
    if (first == v) continue;
    ++found;
    sg::order::FillGraph other = graph;
    sg::order::eliminate(one, first);
    Literal after(pattern), after_other(pattern);
    std::size_t done = 0, done_other = 0;
    if (one.variables.alive[v]) sg::order::eliminate(one, v);
    sg::order::eliminate(other, v);
    if (other.variables.alive[first]) sg::order::eliminate(other, first);
    if (one.variables.order.size() != other.variables.order.size()) continue;  // merged with more
    const sg::elim::Wide cost = follow(after, one.variables.order, done);
    CHECK(cost < follow(after_other, other.variables.order, done_other));
    const std::set<Index> gone(one.variables.order.begin(), one.variables.order.end());
    for (Index u = 0; u < pattern.variables(); ++u) {
      if (!gone.count(u)) CHECK(after.neighbours[u] == after_other.neighbours[u]);
    }
  }
  CHECK(found > 50);
}

TEST_CASE("greedy passes: a permutation by stages, with its own exact EC", "[wmf]") {
  Random random(4);
  for (int trial = 0; trial < 600; ++trial) {
    const Index n = draw(random, 0, 59);
    const Pattern pattern = odd_pattern(random, n);
    sg::order::GreedyOptions options;
    if (trial % 2 == 0) options.stage = odd_stages(random, n);
    if (trial % 3 == 0) options.score = sg::order::FillScore::plain;
    if (trial % 5 == 0) options.seed = static_cast<std::uint64_t>(trial);
    if (trial % 7 == 0) options.jitter = 0.5;
    options.exact_work = trial % 11;  // from bounds alone over a change in between to exact alone
    const sg::graph::Adjacency graph = sg::graph::adjacency(pattern);
    const sg::order::GreedyResult result = sg::order::greedy_fill(pattern, graph, options);
    REQUIRE(is_permutation_of(result.order, n));
    REQUIRE(result.ec == ec(pattern, result.order));
    REQUIRE(sg::order::greedy_fill(pattern, graph, options).order == result.order);
    for (Index k = 1; k < n && !options.stage.empty(); ++k) {
      REQUIRE(options.stage[result.order[k - 1]] <= options.stage[result.order[k]]);
    }
    if (n == 0) continue;
    options.limit = result.ec / 2;
    REQUIRE(sg::order::greedy_fill(pattern, graph, options).order.empty());
  }
}

TEST_CASE("ties go to the lowest index, or by seed", "[wmf]") {
  std::vector<Row> rows(100);
  for (Index j = 0; j < 100; ++j) rows[j] = {j, (j + 1) % 100};
  const Pattern cycle = make_pattern(std::vector<int>(100, 3), rows);
  CHECK(sg::order::wmf(cycle).front() == 0);
  CHECK(sg::order::wmf(cycle, {{}, 1}) == sg::order::wmf(cycle, {{}, 1}));
  CHECK(sg::order::wmf(cycle, {{}, 1}) != sg::order::wmf(cycle, {{}, 2}));
}

TEST_CASE("chordal graphs are eliminated without fill", "[wmf]") {
  Random random(5);
  for (int trial = 0; trial < 100; ++trial) {
    // Each variable joins a part of the clique of an earlier one: a random chordal graph.
    const Index n = draw(random, 1, 60);
    std::vector<Row> rows{{0}};
    for (Index j = 1; j < n; ++j) {
      Row row;
      for (Index i : rows[draw(random, 0, j - 1)]) {
        if (draw(random, 0, 3) != 0) row.push_back(i);
      }
      row.push_back(j);
      rows.push_back(row);
    }
    const Pattern pattern = make_pattern(std::vector<int>(n, 3), rows);
    const sg::elim::Score score =
        sg::elim::score(sg::elim::symbolic(pattern, sg::order::wmf(pattern)));
    CHECK(score.nnz == sg::elim::system_nnz(pattern));
  }
}

TEST_CASE("a queue gives its smallest key, ties by rank", "[wmf]") {
  Random random(6);
  sg::order::MinQueue queue(50);
  std::iota(queue.rank.rbegin(), queue.rank.rend(), 0);
  std::set<std::pair<double, std::pair<Index, Index>>> oracle;
  const auto entry = [&](Index v) { return std::pair(queue.key[v], std::pair(queue.rank[v], v)); };
  for (int step = 0; step < 20'000; ++step) {
    const Index v = draw(random, 0, 49);
    if (queue.holds(v)) oracle.erase(entry(v));
    if (draw(random, 0, 2) == 0) {
      sg::order::erase(queue, v);
    } else {
      sg::order::set_key(queue, v, draw(random, 0, 19));
      oracle.insert(entry(v));
    }
    REQUIRE(queue.empty() == oracle.empty());
    if (queue.empty() || draw(random, 0, 3) != 0) continue;
    REQUIRE(sg::order::pop(queue) == oracle.begin()->second.second);
    oracle.erase(oracle.begin());
  }
}

TEST_CASE("degenerate graphs are ordered, however large", "[wmf]") {
  CHECK(sg::order::wmf(make_pattern({}, {})).empty());
  CHECK(sg::order::wmf(make_pattern({6}, {{0}, {}})) == Order{0});

  CHECK(is_ordered(star(100'000)));
  const Order order = sg::order::wmf(star(1000));
  CHECK(std::find(order.begin(), order.end(), 0) - order.begin() >= 998);

  Row all(2000);
  std::iota(all.begin(), all.end(), 0);
  CHECK(is_ordered(make_pattern(std::vector<int>(2000, 3), {all})));

  CHECK(is_ordered(path(1'000'000)));
  CHECK(is_ordered(make_pattern(std::vector<int>(100'000, 3), {})));  // all disconnected

  // Two wheels, whose hubs see everybody; every landmark seen from every pose.
  std::vector<Row> rows;
  for (Index j = 2; j < 50'000; ++j) {
    rows.push_back({j % 2, j});
    if (j > 3) rows.push_back({j - 2, j});
  }
  CHECK(is_ordered(make_pattern(std::vector<int>(50'000, 3), rows)));
  rows.clear();
  for (Index pose = 0; pose < 400; ++pose) {
    for (Index landmark = 400; landmark < 900; ++landmark) rows.push_back({pose, landmark});
  }
  CHECK(is_ordered(make_pattern(std::vector<int>(900, 3), rows)));
}

TEST_CASE("wmf is not above the better of colamd and amd on public graphs", "[wmf][data]") {
  const auto folder = public_graphs();
  if (!folder) return;
  for (const char* file :
       {"CSAIL.g2o", "tinyGrid3D.g2o", "smallGrid3D.g2o", "intel.g2o", "kitti_00.g2o",
        "manhattan.g2o", "sphere2500.g2o", "torus3D.g2o", "city10000.g2o"}) {
    INFO(file);
    const Pattern pattern =
        sg::graph::graph_pattern(sg::formats::read_graph(*folder + "/" + file)).pattern;
    const sg::elim::Wide colamd = ec(pattern, sg::order::elimination_order("colamd", pattern));
    const sg::elim::Wide amd = ec(pattern, sg::order::elimination_order("amd", pattern));
    CHECK(100 * ec(pattern, sg::order::wmf(pattern)) <= 101 * std::min(colamd, amd));
  }
}
