// The incremental smoother against batch elimination of what it holds, and its bookkeeping against
// the definitions.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "formats/formats.h"
#include "lib/order/order.h"
#include "lib/solve/batch.h"
#include "lib/solve/clique_tree.h"
#include "lib/solve/eliminate.h"
#include "lib/solve/isam2_replay.h"
#include "lib/solve/landmark_point.h"
#include "lib/solve/pool.h"
#include "lib/solve/snapshot.h"
#include "lib/text/error.h"
#include "tests/unit/common.h"

using namespace sg::test;

namespace {

double noise(Random& random, double size) {
  return uniform(random, -size, size);
}

// A walk in the plane with loop closures, doubled edges, landmarks, and a prior somewhere.
std::string random_walk(Random& random, int poses, bool vertices) {
  std::string edges, lines;
  const auto text = [](double number) { return std::to_string(number) + " "; };
  double x = 0, y = 0, theta = 0;
  std::vector<std::array<double, 3>> at;
  for (int k = 0; k < poses; ++k) {
    at.push_back({x, y, theta});
    lines += "VERTEX_SE2 " + std::to_string(2 * k) + " " + text(x) + text(y) + text(theta) + "\n";
    theta += draw(random, 0, 3) == 0 ? 1.57 : 0;
    x += std::cos(theta);
    y += std::sin(theta);
  }
  const auto relate = [&](int i, int j) {
    const double c = std::cos(at[i][2]), s = std::sin(at[i][2]);
    const double dx = at[j][0] - at[i][0], dy = at[j][1] - at[i][1];
    edges += "EDGE_SE2 " + std::to_string(2 * i) + " " + std::to_string(2 * j) + " " +
             text(c * dx + s * dy + noise(random, 0.1)) +
             text(c * dy - s * dx + noise(random, 0.1)) +
             text(at[j][2] - at[i][2] + noise(random, 0.05)) + "100 0 0 90 5 400\n";
  };
  for (int k = 1; k < poses; ++k) {
    relate(k - 1, k);
    if (draw(random, 0, 9) == 0) relate(k - 1, k);
    if (draw(random, 0, 2) == 0) relate(draw(random, 0, k - 1), k);
  }
  for (int l = 0; l < poses / 4; ++l) {
    const double lx = noise(random, 5), ly = noise(random, 5);
    const std::string id = std::to_string(2 * l + 1);
    lines += "VERTEX_XY " + id + " " + text(lx) + text(ly) + "\n";
    for (int o = draw(random, 1, 5); o > 0; --o) {
      const int k = draw(random, 0, poses - 1);
      const double c = std::cos(at[k][2]), s = std::sin(at[k][2]);
      const double dx = lx - at[k][0], dy = ly - at[k][1];
      edges += "EDGE_SE2_XY " + std::to_string(2 * k) + " " + id + " " +
               text(c * dx + s * dy + noise(random, 0.1)) +
               text(c * dy - s * dx + noise(random, 0.1)) + "50 0 60\n";
    }
  }
  return vertices ? lines + edges : edges;
}

// Cliques that are in the tree.
std::vector<sg::Index> alive(const sg::solve::Isam2& isam) {
  const std::set<sg::Index> free(isam.tree.free.begin(), isam.tree.free.end());
  std::vector<sg::Index> cliques;
  for (sg::Index c = 0; c < static_cast<sg::Index>(isam.tree.cliques.size()); ++c) {
    if (!free.contains(c)) cliques.push_back(c);
  }
  return cliques;
}

// Every variable is frontal once, every row assembled once, where its first variable is eliminated;
// separators lie within parents; what is summed up is the sum. Returns how many cliques are made of several.
int check_tree(const sg::solve::Isam2& isam) {
  int merged = 0;
  std::set<sg::Index> variables, rows;
  sg::elim::Wide ec_bt = 0;
  sg::Index cliques = 0;
  for (sg::Index c : alive(isam)) {
    const sg::solve::Isam2Clique& clique = isam.tree.cliques[c];
    const sg::Index* list = isam.tree.lists.data() + clique.lists;
    const std::set<sg::Index> members(list, list + clique.frontals + clique.separators);
    for (sg::Index k = 0; k < clique.frontals; ++k) {
      CHECK(variables.insert(list[k]).second);
      CHECK(isam.tree.variable_clique[list[k]] == c);
    }
    for (sg::Index k = 0; k < clique.rows; ++k) {
      const sg::Index r = list[clique.frontals + clique.separators + k];
      CHECK(rows.insert(r).second);
      CHECK(isam.tree.row_clique[r] == c);
      for (sg::Index j : isam.problem->variables.pattern.rows[r]) CHECK(members.contains(j));
    }
    CHECK((clique.parent < 0) == (clique.separators == 0));
    if (clique.parent >= 0) {
      const sg::solve::Isam2Clique& parent = isam.tree.cliques[clique.parent];
      const sg::Index* up = isam.tree.lists.data() + parent.lists;
      const std::set<sg::Index> above(up, up + parent.frontals + parent.separators);
      for (sg::Index k = 0; k < clique.separators; ++k)
        CHECK(above.contains(list[clique.frontals + k]));
    }
    ec_bt += static_cast<sg::elim::Wide>(clique.ec);
    cliques += clique.merged;
    merged += clique.merged > 1 ? 1 : 0;
  }
  CHECK(static_cast<sg::Index>(variables.size()) == isam.variables);
  CHECK(static_cast<sg::Index>(rows.size()) == isam.rows);
  CHECK(ec_bt == isam.tree.ec_bt);
  CHECK(cliques == isam.tree.count);
  return merged;
}

// Largest difference between the smoother's step and the one that batch elimination of the same
// linearized system gives.
double difference(const sg::solve::Isam2& isam) {
  sg::solve::Snapshot snapshot;
  sg::solve::take_snapshot(isam, true, snapshot);
  sg::solve::take_snapshot(isam, true, snapshot);  // overwrites
  REQUIRE(snapshot.system.height.size() == snapshot.anchored.rows.size());
  auto elimination = sg::solve::plan_elimination(
      snapshot.system, sg::order::elimination_order("colamd", snapshot.anchored));
  REQUIRE(sg::solve::eliminate(elimination, snapshot.system).empty());
  std::vector<double> step;
  sg::solve::back_substitute(elimination, step);
  double most = 0;
  for (std::size_t k = 0; k < snapshot.variable.size(); ++k) {
    const sg::Index at = isam.problem->step_at[snapshot.variable[k]];
    for (int i = 0; i < snapshot.anchored.dim[k]; ++i)
      most = std::max(most, std::abs(isam.step[at + i] - step[elimination.step_at[k] + i]));
  }
  return most;
}

double batch_chi2(const sg::factor::Problem& problem, sg::factor::Values values) {
  const sg::graph::Order order = sg::order::elimination_order("colamd", problem.variables.pattern);
  sg::factor::LinearSystem system = sg::factor::make_linear_system(problem);
  const auto solver = sg::solve::backends().front().make(system, order, 1);
  return sg::solve::optimize(problem, system, solver, {}, values).chi2;
}

}  // namespace

