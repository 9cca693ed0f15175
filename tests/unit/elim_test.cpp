// The fast symbolic elimination against the literal one, and both against CHOLMOD.
#include <cholmod.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <numeric>
#include <set>

#include "formats/formats.h"
#include "lib/elim/bayes_tree.h"
#include "lib/elim/counts.h"
#include "lib/elim/node_elimination.h"
#include "lib/elim/row_price.h"
#include "lib/elim/score.h"
#include "lib/order/order.h"
#include "tests/unit/common.h"

using namespace sg;
using namespace sg::test;

namespace {

std::vector<std::vector<Index>> rows_of(const graph::Pattern& pattern) {
  std::vector<std::vector<Index>> rows;
  for (Index r = 0; r < pattern.rows.size(); ++r)
    rows.emplace_back(pattern.rows[r].begin(), pattern.rows[r].end());
  return rows;
}

// Mostly small, and some larger.
graph::Pattern random_pattern(Random& random, int most_dim = 6) {
  return odd_pattern(random, draw(random, 0, draw(random, 0, 3) == 0 ? 80 : 9), most_dim);
}

// Every scalar a variable of its own.
graph::Pattern expand(const graph::Pattern& pattern, const graph::Order& order,
                      graph::Order& scalar_order) {
  std::vector<Index> first(pattern.variables() + 1, 0);
  std::partial_sum(pattern.dim.begin(), pattern.dim.end(), first.begin() + 1);
  std::vector<std::vector<Index>> rows;
  for (Index r = 0; r < pattern.rows.size() + pattern.variables(); ++r) {
    auto& row = rows.emplace_back();
    const auto add = [&](Index j) {
      for (Index s = first[j]; s < first[j + 1]; ++s) row.push_back(s);
    };
    if (r < pattern.rows.size()) {
      for (Index j : pattern.rows[r]) add(j);
    } else {
      add(r - pattern.rows.size());  // a variable is dense in itself
    }
  }
  scalar_order.clear();
  for (Index j : order) {
    for (Index s = first[j]; s < first[j + 1]; ++s) scalar_order.push_back(s);
  }
  return make_pattern(std::vector<int>(first.back(), 1), rows);
}

// Node elimination with nothing but sets.
std::vector<elim::EliminationStep> set_elimination(const graph::Pattern& pattern,
                                                   const graph::Order& order) {
  std::vector<std::set<Index>> adjacent(pattern.variables());
  for (Index r = 0; r < pattern.rows.size(); ++r) {
    for (Index i : pattern.rows[r]) {
      for (Index j : pattern.rows[r]) {
        if (i != j) adjacent[i].insert(j);
      }
    }
  }
  std::vector<Index> position(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) position[order[k]] = static_cast<Index>(k);
  const auto before = [&](Index a, Index b) { return position[a] < position[b]; };
  std::vector<elim::EliminationStep> steps;
  for (Index v : order) {
    elim::EliminationStep step{v, {adjacent[v].begin(), adjacent[v].end()}, {}};
    std::sort(step.neighbours.begin(), step.neighbours.end(), before);
    for (Index i : step.neighbours) {
      adjacent[i].erase(v);
      for (Index j : step.neighbours) {
        if (before(i, j) && adjacent[i].insert(j).second) step.fill.emplace_back(i, j);
        if (before(j, i)) adjacent[i].insert(j);
      }
    }
    steps.push_back(step);
  }
  return steps;
}

std::int64_t dim_of(const graph::Pattern& pattern, const auto& variables) {
  std::int64_t sum = 0;
  for (Index j : variables) sum += pattern.dim[j];
  return sum;
}

// The Bayes tree as Kaess et al. write it down (algorithm 2): conditionals in reverse order, each
// compared with all variables of its parent's clique.
struct Clique {
  std::vector<Index> frontal, separator, all;  // `all` ascending
};
std::vector<Clique> literal_bayes_tree(const std::vector<elim::EliminationStep>& steps) {
  std::vector<Clique> cliques;
  std::vector<std::size_t> clique_of(steps.size());  // whose frontal variable it is
  for (auto step = steps.rbegin(); step != steps.rend(); ++step) {
    std::vector<Index> separator = step->neighbours;
    std::sort(separator.begin(), separator.end());
    std::vector<Index> all = separator;
    all.insert(std::upper_bound(all.begin(), all.end(), step->variable), step->variable);
    // The parent's clique is that of the neighbour eliminated first.
    if (!separator.empty() && cliques[clique_of[step->neighbours.front()]].all == separator) {
      clique_of[step->variable] = clique_of[step->neighbours.front()];
      Clique& clique = cliques[clique_of[step->variable]];
      clique.frontal.push_back(step->variable);
      clique.all = std::move(all);
    } else {
      clique_of[step->variable] = cliques.size();
      cliques.push_back({{step->variable}, std::move(separator), std::move(all)});
    }
  }
  return cliques;
}

Index literal_height(const std::vector<elim::EliminationStep>& steps) {
  std::vector<Index> depth(steps.size(), 1);
  Index height = 0;
  for (auto step = steps.rbegin(); step != steps.rend(); ++step) {
    if (!step->neighbours.empty()) depth[step->variable] = depth[step->neighbours.front()] + 1;
    height = std::max(height, depth[step->variable]);
  }
  return height;
}

struct LiteralScore : elim::Score {
  elim::Wide fill = 0;
};

LiteralScore literal_score(const graph::Pattern& pattern,
                           const std::vector<elim::EliminationStep>& steps) {
  LiteralScore score;
  for (const auto& step : steps) {
    const std::int64_t own = pattern.dim[step.variable];
    const std::int64_t all = own + dim_of(pattern, step.neighbours);
    score.ec += static_cast<elim::Wide>(own * all * all);
    score.max_clique = std::max(score.max_clique, all);
    for (const auto& [i, j] : step.fill)
      score.fill +=
          static_cast<elim::Wide>(pattern.dim[i]) * static_cast<elim::Wide>(pattern.dim[j]);
    for (std::int64_t degree = all - 1; degree >= all - own; --degree) {  // its scalars, in turn
      score.nnz += static_cast<elim::Wide>(degree + 1);
      score.flops += static_cast<elim::Wide>((degree + 1) * (degree + 1));
      score.rose += static_cast<elim::Wide>(degree * (degree + 3) / 2);
    }
  }
  for (const auto& clique : literal_bayes_tree(steps)) {
    const std::int64_t own = dim_of(pattern, clique.frontal);
    const std::int64_t all = own + dim_of(pattern, clique.separator);
    score.ec_bt += static_cast<elim::Wide>(own * all * all);
    ++score.cliques;
  }
  score.height = literal_height(steps);
  return score;
}

void require_equal(const elim::Score& fast, const elim::Score& literal) {
  REQUIRE(elim::to_string(fast.ec) == elim::to_string(literal.ec));
  REQUIRE(elim::to_string(fast.nnz) == elim::to_string(literal.nnz));
  REQUIRE(elim::to_string(fast.ec_bt) == elim::to_string(literal.ec_bt));
  REQUIRE(elim::to_string(fast.rose) == elim::to_string(literal.rose));
  REQUIRE(elim::to_string(fast.flops) == elim::to_string(literal.flops));
  REQUIRE(fast.max_clique == literal.max_clique);
  REQUIRE(fast.height == literal.height);
  REQUIRE(fast.cliques == literal.cliques);
}

void require_as_literal(const graph::Pattern& pattern, const graph::Order& order) {
  const LiteralScore literal = literal_score(pattern, elim::node_elimination(pattern, order));
  const elim::Score fast = elim::score(elim::symbolic(pattern, order));
  require_equal(fast, literal);
  REQUIRE(elim::to_string(fast.nnz - elim::system_nnz(pattern)) == elim::to_string(literal.fill));
  REQUIRE(elim::elimination_complexity(pattern, order) == fast.ec);
}

// CHOLMOD's count for the expanded scalar pattern: {nonzeros of L, flops}.
std::pair<double, double> cholmod_counts(const graph::Pattern& pattern, const graph::Order& order) {
  graph::Order scalar_order;
  const graph::Pattern scalar = expand(pattern, order, scalar_order);
  const graph::Adjacency graph = graph::adjacency(scalar);
  cholmod_common common;
  cholmod_start(&common);
  common.nmethods = 1;
  common.method[0].ordering = CHOLMOD_GIVEN;
  common.postorder = 0;
  common.supernodal = CHOLMOD_SIMPLICIAL;
  std::vector<int> begin{0};
  std::vector<int> rows;
  for (Index j = 0; j < scalar.variables(); ++j) {
    for (Index i : graph[j]) {
      if (i < j) rows.push_back(i);
    }
    rows.push_back(j);
    begin.push_back(static_cast<int>(rows.size()));
  }
  const auto n = static_cast<std::size_t>(scalar.variables());
  cholmod_sparse matrix{};
  matrix.nrow = matrix.ncol = n;
  matrix.nzmax = rows.size();
  matrix.p = begin.data();
  matrix.i = rows.data();
  matrix.stype = 1;
  matrix.itype = CHOLMOD_INT;
  matrix.xtype = CHOLMOD_PATTERN;
  matrix.sorted = matrix.packed = 1;
  cholmod_factor* factor = cholmod_analyze_p(&matrix, scalar_order.data(), nullptr, 0, &common);
  REQUIRE(common.status == CHOLMOD_OK);
  const std::pair counts{common.lnz, common.fl};
  cholmod_free_factor(&factor, &common);
  cholmod_finish(&common);
  return counts;
}

void require_as_cholmod(const graph::Pattern& pattern, const graph::Order& order) {
  const elim::Score fast = elim::score(elim::symbolic(pattern, order));
  const auto [nnz, flops] = cholmod_counts(pattern, order);
  REQUIRE(elim::to_double(fast.nnz) == nnz);
  REQUIRE(elim::to_double(fast.flops) == flops);
}

// The files of the public graphs, by ascending size.
std::vector<std::string> by_size(const std::string& folder) {
  std::vector<std::pair<std::uintmax_t, std::string>> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    files.emplace_back(entry.file_size(), entry.path());
  std::sort(files.begin(), files.end());
  std::vector<std::string> paths;
  for (auto& [size, path] : files) paths.push_back(std::move(path));
  return paths;
}

}  // namespace

