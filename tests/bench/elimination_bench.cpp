// What planning, eliminating, iterating and updating cost, in COLAMD's order: ratios are of times measured in turns in the same run.
//   plan/GRAPH       plan_part: planning an elimination by one elimination
//   eliminate/GRAPH  flops: operations a second on the cliques of the tree; bytes_per_second: of the system and the factor,
//                    each once; by_cholmod: eliminations by CHOLMOD by ours
//   iterate/GRAPH    by_cholmod: Gauss-Newton iterations with CHOLMOD by those with ours, chi-square and linearization (the
//                    same in both) included; linearize_part: what these two take of ours
//   threads/GRAPH    speedup: eliminations on one thread by those on two
//   replay/sine      update_by_batch: iSAM2's updates by eliminations of all that is there, over a whole replay
#include <benchmark/benchmark.h>

#include <chrono>
#include <filesystem>

#include "formats/formats.h"
#include "lib/factor/initialize.h"
#include "lib/order/order.h"
#include "lib/solve/eliminate.h"
#include "lib/solve/isam2_replay.h"
#include "lib/solve/linear_solver.h"
#include "lib/solve/snapshot.h"
#include "lib/world/grid3d.h"
#include "lib/world/sine.h"
#include "tests/bench/operations.h"
#include "tests/bench/worlds.h"

using namespace sg;

namespace {

double seconds(const auto& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Graph world_graph(const auto& world, const std::string& name) {
  std::string bytes;
  world::Out out{[&](std::string_view piece) { bytes += piece; }};
  world::write_graph(world, world::Copy::noisy, out);
  world::flush(out);
  return formats::read_graph_text(text::text_of(std::move(bytes)), name);
}

// A graph linearized at its start, in COLAMD's order.
struct Case {
  Graph graph;
  factor::Problem problem;
  factor::LinearSystem system;
  graph::Order order;

  explicit Case(Graph given) : graph(std::move(given)), problem(factor::make_problem(graph)) {
    system = factor::linearized(problem, factor::start_values(problem));
    order = order::elimination_order("colamd", *system.pattern);
  }
};

void plan(benchmark::State& state, const Case& made) {
  double planning = 0, eliminating = 0;
  for (auto _ : state) {
    solve::Elimination elimination;
    planning += seconds([&] { elimination = solve::plan_elimination(made.system, made.order); });
    solve::eliminate(elimination, made.system);  // which has its memory from the system
    eliminating += seconds([&] { solve::eliminate(elimination, made.system); });
  }
  state.counters["plan_part"] = planning / eliminating;
}

// Of eliminating every clique of the Bayes tree; what relaxed fronts add to it is not counted.
double operations(const solve::CliqueTree& tree) {
  double sum = 0;
  for (Index c = 0; c < tree.cliques(); ++c)
    sum += bench::operations(tree.frontal_dim[c], tree.frontal_dim[c] + tree.separator_dim[c] + 1);
  return sum;
}

void eliminate(benchmark::State& state, const Case& made) {
  auto ours = solve::plan_elimination(made.system, made.order);
  const auto cholmod = solve::cholmod_solver(made.system, made.order, 1);
  solve::eliminate(ours, made.system);  // as in plan
  cholmod.eliminate(made.system, {});
  double alone = 0, others = 0;
  for (auto _ : state) {
    alone += seconds([&] { solve::eliminate(ours, made.system); });
    others += seconds([&] { cholmod.eliminate(made.system, {}); });
  }
  const auto eliminations = static_cast<double>(state.iterations());
  const double numbers = static_cast<double>(made.system.numbers.size()) +
                         static_cast<double>(ours.conditionals.size());
  const auto exact = solve::clique_tree(*made.system.pattern, made.order, solve::never);
  state.counters["flops"] = eliminations * operations(exact) / alone;
  state.counters["bytes_per_second"] = eliminations * numbers * sizeof(double) / alone;
  state.counters["by_cholmod"] = others / alone;
}

void iterate(benchmark::State& state, const Case& made) {
  const auto ours = solve::find_backend("tree").make(made.system, made.order, 1);
  const auto cholmod = solve::cholmod_solver(made.system, made.order, 1);
  const factor::Values values = factor::start_values(made.problem);
  factor::LinearSystem system = made.system;
  std::vector<double> step;
  double linearizing = 0, alone = 0, others = 0;
  const auto solved = [&](const solve::LinearSolver& solver) {
    return seconds([&] {
      solver.eliminate(system, {});
      solver.back_substitute(step);
    });
  };
  for (const auto* const each : {&ours, &cholmod}) solved(*each);
  for (auto _ : state) {
    linearizing += seconds([&] {
      factor::linearize(made.problem, values, {}, system);
      benchmark::DoNotOptimize(factor::chi2(made.problem, values));
    });
    alone += solved(ours);
    others += solved(cholmod);
  }
  state.counters["by_cholmod"] = (linearizing + others) / (linearizing + alone);
  state.counters["linearize_part"] = linearizing / (linearizing + alone);
}

void threads(benchmark::State& state, const Case& made) {
  auto one = solve::plan_elimination(made.system, made.order, 1);
  auto two = solve::plan_elimination(made.system, made.order, 2);
  for (auto* const each : {&one, &two}) solve::eliminate(*each, made.system);  // as in plan
  double alone = 0, both = 0;
  for (auto _ : state) {
    alone += seconds([&] { solve::eliminate(one, made.system); });
    both += seconds([&] { solve::eliminate(two, made.system); });
  }
  state.counters["speedup"] = alone / both;
}

void replay(benchmark::State& state) {
  const Graph graph = world_graph(world::sine({}), "sine");
  const factor::Problem problem = factor::make_problem(graph);
  double updating = 0, eliminating = 0;
  for (auto _ : state) {
    solve::Isam2Options options;
    options.relinearize_threshold = 0.05;
    auto isam2 = solve::make_isam2_replay(problem, options, 3, false);
    for (Index k = 0; k < isam2.steps.steps; ++k) {
      updating += seconds([&] { solve::replay_step(isam2, k); });
      solve::Snapshot snapshot;
      solve::take_snapshot(isam2.isam, true, snapshot);
      auto batch = solve::plan_elimination(snapshot.system,
                                           order::elimination_order("colamd", snapshot.pattern));
      eliminating += seconds([&] { solve::eliminate(batch, snapshot.system); });
    }
  }
  state.counters["update_by_batch"] = updating / eliminating;
}

void compare(const std::string& name, const std::function<Graph()>& make, bool large) {
  const auto add = [&](const std::string& row, void (*run)(benchmark::State&, const Case&)) {
    benchmark::RegisterBenchmark((row + "/" + name).c_str(),
                                 [make, run](benchmark::State& state) {
                                   const Case made(make());
                                   run(state, made);
                                 })
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
  };
  add("plan", plan);
  add("eliminate", eliminate);
  add("iterate", iterate);
  if (large) add("threads", threads);
}

const bool registered = [] {
  for (const auto& path :
       bench::public_graphs({"intel.g2o", "manhattan.g2o", "kitti_00.g2o", "sphere2500.g2o",
                             "victoriaPark.isam.txt", "city10000.g2o", "torus3D.g2o"})) {
    const std::string name = std::filesystem::path(path).stem().stem();  // .isam.txt
    compare(
        name, [path] { return formats::read_graph(path); }, name == "torus3D");
  }
  compare(
      "grid3d_8000", [] { return world_graph(world::grid3d({.poses = 8000}), "grid3d"); }, true);
  benchmark::RegisterBenchmark("replay/sine", replay)->Unit(benchmark::kMillisecond)->Iterations(1);
  return true;
}();

}  // namespace
