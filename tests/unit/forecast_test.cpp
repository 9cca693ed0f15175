// What an elimination will take, foretold, against what the solver allocates and does.
#include "lib/solve/forecast.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <stdexcept>

#include "formats/formats.h"
#include "lib/factor/initialize.h"
#include "lib/order/order.h"
#include "tests/unit/common.h"

using namespace sg::test;

namespace {

using sg::Index;
using sg::graph::Order;
using sg::graph::Pattern;

// A system of this structure; what its numbers are is all the same.
sg::factor::LinearSystem system_of(const Pattern& pattern, Random& random) {
  sg::factor::LinearSystem system;
  system.pattern = &pattern;
  system.begin.push_back(0);
  for (Index r = 0; r < pattern.rows.size(); ++r) {
    int width = 1;
    for (const Index j : pattern.rows[r]) width += pattern.dim[j];
    system.height.push_back(draw(random, 1, 6));
    system.begin.push_back(system.begin.back() + std::int64_t{width} * system.height.back());
  }
  system.numbers.assign(system.begin.back(), 1);
  return system;
}

void check_bytes(const sg::factor::LinearSystem& system, const Order& order) {
  const sg::solve::Elimination plan = sg::solve::plan_elimination(system, order);
  const sg::solve::Forecast told = sg::solve::forecast(*system.pattern, order);
  CHECK(told.factor_bytes == sg::solve::factor_bytes(plan));
  CHECK(told.peak_bytes == sg::solve::peak_bytes(plan));
}

// The most that waits at a time, by hand: numbers of updates on the stack of even and of odd depth.
sg::Offset most_waiting(sg::solve::Elimination& e) {
  std::array<sg::Offset, 2> now{0, 0}, most{0, 0};
  for (Index c = 0; c < e.tree.cliques(); ++c) {
    int depth = 0;
    for (Index p = e.tree.parent[c]; p >= 0; p = e.tree.parent[p]) ++depth;
    const auto size = [&](Index k) { return e.u_at[k] < 0 ? 0 : e.front(k).size_u(); };
    now[depth % 2] += size(c);
    most[depth % 2] = std::max(most[depth % 2], now[depth % 2]);
    for (Index k = 0; k < c; ++k) {
      if (e.tree.parent[k] == c) now[1 - depth % 2] -= size(k);
    }
  }
  return most[0] + most[1];
}

}  // namespace

TEST_CASE("bytes foretold are those that the solver allocates", "[forecast]") {
  Random random(1);
  for (int trial = 0; trial < 400; ++trial) {
    const Index n = draw(random, 0, trial % 10 == 0 ? 200 : 30);
    const Pattern pattern = odd_pattern(random, n);
    const sg::factor::LinearSystem system = system_of(pattern, random);
    check_bytes(system, trial % 2 == 0 ? shuffled(random, n)
                                       : sg::order::elimination_order("amd", pattern));
  }
}

TEST_CASE("the stack of updates is as large as what waits", "[forecast]") {
  Random random(2);
  for (int trial = 0; trial < 200; ++trial) {
    const Pattern pattern = odd_pattern(random, draw(random, 1, 60));
    const sg::factor::LinearSystem system = system_of(pattern, random);
    sg::solve::Elimination plan =
        sg::solve::plan_elimination(system, sg::order::elimination_order("colamd", pattern));
    const auto stack = sg::solve::peak_bytes(plan) - sg::solve::factor_bytes(plan);
    CHECK(stack == (most_waiting(plan) + sg::solve::lane) * 8);
  }
}

TEST_CASE("bytes foretold are those of public graphs", "[forecast][data]") {
  const auto folder = public_graphs();
  if (!folder) return;
  for (const char* file :
       {"intel.g2o", "smallGrid3D.g2o", "sphere2500.g2o", "victoriaPark.isam.txt"}) {
    INFO(file);
    const sg::Graph graph = sg::formats::read_graph(*folder + "/" + file);
    const sg::factor::Problem problem = sg::factor::make_problem(graph);
    const sg::factor::LinearSystem system = sg::factor::make_linear_system(problem);
    for (const char* method : {"colamd", "metis", "rcm"}) {
      INFO(method);
      check_bytes(system, sg::order::elimination_order(method, *system.pattern));
    }
  }
}

TEST_CASE("work is counted front by front", "[forecast]") {
  // Three poses in a row and a landmark: the landmark is a leaf without an update, the poses are one clique.
  const Pattern pattern = make_pattern({6, 6, 6, 3}, {{0, 1}, {1, 2}, {0, 3}, {1, 3}, {2, 3}});
  const sg::solve::Work work = sg::solve::forecast(pattern, {3, 0, 1, 2}).work;
  const auto of = [&](std::string_view name) {
    const auto at = std::ranges::find(sg::solve::kinds, name, &sg::solve::Kind::name);
    return work[at - sg::solve::kinds.begin()];
  };
  // The landmark's separator, 18, is no more than 8 times as large: it forms an update.
  CHECK(of("front") + of("outer") > 0);
  CHECK(of("row") == 5);
  CHECK(of("pivot") == 21);
}

TEST_CASE("times are found again that made the samples", "[forecast]") {
  Random random(3);
  sg::solve::Times truth{};
  for (double& time : truth) time = draw(random, 0, 2) == 0 ? 0 : uniform(random, 0.1, 100);
  std::vector<sg::solve::Sample> samples;
  for (int k = 0; k < 60; ++k) {
    sg::solve::Work work{};
    const double size = std::exp(uniform(random, 0, 10));
    for (double& units : work) units = size * uniform(random, 0, 100);
    samples.push_back({work, sg::solve::seconds(work, truth)});
  }
  const sg::solve::Times found = sg::solve::fit_times(samples);
  for (std::size_t k = 0; k < truth.size(); ++k)
    CHECK(found[k] == Approx(truth[k]).epsilon(1e-3).margin(1e-3));
  CHECK(sg::solve::fit_times({}) == sg::solve::Times{});
}

TEST_CASE("no forecast of what is no order", "[forecast]") {
  const Pattern pattern = make_pattern({3, 3}, {{0, 1}});
  CHECK_THROWS_AS(sg::solve::forecast(pattern, {0, 0}), std::invalid_argument);
}