TEST_CASE("node elimination of the paper's Figure 1", "[elim]") {
  // 0 - 1, 0 - 2, 1 - 3, 2 - 4, 3 - 4: eliminating 0 joins 1 and 2, then 1 joins 2 and 3.
  const graph::Pattern pattern =
      make_pattern({1, 1, 1, 1, 1}, {{0, 1}, {0, 2}, {1, 3}, {2, 4}, {3, 4}});
  const auto steps = elim::node_elimination(pattern, {0, 1, 2, 3, 4});
  using Pairs = std::vector<std::pair<Index, Index>>;
  REQUIRE(steps.size() == 5);
  CHECK(steps[0].neighbours == std::vector<Index>{1, 2});
  CHECK(steps[0].fill == Pairs{{1, 2}});
  CHECK(steps[1].neighbours == std::vector<Index>{2, 3});
  CHECK(steps[1].fill == Pairs{{2, 3}});
  CHECK(steps[2].neighbours == std::vector<Index>{3, 4});
  CHECK(steps[2].fill.empty());
  CHECK(steps[3].neighbours == std::vector<Index>{4});
  CHECK(steps[4].neighbours.empty());
  // 3^2 three times, 2^2, 1; the cliques are {2, 3, 4}, {1 | 2, 3} and {0 | 1, 2}.
  const elim::Score counted = elim::score(elim::symbolic(pattern, {0, 1, 2, 3, 4}));
  CHECK(elim::to_string(counted.ec) == "32");
  CHECK(counted.cliques == 3);
  CHECK(elim::to_string(counted.ec_bt) == "45");
}

