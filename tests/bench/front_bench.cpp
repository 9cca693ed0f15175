// Dense partial Cholesky against OpenBLAS, on one thread: a front of f frontal and s separator scalars by our kernels,
// and the same numbers of operations a second by its dpotrf on a matrix of as many rows. `flops` of the two is the ratio.
#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "lib/solve/factorize.h"
#include "tests/bench/openblas.h"
#include "tests/bench/operations.h"

using namespace sg;

namespace {

using Dpotrf = void (*)(const char*, const int*, double*, const int*, int*);

// Positive definite, its lower triangle by column of any leading dimension.
double entry(int i, int j, int n) {
  return i == j ? n : 1.0 / (1 + i + j);
}

void front(benchmark::State& state) {
  const solve::Kernels& kernel = solve::kernels();
  solve::Front front{nullptr, nullptr, static_cast<int>(state.range(0)), 0};
  front.n = front.f + static_cast<int>(state.range(1)) + 1;
  std::vector<double> l(front.size_l() + solve::lane), u(front.size_u() + solve::lane);
  std::vector<double> floor(front.f, 0.0);
  std::vector<double> work(solve::factorization_work(kernel, front.f, front.n));
  front.l = l.data();
  front.u = u.data();
  for (auto _ : state) {
    state.PauseTiming();
    for (int j = 0; j < front.n; ++j) {
      double* const column = j < front.f
                                 ? front.l + std::int64_t{j} * front.ld_l()
                                 : front.u + std::int64_t{j - front.f} * front.ld_u() - front.f;
      for (int i = j; i < front.n; ++i) column[i] = entry(i, j, front.n);
    }
    state.ResumeTiming();
    benchmark::DoNotOptimize(solve::factorize(kernel, front, floor.data(), work.data(), 1));
  }
  state.counters["flops"] = benchmark::Counter(bench::operations(front.f, front.n),
                                               benchmark::Counter::kIsIterationInvariantRate);
}

void dpotrf(benchmark::State& state, Dpotrf factorize) {
  const int n = static_cast<int>(state.range(0) + state.range(1)) + 1;
  std::vector<double> matrix(static_cast<std::size_t>(n) * n);
  for (auto _ : state) {
    state.PauseTiming();
    for (int j = 0; j < n; ++j) {
      for (int i = j; i < n; ++i) matrix[static_cast<std::size_t>(j) * n + i] = entry(i, j, n);
    }
    state.ResumeTiming();
    int info = 0;
    factorize("L", &n, matrix.data(), &n, &info);
  }
  state.counters["flops"] =
      benchmark::Counter(bench::operations(n, n), benchmark::Counter::kIsIterationInvariantRate);
}

const bool registered = [] {
  const auto openblas = bench::openblas<Dpotrf>("dpotrf_");
  for (const auto& [f, s] : {std::pair{100, 500}, {300, 600}, {600, 1500}, {1500, 0}}) {
    const std::string name = std::to_string(f) + "+" + std::to_string(s);
    benchmark::RegisterBenchmark(("front/" + name).c_str(), front)->Args({f, s});
    if (!openblas) continue;
    benchmark::RegisterBenchmark(("dpotrf/" + name).c_str(), [openblas](benchmark::State& state) {
      dpotrf(state, openblas);
    })->Args({f, s});
  }
  return true;
}();

}  // namespace
