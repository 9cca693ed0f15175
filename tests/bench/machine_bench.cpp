// What the machine can do on one core, which everything else is measured against.
//   machine/multiply_add   flops: sums of products in registers, by the widest instructions that there are
//   machine/dgemm          flops: OpenBLAS's product of two matrices
//   machine/read, machine/copy, machine/zero   bytes a second of memory that no cache holds, read or written
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

#include "tests/bench/openblas.h"

using namespace sg;

namespace {

// Each a vector of eight, and enough of them that none waits for itself.
using Vector [[gnu::vector_size(64)]] = double;
constexpr int chains = 12, rounds = 1000;

#ifdef __x86_64__
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void multiply_adds(Vector* sum, const Vector* factor) {
  Vector kept[chains];
  for (int k = 0; k < chains; ++k) kept[k] = sum[k];
  for (int i = 0; i < rounds; ++i) {
    for (int k = 0; k < chains; ++k) kept[k] = kept[k] * factor[0] + factor[1];
  }
  for (int k = 0; k < chains; ++k) sum[k] = kept[k];
}

void multiply_add(benchmark::State& state) {
  Vector sum[chains]{}, factor[2]{};
  for (auto _ : state) {
    multiply_adds(sum, factor);
    benchmark::DoNotOptimize(sum);
  }
  state.counters["flops"] =
      benchmark::Counter(2.0 * 8 * chains * rounds, benchmark::Counter::kIsIterationInvariantRate);
}

using Dgemm = void (*)(const char*, const char*, const int*, const int*, const int*, const double*,
                       const double*, const int*, const double*, const int*, const double*, double*,
                       const int*);

void dgemm(benchmark::State& state, Dgemm multiply) {
  const int n = 1500;
  const std::vector<double> a(std::size_t{n} * n, 0.5), b(std::size_t{n} * n, 0.25);
  std::vector<double> c(std::size_t{n} * n);
  const double one = 1, zero = 0;
  for (auto _ : state) {
    multiply("N", "N", &n, &n, &n, &one, a.data(), &n, b.data(), &n, &zero, c.data(), &n);
    benchmark::ClobberMemory();
  }
  state.counters["flops"] =
      benchmark::Counter(2.0 * n * n * n, benchmark::Counter::kIsIterationInvariantRate);
}

constexpr std::size_t beyond_caches = std::size_t{1} << 26;  // numbers, of 512 MB

void passes(benchmark::State& state, int arrays, const auto& pass) {
  std::vector<double> from(beyond_caches, 1.0), to(arrays > 1 ? beyond_caches : 0);
  for (auto _ : state) {
    pass(from, to);
    benchmark::ClobberMemory();
  }
  state.SetBytesProcessed(state.iterations() * arrays *
                          static_cast<std::int64_t>(beyond_caches * sizeof(double)));
}

// Four sums: one alone waits for every addition.
double sum_of(const std::vector<double>& numbers) {
  std::array<double, 4> sums{};
  for (std::size_t i = 0; i < numbers.size(); i += 4) {
    for (int k = 0; k < 4; ++k) sums[k] += numbers[i + k];
  }
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

const bool registered = [] {
  benchmark::RegisterBenchmark("machine/multiply_add", multiply_add);
  if (const auto multiply = bench::openblas<Dgemm>("dgemm_")) {
    benchmark::RegisterBenchmark("machine/dgemm", [multiply](benchmark::State& state) {
      dgemm(state, multiply);
    })->Unit(benchmark::kMillisecond);
  }
  const auto add = [](const char* name, int arrays, auto pass) {
    benchmark::RegisterBenchmark(name, [arrays, pass](benchmark::State& state) {
      passes(state, arrays, pass);
    })->Unit(benchmark::kMillisecond);
  };
  using Numbers = std::vector<double>;
  add("machine/read", 1, [](Numbers& from, Numbers&) { benchmark::DoNotOptimize(sum_of(from)); });
  add("machine/copy", 2, [](Numbers& from, Numbers& to) { std::ranges::copy(from, to.begin()); });
  add("machine/zero", 1, [](Numbers& from, Numbers&) { std::ranges::fill(from, 0.0); });
  return true;
}();

}  // namespace