TEST_CASE("an order that is no permutation is refused", "[elim]") {
  const graph::Pattern pattern = make_pattern({1, 1}, {{0, 1}});
  CHECK_THROWS_AS(elim::symbolic(pattern, {0}), std::invalid_argument);
  CHECK_THROWS_AS(elim::symbolic(pattern, {0, 0}), std::invalid_argument);
  CHECK_THROWS_AS(elim::symbolic(pattern, {0, 2}), std::invalid_argument);
  CHECK_THROWS_AS(elim::symbolic(pattern, {-1, 0}), std::invalid_argument);
}

TEST_CASE("node elimination is that of sets of neighbours", "[elim]") {
  Random random(1);
  for (int trial = 0; trial < 2000; ++trial) {
    const graph::Pattern pattern = random_pattern(random);
    const graph::Order order = shuffled(random, pattern.variables());
    const auto steps = elim::node_elimination(pattern, order);
    const auto by_sets = set_elimination(pattern, order);
    REQUIRE(steps.size() == by_sets.size());
    for (std::size_t k = 0; k < steps.size(); ++k) {
      REQUIRE(steps[k].variable == by_sets[k].variable);
      REQUIRE(steps[k].neighbours == by_sets[k].neighbours);
      REQUIRE(steps[k].fill == by_sets[k].fill);
    }
  }
}

