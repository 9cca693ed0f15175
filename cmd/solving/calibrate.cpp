#include "cmd/solving/calibrate.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <utility>

#include "cmd/common/processor.h"
#include "cmd/common/stage.h"
#include "cmd/solving/timing.h"
#include "formats/formats.h"
#include "lib/factor/initialize.h"
#include "lib/order/order.h"
#include "lib/world/city.h"
#include "lib/world/grid3d.h"
#include "lib/world/manhattan.h"
#include "lib/world/sine.h"
#include "lib/world/sphere.h"
#include "lib/world/torus.h"
#include "lib/world/worst.h"

namespace sg::solving {
namespace {

constexpr double most_ec = 5e9;        // of an elimination that is timed
constexpr double seconds_each = 0.03;  // that one is timed for
constexpr std::size_t runs_each = 3;   // at least

template <class World>
Graph graph_of(const World& world) {
  std::string text;
  world::Out out{[&](std::string_view piece) { text += piece; }};
  world::write_graph(world, world::Copy::noisy, out);
  world::flush(out);
  return formats::read_graph_text(text::text_of(std::move(text)), "<generated>");
}

template <class World, class Make>
void add(std::vector<std::function<Graph()>>& worlds, Make make,
         std::initializer_list<Index> sizes) {
  for (const Index poses : sizes) {
    worlds.emplace_back([make, poses] {
      World world;
      world.poses = poses;
      return graph_of(make(world));
    });
  }
}

std::vector<std::function<Graph()>> worlds() {
  std::vector<std::function<Graph()>> all;
  add<world::Sine>(all, world::sine, {100, 400});
  add<world::City>(all, world::city, {500, 3500});
  add<world::Manhattan>(all, world::manhattan, {500, 3500, 20000});
  add<world::Sphere>(all, world::sphere, {400, 2500});
  add<world::Torus>(all, world::torus, {1000, 5000});
  add<world::Grid3d>(all, world::grid3d, {200, 1000, 3000});
  add<world::Worst>(all, world::worst, {20, 60});
  return all;
}

// The median of several, as --time has it.
double time_of(solve::Elimination& elimination, const factor::LinearSystem& system) {
  std::vector<double> times;
  for (double sum = 0; times.size() < runs_each || sum < seconds_each; sum += times.back()) {
    const double begin = cmd::thread_seconds();
    solve::eliminate(elimination, system);
    times.push_back(cmd::thread_seconds() - begin);
  }
  return median(std::move(times));
}

void add_samples(const Graph& graph, std::vector<solve::Sample>& samples) {
  const factor::Problem problem = factor::make_problem(graph);
  const factor::LinearSystem system = factor::linearized(problem, factor::initial_values(problem));
  const graph::GraphPattern variables = graph::graph_pattern(graph);
  const order::OrderOptions options = order::order_options(graph, variables);
  for (const std::string_view method : {"colamd", "amd", "metis", "wmf", "rcm", "id"}) {
    const graph::Order order = order::elimination_order(method, variables.pattern, options);
    const elim::Wide ec = elim::elimination_complexity(variables.pattern, order);
    if (elim::to_double(ec) > most_ec) continue;
    solve::Elimination elimination = solve::plan_elimination(system, order);
    samples.push_back(
        {solve::forecast(problem.variables.pattern, order).work, time_of(elimination, system)});
  }
}

}  // namespace

std::vector<solve::Sample> timed_samples() {
  std::vector<solve::Sample> samples;
  const auto all = worlds();
  cmd::stage("calibrate", static_cast<std::int64_t>(all.size()));
  for (std::size_t k = 0; k < all.size(); ++k) {
    cmd::progress(static_cast<std::int64_t>(k));
    add_samples(all[k](), samples);
  }
  return samples;
}

Fit fit_of(std::span<const solve::Sample> samples, const solve::Times& times) {
  double mean = 0;
  for (const solve::Sample& sample : samples)
    mean += std::log(sample.seconds) / static_cast<double>(samples.size());
  Fit fit{0, 1};
  double residual = 0, total = 0;
  for (const solve::Sample& sample : samples) {
    const double off = std::log(solve::seconds(sample.work, times) / sample.seconds);
    const double away = std::log(sample.seconds) - mean;
    residual += off * off;
    total += away * away;
    fit.worst = std::max(fit.worst, std::exp(std::abs(off)));
  }
  fit.r2 = 1 - residual / total;
  return fit;
}

}  // namespace sg::solving
