// The symbolic stage against CHOLMOD's, under the same order (COLAMD on the block graph).
//
// Ours goes from the block pattern of A and the order to elimination tree and weighted counts.
// CHOLMOD's (cholmod_analyze_p with the order given, simplicial, no postordering of its own) goes
// to the same from the expanded scalar pattern of A^T A, which is made for it beforehand and not
// timed.
#include <benchmark/benchmark.h>
#include <cholmod.h>

#include <filesystem>
#include <numeric>

#include "lib/elim/score.h"
#include "lib/order/order.h"
#include "tests/bench/worlds.h"

using namespace sg;

namespace {

struct Case {
  graph::Pattern pattern;
  graph::Order order;
};

Case make_case(const Graph& graph) {
  Case made{graph::graph_pattern(graph).pattern, {}};
  made.order = order::elimination_order("colamd", made.pattern);
  return made;
}

void ours(benchmark::State& state, const Case& made) {
  for (auto _ : state) benchmark::DoNotOptimize(elim::symbolic(made.pattern, made.order));
  state.counters["variables"] = made.pattern.variables();
}

// The upper triangle of the expanded A^T A, and the expanded order.
struct Scalar {
  std::vector<int> begin{0};
  std::vector<int> rows;
  std::vector<int> order;
};

Scalar expand(const Case& made) {
  const graph::Pattern& pattern = made.pattern;
  std::vector<int> first(pattern.variables() + 1, 0);
  std::partial_sum(pattern.dim.begin(), pattern.dim.end(), first.begin() + 1);
  const graph::Adjacency graph = graph::adjacency(pattern);
  Scalar scalar;
  for (Index j = 0; j < pattern.variables(); ++j) {
    for (int column = first[j]; column < first[j + 1]; ++column) {
      for (const Index i : graph[j]) {
        for (int row = first[i]; i < j && row < first[i + 1]; ++row) scalar.rows.push_back(row);
      }
      for (int row = first[j]; row <= column; ++row) scalar.rows.push_back(row);
      scalar.begin.push_back(static_cast<int>(scalar.rows.size()));
    }
  }
  for (const Index j : made.order) {
    for (int s = first[j]; s < first[j + 1]; ++s) scalar.order.push_back(s);
  }
  return scalar;
}

void cholmod(benchmark::State& state, const Case& made) {
  Scalar scalar = expand(made);
  cholmod_common common;
  cholmod_start(&common);
  common.nmethods = 1;
  common.method[0].ordering = CHOLMOD_GIVEN;
  common.postorder = 0;
  common.supernodal = CHOLMOD_SIMPLICIAL;
  cholmod_sparse matrix{};
  matrix.nrow = matrix.ncol = scalar.begin.size() - 1;
  matrix.nzmax = scalar.rows.size();
  matrix.p = scalar.begin.data();
  matrix.i = scalar.rows.data();
  matrix.stype = 1;
  matrix.itype = CHOLMOD_INT;
  matrix.xtype = CHOLMOD_PATTERN;
  matrix.sorted = matrix.packed = 1;
  for (auto _ : state) {
    cholmod_factor* factor = cholmod_analyze_p(&matrix, scalar.order.data(), nullptr, 0, &common);
    benchmark::DoNotOptimize(factor);
    cholmod_free_factor(&factor, &common);
  }
  state.counters["scalars"] = static_cast<double>(matrix.nrow);
  cholmod_finish(&common);
}

void compare(const std::string& name, const std::function<Case()>& make) {
  benchmark::RegisterBenchmark(("symbolic/" + name).c_str(), [make](benchmark::State& state) {
    ours(state, make());
  })->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark(("cholmod_analyze/" + name).c_str(), [make](
                                                                        benchmark::State& state) {
    cholmod(state, make());
  })->Unit(benchmark::kMillisecond);
}

const bool registered = [] {
  for (const auto& path : bench::public_graphs({"sphere2500.g2o", "city10000.g2o"})) {
    compare(std::filesystem::path(path).stem(),
            [path] { return make_case(formats::read_graph(path)); });
  }
  compare("manhattan/1000000", [] {
    static const Case made =
        make_case(formats::read_graph_text(bench::manhattan_text(1'000'000), "graph"));
    return made;
  });
  return true;
}();

}  // namespace

BENCHMARK_MAIN();