TEST_CASE("scores equal literal node elimination on odd random graphs", "[elim]") {
  Random random(2);
  for (int trial = 0; trial < 5000; ++trial) {
    const graph::Pattern pattern = random_pattern(random);
    require_as_literal(pattern, shuffled(random, pattern.variables()));
  }
}

TEST_CASE("scores equal literal elimination of the expanded scalar graph", "[elim]") {
  Random random(3);
  for (int trial = 0; trial < 500; ++trial) {
    const graph::Pattern pattern = random_pattern(random);
    const graph::Order order = shuffled(random, pattern.variables());
    graph::Order scalar_order;
    const graph::Pattern scalar = expand(pattern, order, scalar_order);
    const LiteralScore literal =
        literal_score(scalar, elim::node_elimination(scalar, scalar_order));
    const elim::Score fast = elim::score(elim::symbolic(pattern, order));
    REQUIRE(fast.nnz == literal.nnz);
    REQUIRE(fast.rose == literal.rose);
    REQUIRE(fast.flops == literal.flops);
    REQUIRE(fast.nnz - elim::system_nnz(pattern) == literal.fill);
    REQUIRE(fast.max_clique == literal.max_clique);
  }
}

TEST_CASE("nnz and flops are CHOLMOD's", "[elim]") {
  Random random(4);
  for (int trial = 0; trial < 500; ++trial) {
    const graph::Pattern pattern = random_pattern(random);
    if (pattern.variables() > 0) require_as_cholmod(pattern, shuffled(random, pattern.variables()));
  }
}

TEST_CASE("adding an edge never lowers EC (Lemma 1)", "[elim]") {
  Random random(5);
  for (int trial = 0; trial < 2000; ++trial) {
    const graph::Pattern pattern = random_pattern(random);
    const graph::Order order = shuffled(random, pattern.variables());
    auto rows = rows_of(pattern);
    std::vector<Index> added = shuffled(random, pattern.variables());
    added.resize(std::min<Index>(pattern.variables(), draw(random, 1, 4)));
    rows.insert(rows.begin() + draw(random, 0, static_cast<int>(rows.size())), added);
    const graph::Pattern larger = make_pattern(pattern.dim, rows);
    REQUIRE(elim::elimination_complexity(pattern, order) <=
            elim::elimination_complexity(larger, order));
  }
}

TEST_CASE("with scalar variables EC is the asymptotic Rose sum", "[elim]") {
  Random random(6);
  // Rose: 1/2 sum d (d + 3) ~ 1/2 sum d^2; the paper drops the half. EC counts the column's own
  // entry too: sum (d + 1)^2 = 2 Rose - sum d + n, and sum d = nnz - n.
  for (int trial = 0; trial < 1000; ++trial) {
    const graph::Pattern pattern = random_pattern(random, 1);
    const graph::Order order = shuffled(random, pattern.variables());
    const elim::Score counted = elim::score(elim::symbolic(pattern, order));
    elim::Wide squares = 0;
    for (const auto& step : elim::node_elimination(pattern, order)) {
      const elim::Wide entries = step.neighbours.size() + 1;
      squares += entries * entries;
    }
    REQUIRE(counted.ec == squares);
    REQUIRE(counted.ec == counted.flops);
    REQUIRE(counted.ec + counted.nnz ==
            2 * counted.rose + 2 * static_cast<elim::Wide>(pattern.variables()));
  }
}

TEST_CASE("the Bayes tree costs no less than node by node", "[elim]") {
  Random random(7);
  for (int trial = 0; trial < 2000; ++trial) {
    const graph::Pattern pattern = random_pattern(random);
    const elim::Score counted =
        elim::score(elim::symbolic(pattern, shuffled(random, pattern.variables())));
    REQUIRE(counted.ec_bt >= counted.ec);
  }
}

