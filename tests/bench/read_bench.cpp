// Reading: bytes of a g2o file already in memory, to a Graph.
#include <benchmark/benchmark.h>

#include <filesystem>

#include "tests/bench/worlds.h"

using namespace sg;

namespace {

void read(benchmark::State& state, const text::Text& text) {
  for (auto _ : state) benchmark::DoNotOptimize(formats::read_graph_text(text, "graph"));
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(text.view.size()));
}

const bool registered = [] {
  for (const auto& path : bench::public_graphs({"sphere2500.g2o", "city10000.g2o"})) {
    benchmark::RegisterBenchmark(
        ("read/" + std::filesystem::path(path).stem().string()).c_str(),
        [path](benchmark::State& state) { read(state, text::read_text(path)); })
        ->Unit(benchmark::kMillisecond);
  }
  benchmark::RegisterBenchmark("read/manhattan",
                               [](benchmark::State& state) {
                                 read(state,
                                      bench::manhattan_text(static_cast<Index>(state.range())));
                               })
      ->Arg(1'000'000)
      ->Unit(benchmark::kMillisecond);
  return true;
}();

}  // namespace