TEST_CASE("pool: blocks never overlap and come back", "[isam2]") {
  Random random(1);
  const std::int64_t chunk = 128;
  sg::solve::Pool pool(chunk);
  std::vector<std::pair<std::int64_t, std::int64_t>> taken;
  for (int trial = 0; trial < 3000; ++trial) {
    if (draw(random, 0, 2) > 0 || taken.empty()) {
      const std::int64_t size = draw(random, 1, 400);
      const std::int64_t begin = pool.take(size);
      CHECK(begin % 8 == 0);
      CHECK((begin % chunk == 0 || begin % chunk + size <= chunk));
      CHECK(begin + size <= pool.end());
      const bool apart = std::ranges::all_of(taken, [&](const auto& other) {
        return begin + size <= other.first || other.first + other.second <= begin;
      });
      CHECK(apart);
      taken.emplace_back(begin, size);
    } else {
      const auto which = taken.begin() + draw(random, 0, static_cast<int>(taken.size()) - 1);
      pool.give(which->first, which->second);
      taken.erase(which);
    }
  }
  const std::int64_t end = pool.end();
  const std::int64_t begin = pool.take(100);
  pool.give(begin, 100);
  CHECK(pool.take(100) == begin);
  CHECK(pool.end() <= end + 128);
}

TEST_CASE("each step solves the linearized system as batch elimination does", "[isam2]") {
  Random random(2);
  int merged = 0;
  for (int trial = 0; trial < 12; ++trial) {
    const sg::Graph graph = graph_of(random_walk(random, draw(random, 2, 60), trial % 2 == 0));
    const sg::factor::Problem problem = sg::factor::make_problem(graph);
    sg::solve::Isam2Options options;
    options.wildfire_threshold = 0;
    options.relinearize_skip = trial % 3;
    options.relinearize_threshold = trial % 4 == 0 ? 0.001 : 0.05;
    if (trial % 5 == 4) options.ordering = "amd";
    if (trial % 3 == 1) options.relaxed_from = 0;
    auto replay = sg::solve::make_isam2_replay(problem, options, 1 + trial % 2, trial % 4 == 2);
    for (sg::Index k = 0; k < replay.steps.steps; ++k) {
      sg::solve::replay_step(replay, k);
      merged += check_tree(replay.isam);
      CHECK(difference(replay.isam) < 1e-8);
    }
  }
  CHECK(merged > 100);
}