TEST_CASE("the Bayes tree is a tree over all variables, parents first", "[elim]") {
  Random random(8);
  for (int trial = 0; trial < 500; ++trial) {
    const graph::Pattern pattern = random_pattern(random);
    const elim::Symbolic elimination =
        elim::symbolic(pattern, shuffled(random, pattern.variables()));
    const elim::BayesTree tree = elim::bayes_tree(elimination);
    std::vector<std::int64_t> frontal(tree.cliques(), 0);
    for (Index k = 0; k < pattern.variables(); ++k) {
      frontal[tree.clique[k]] += elimination.dim[k];
      const Index parent = elimination.parent[k];
      const bool inside = parent >= 0 && tree.clique[parent] == tree.clique[k];
      REQUIRE((inside || tree.top[tree.clique[k]] == k));
    }
    REQUIRE(frontal == tree.frontal_dim);
    for (Index c = 0; c < tree.cliques(); ++c) REQUIRE(tree.parent[c] < c);
  }
}

TEST_CASE("postorder and height are those of the tree", "[elim]") {
  Random random(9);
  for (int trial = 0; trial < 500; ++trial) {
    const graph::Pattern pattern = random_pattern(random);
    const elim::Symbolic elimination =
        elim::symbolic(pattern, shuffled(random, pattern.variables()));
    const std::vector<Index> post = elim::postorder(elimination.parent);
    std::vector<Index> rank(post.size(), -1);
    for (std::size_t k = 0; k < post.size(); ++k) rank[post[k]] = static_cast<Index>(k);
    std::vector<Index> size(post.size(), 1);  // of every subtree: it ends with its root
    for (Index k = 0; k < pattern.variables(); ++k) {
      REQUIRE(rank[k] >= 0);
      const Index parent = elimination.parent[k];
      if (parent < 0) continue;
      REQUIRE(parent > k);
      size[parent] += size[k];
    }
    for (Index k = 0; k < pattern.variables(); ++k) {
      const Index parent = elimination.parent[k];
      if (parent < 0) continue;
      REQUIRE(rank[k] < rank[parent]);
      REQUIRE(rank[k] - size[k] >= rank[parent] - size[parent]);
    }
  }
}

TEST_CASE("wide numbers print in full", "[elim]") {
  CHECK(elim::to_string(elim::Wide{0}) == "0");
  CHECK(elim::to_string(elim::Wide{1000000007}) == "1000000007");
  CHECK(elim::to_string(~elim::Wide{0}) == "340282366920938463463374607431768211455");
  CHECK(elim::to_string(elim::elimination_cost(3, 3'000'000'000)) == "27000000000000000000");
}

TEST_CASE("public graphs: scores equal literal node elimination under every ordering",
          "[elim][public]") {
  const auto folder = public_graphs();
  if (!folder) return;
  for (const auto& file : by_size(*folder)) {
    const Graph graph = formats::read_graph(file);
    const graph::GraphPattern variables = graph::graph_pattern(graph);
    const order::OrderOptions options = order::order_options(graph, variables);
    std::set<graph::Order> done;  // several methods may give one order
    for (const order::Ordering& ordering : order::orderings()) {
      CAPTURE(file, ordering.name);
      const graph::Order order = order::elimination_order(ordering, variables.pattern, options);
      if (done.insert(order).second) require_as_literal(variables.pattern, order);
    }
  }
}

TEST_CASE("public graphs: nnz and flops are CHOLMOD's under COLAMD", "[elim][public]") {
  const auto folder = public_graphs();
  if (!folder) return;
  for (const auto& file : by_size(*folder)) {
    CAPTURE(file);
    const graph::GraphPattern variables = graph::graph_pattern(formats::read_graph(file));
    require_as_cholmod(variables.pattern, order::elimination_order("colamd", variables.pattern));
  }
}

TEST_CASE("a row's price is what EC loses without it", "[elim]") {
  int free = 0, dear = 0;
  for (int trial = 0; trial < 400; ++trial) {
    Random random(trial);
    const graph::Pattern pattern = random_pattern(random);
    const graph::Order order = shuffled(random, pattern.variables());
    const elim::Wide ec = elim::elimination_complexity(pattern, order);
    const std::vector<elim::Wide> prices = elim::row_prices(pattern, order);
    REQUIRE(prices.size() == static_cast<std::size_t>(pattern.rows.size()));
    int wrong = 0;
    for (Index r = 0; r < pattern.rows.size(); ++r) {
      auto rows = rows_of(pattern);
      rows.erase(rows.begin() + r);
      const graph::Pattern without = make_pattern(pattern.dim, rows);
      wrong += prices[r] != ec - elim::elimination_complexity(without, order);
      ++(prices[r] == 0 ? free : dear);
    }
    INFO("trial " << trial);
    CHECK(wrong == 0);
  }
  CHECK(free > 100);
  CHECK(dear > 100);
}