TEST_CASE("cliques that join their parents change what it costs, not what comes out", "[isam2]") {
  Random random(8);
  for (int trial = 0; trial < 6; ++trial) {
    const sg::Graph graph = graph_of(random_walk(random, 60, true));
    const sg::factor::Problem problem = sg::factor::make_problem(graph);
    sg::solve::Isam2Options options;
    options.wildfire_threshold = 0;
    options.relaxed_from = sg::solve::never;
    auto apart = sg::solve::make_isam2_replay(problem, options, 1, false);
    options.relaxed_from = 0;
    auto joined = sg::solve::make_isam2_replay(problem, options, 1, false);
    for (sg::Index k = 0; k < apart.steps.steps; ++k) {
      sg::solve::replay_step(apart, k);
      sg::solve::replay_step(joined, k);
      CHECK(sg::solve::chi2(joined.isam) == Approx(sg::solve::chi2(apart.isam)).epsilon(1e-6));
    }
    CHECK(joined.isam.tree.cliques.size() - joined.isam.tree.free.size() <
          apart.isam.tree.cliques.size() - apart.isam.tree.free.size());
  }
}

TEST_CASE("without relaxing thresholds, replay ends at batch's optimum", "[isam2]") {
  Random random(3);
  for (int trial = 0; trial < 6; ++trial) {
    const sg::Graph graph = graph_of(random_walk(random, 60, true));
    const sg::factor::Problem problem = sg::factor::make_problem(graph);
    auto replay = sg::solve::make_isam2_replay(problem, {}, 1, false);
    for (sg::Index k = 0; k < replay.steps.steps; ++k) sg::solve::replay_step(replay, k);
    const double best = batch_chi2(problem, replay.isam.estimate);
    CHECK(sg::solve::chi2(replay.isam) == Approx(best).epsilon(0.01));
    // What is held stays.
    CHECK(replay.isam.estimate[0] == 0);
  }
}

TEST_CASE("skip 0 never relinearizes, a threshold of 0 does at once", "[isam2]") {
  Random random(4);
  const sg::Graph graph = graph_of(random_walk(random, 40, false));
  const sg::factor::Problem problem = sg::factor::make_problem(graph);
  sg::solve::Isam2Options options;
  options.relinearize_skip = 0;
  auto never = sg::solve::make_isam2_replay(problem, options, 1, false);
  sg::Index relinearized = 0;
  for (sg::Index k = 0; k < never.steps.steps; ++k)
    relinearized += sg::solve::replay_step(never, k).relinearized;
  CHECK(relinearized == 0);
  options.relinearize_skip = 1;
  options.relinearize_threshold = 0;
  options.wildfire_threshold = 0;
  auto always = sg::solve::make_isam2_replay(problem, options, 1, false);
  for (sg::Index k = 0; k < always.steps.steps; ++k) {
    const auto before = always.isam.variables;
    CHECK(sg::solve::replay_step(always, k).relinearized == before);
  }
}

TEST_CASE("below where steps change little nothing is touched", "[isam2]") {
  Random random(7);
  const sg::Graph graph = graph_of(random_walk(random, 60, true));
  const sg::factor::Problem problem = sg::factor::make_problem(graph);
  sg::solve::Isam2Options options;
  options.relinearize_skip = 0;
  options.wildfire_threshold = 0.5;
  auto replay = sg::solve::make_isam2_replay(problem, options, 1, false);
  const sg::solve::Isam2& isam = replay.isam;
  sg::Index untouched = 0;
  for (sg::Index k = 0; k < replay.steps.steps; ++k) {
    const std::vector<double> step = isam.step, told = isam.told;
    sg::solve::replay_step(replay, k);
    for (const sg::solve::Isam2Clique& clique : isam.tree.cliques) {
      if (clique.made == isam.updates) continue;
      double change = 0;
      bool same = true;
      for (sg::Index j : frontals_of(isam.tree, clique)) {
        if (isam.tree.variable_clique[j] != &clique - isam.tree.cliques.data()) continue;
        for (sg::Index i = problem.step_at[j]; i < problem.step_at[j + 1]; ++i) {
          change = std::max(change, std::abs(isam.step[i] - told[i]));
          same &= isam.step[i] == step[i];
        }
      }
      if (change >= options.wildfire_threshold) continue;
      CHECK(same);
      ++untouched;
    }
  }
  CHECK(untouched > 100);
}

TEST_CASE("a landmark moves along its ray by as much as halves or doubles its distance",
          "[isam2]") {
  const sg::Graph graph =
      graph_of("VERTEX_SE2 0 0 0 0\nVERTEX_XY 1 1 0\nEDGE_BEARING_SE2_XY 0 1 0 1\n");
  const sg::factor::Problem problem = sg::factor::make_problem(graph);
  const auto moved = [&](double step) {
    sg::factor::Values estimate = sg::factor::file_values(problem);
    std::vector<double> point{1, 0};
    sg::solve::move_landmark(problem, 1, std::array{sg::Index{0}}, std::array{step, 0.0}, estimate,
                             point.data());
    CHECK(point[1] == 0);
    return point[0];
  };
  CHECK(moved(0.25) == Approx(1.25));
  CHECK(moved(2) == Approx(2));
  CHECK(moved(-0.25) == Approx(0.75));
  CHECK(moved(-0.9) == Approx(0.5));
}

TEST_CASE("a step that cannot be solved is named with what it leaves open", "[isam2]") {
  const sg::Graph graph = graph_of(
      "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 0\nVERTEX_SE2 2 2 0 0\nVERTEX_SE2 3 3 0 0\n"
      "EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\nEDGE_SE2 2 3 1 0 0 1 0 0 1 0 1\n");
  const sg::factor::Problem problem = sg::factor::make_problem(graph);
  auto replay = sg::solve::make_isam2_replay(problem, {}, 1, false);
  sg::solve::replay_step(replay, 0);
  sg::solve::replay_step(replay, 1);
  try {
    sg::solve::replay_step(replay, 2);
    FAIL("solved");
  } catch (const sg::text::Error& error) {
    CHECK(error.fault == sg::text::Fault::computation);
    CHECK(std::string(error.what()) ==
          "step 2: the system is singular: the measurements leave vertex 2 undetermined; "
          "add edges or FIX lines, or leave it out");
  }
}

TEST_CASE("public graphs: replay comes within 1 % of batch", "[isam2]") {
  const auto folder = public_graphs();
  if (!folder) return;
  for (const char* name : {"intel.g2o", "manhattanOlson3500.isam.txt"}) {
    INFO(name);
    const sg::Graph graph = sg::formats::read_graph(*folder + "/" + name);
    const sg::factor::Problem problem = sg::factor::make_problem(graph);
    auto replay = sg::solve::make_isam2_replay(problem, {}, 1, false);
    for (sg::Index k = 0; k < replay.steps.steps; ++k) sg::solve::replay_step(replay, k);
    check_tree(replay.isam);
    CHECK(sg::solve::chi2(replay.isam) ==
          Approx(batch_chi2(problem, replay.isam.estimate)).epsilon(0.01));
  }
}
