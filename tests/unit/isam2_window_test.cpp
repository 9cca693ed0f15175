// A smoother that lets the past go, against batch elimination of all that it has ever held.
#include "lib/solve/isam2_window.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "lib/solve/eliminate.h"
#include "lib/solve/isam2_admit.h"
#include "lib/solve/isam2_covariance.h"
#include "lib/solve/isam2_leave.h"
#include "lib/text/error.h"
#include "tests/unit/common.h"

using namespace sg::test;

namespace {

std::string text(double number) {
  return std::to_string(number) + " ";
}

// A wavering walk in the plane: odometry, closures up to `reach` steps back, landmarks seen from poses in a row.
std::string walk(Random& random, int poses, int reach) {
  std::string lines;
  const auto relate = [&](int i, int j) {
    lines += "EDGE_SE2 " + std::to_string(2 * i) + " " + std::to_string(2 * j) + " " +
             text(j - i + uniform(random, -0.1, 0.1)) + text(uniform(random, -0.1, 0.1)) +
             text(uniform(random, -0.05, 0.05)) + "100 3 0 90 5 400\n";
  };
  for (int k = 1; k < poses; ++k) {
    relate(k - 1, k);
    if (draw(random, 0, 2) == 0) relate(std::max(0, k - draw(random, 1, reach)), k);
  }
  for (int l = 0; l < poses; ++l) {
    const int from = draw(random, 0, poses - 1), seen = draw(random, 1, reach);
    for (int k = from; k < std::min(poses, from + seen); ++k) {
      lines += "EDGE_SE2_XY " + std::to_string(2 * k) + " " + std::to_string(2 * l + 1) + " " +
               text(from - k + 2 + uniform(random, -0.1, 0.1)) +
               text(3 + uniform(random, -0.1, 0.1)) + "50 0 60\n";
    }
  }
  return lines;
}

// The largest difference of a step from that of batch elimination of all rows that have ever entered, linearized where
// their variables are now. past: of variables that have left, too.
double difference(const sg::solve::Isam2& isam, bool past) {
  const sg::factor::Problem& problem = *isam.problem;
  const sg::graph::Pattern& whole = problem.variables.pattern;
  std::vector<sg::Index> number(whole.variables(), -1), variable;
  // Rows may have been linearized and refused, or given back.
  const bool nothing_left = std::ranges::none_of(isam.pinned, std::identity());
  sg::graph::Pattern pattern;
  sg::factor::LinearSystem system;
  system.begin.assign(1, 0);
  for (sg::Index r = 0; r < whole.rows.size(); ++r) {
    if (isam.row_update[r] < 0 || (nothing_left && isam.tree.row_clique[r] < 0)) continue;
    for (const sg::Index j : whole.rows[r]) {
      if (number[j] < 0) {
        number[j] = pattern.variables();
        pattern.dim.push_back(whole.dim[j]);
        variable.push_back(j);
      }
      pattern.rows.items.push_back(number[j]);
    }
    pattern.rows.close();
    const int height = sg::factor::block_rows(problem, r);
    std::vector<double> block(height * sg::factor::block_columns(whole, r));
    sg::factor::linearize_row(problem, isam.linearized, {}, r, block.data());
    system.numbers.insert(system.numbers.end(), block.begin(), block.end());
    system.height.push_back(height);
    system.begin.push_back(static_cast<sg::Offset>(system.numbers.size()));
  }
  system.pattern = &pattern;
  auto elimination =
      sg::solve::plan_elimination(system, sg::order::elimination_order("colamd", pattern));
  REQUIRE(sg::solve::eliminate(elimination, system).empty());
  std::vector<double> step;
  sg::solve::back_substitute(elimination, step);
  double most = 0;
  for (std::size_t k = 0; k < variable.size(); ++k) {
    if (!past && isam.tree.variable_clique[variable[k]] < 0) continue;
    for (int i = 0; i < pattern.dim[k]; ++i)
      most = std::max(most, std::abs(isam.step[problem.step_at[variable[k]] + i] -
                                     step[elimination.step_at[k] + i]));
  }
  return most;
}

// Counts of what is there; EC_BT is the sum over the cliques.
void check_counts(const sg::solve::Isam2& isam) {
  sg::Index variables = 0, rows = 0, cliques = 0;
  sg::elim::Wide ec = 0;
  for (const sg::solve::Isam2Clique& c : isam.tree.cliques) {
    if (!is_there(c)) continue;
    variables += c.frontals;
    rows += c.rows;
    cliques += is_prior(c) ? 0 : 1;
    ec += static_cast<sg::elim::Wide>(c.f) * (c.f + c.s) * (c.f + c.s);
    CHECK(c.parent >= -1);
    if (c.separators == 0) continue;
    const sg::solve::Isam2Clique& parent = isam.tree.cliques[c.parent];
    CHECK(is_there(parent));
    for (const sg::Index j : separators_of(isam.tree, c)) {
      const auto above = lists_of(const_cast<sg::solve::Isam2Tree&>(isam.tree), parent)
                             .first(parent.frontals + parent.separators);
      CHECK(std::ranges::count(above, j) == 1);
      if (is_prior(c)) CHECK(isam.pinned[j]);
    }
  }
  CHECK(variables == isam.variables);
  CHECK(rows == isam.rows);
  CHECK(cliques == isam.tree.count);
  CHECK(ec == isam.tree.ec_bt);
}

sg::solve::Isam2Options exact(int trial) {
  sg::solve::Isam2Options options;
  options.wildfire_threshold = 0;
  options.relinearize_skip = trial % 3;
  options.relinearize_threshold = 0.01;
  if (trial % 4 == 3) options.ordering = "amd";
  return options;
}

}  // namespace

TEST_CASE("what leaves goes on being known: window and past are batch's solution", "[isam2]") {
  Random random(1);
  sg::Index dropped = 0;
  for (int trial = 0; trial < 24; ++trial) {
    const sg::Graph graph = graph_of(walk(random, 40, draw(random, 1, 8)));
    const sg::factor::Problem problem = sg::factor::make_problem(graph);
    sg::solve::WindowOptions options{.lag = draw(random, 1, 9), .smooth = true};
    if (trial % 6 == 5) options = {.distance = uniform(random, 1, 6), .smooth = true};
    auto window =
        sg::solve::make_isam2_window(problem, exact(trial), 1 + trial % 2, false, options);
    sg::solve::Isam2& isam = window.replay.isam;
    for (sg::Index k = 0; k < window.replay.steps.steps; ++k) {
      sg::solve::window_step(window, k);
      check_counts(isam);
      CHECK(difference(isam, false) < 1e-8);
      if (options.lag > 0) CHECK(k - window.first + 1 == std::min(k + 1, options.lag));
      if (options.lag == 0)
        CHECK((window.first == k ||
               window.travelled[k] - window.travelled[window.first] <= options.distance));
    }
    sg::solve::smooth_past(isam);
    CHECK(difference(isam, true) < 1e-7);
    dropped += window.dropped;
  }
  CHECK(dropped > 50);
}

TEST_CASE("a lag beyond the graph's length is plain iSAM2", "[isam2]") {
  Random random(2);
  for (int trial = 0; trial < 6; ++trial) {
    const sg::Graph graph = graph_of(walk(random, 40, 30));
    const sg::factor::Problem problem = sg::factor::make_problem(graph);
    auto plain = sg::solve::make_isam2_replay(problem, exact(trial), 1 + trial % 2, false);
    auto window =
        sg::solve::make_isam2_window(problem, exact(trial), 1 + trial % 2, false, {.lag = 40});
    for (sg::Index k = 0; k < plain.steps.steps; ++k) {
      const auto a = sg::solve::replay_step(plain, k);
      const auto b = sg::solve::window_step(window, k);
      CHECK(a.reeliminated == b.reeliminated);
      CHECK(a.relinearized == b.relinearized);
      CHECK(a.ec == b.ec);
      CHECK(plain.isam.tree.ec_bt == window.replay.isam.tree.ec_bt);
      CHECK(plain.isam.estimate == window.replay.isam.estimate);
    }
  }
}

TEST_CASE("a budget of EC is kept at every step, as it was foreseen", "[isam2]") {
  Random random(3);
  bool grew = false, shrank = false;
  for (int trial = 0; trial < 8; ++trial) {
    const sg::Graph graph = graph_of(walk(random, 80, draw(random, 2, 12)));
    const sg::factor::Problem problem = sg::factor::make_problem(graph);
    const sg::solve::WindowOptions options{.budget = 3000u << draw(random, 0, 4), .smooth = true};
    auto window =
        sg::solve::make_isam2_window(problem, exact(trial), 1 + trial % 2, false, options);
    sg::Index before = 0;
    for (sg::Index k = 0; k < window.replay.steps.steps; ++k) {
      sg::solve::window_step(window, k);
      check_counts(window.replay.isam);
      const sg::Index size = k - window.first + 1;
      CHECK(window.replay.isam.tree.ec_bt <= options.budget);
      grew |= window.first > 0 && size > before;
      shrank |= size < before;
      before = size;
    }
    CHECK(difference(window.replay.isam, false) < 1e-8);
    CHECK(window.first > 0);
  }
  CHECK(grew);
  CHECK(shrank);
}

TEST_CASE("the memory of a window is bounded by it", "[isam2]") {
  Random random(4);
  const sg::Graph graph = graph_of(walk(random, 600, 5));
  const sg::factor::Problem problem = sg::factor::make_problem(graph);
  auto window = sg::solve::make_isam2_window(problem, {}, 1, false, {.lag = 10});
  const sg::solve::Isam2Tree& tree = window.replay.isam.tree;
  for (sg::Index k = 0; k < 200; ++k) sg::solve::window_step(window, k);
  const auto numbers = tree.number_pool.end(), lists = tree.list_pool.end();
  const auto cliques = tree.cliques.size();
  for (sg::Index k = 200; k < 600; ++k) sg::solve::window_step(window, k);
  CHECK(tree.number_pool.end() < 2 * numbers);
  CHECK(tree.list_pool.end() < 2 * lists);
  CHECK(tree.cliques.size() < 2 * cliques);
}

TEST_CASE("what is admitted is solved, and the budget is kept", "[isam2]") {
  Random random(5);
  sg::Index returned = 0, refused = 0;
  for (int trial = 0; trial < 8; ++trial) {
    const sg::Graph graph = graph_of(walk(random, 60, draw(random, 10, 50)));
    const sg::factor::Problem problem = sg::factor::make_problem(graph);
    sg::solve::WindowOptions options{.budget = 16000u << draw(random, 0, 2),
                                     .spend = sg::solve::Spend::measurements};
    if (trial % 4 == 3) options.lag = 30;
    auto window =
        sg::solve::make_isam2_window(problem, exact(trial), 1 + trial % 2, false, options);
    const sg::solve::Isam2& isam = window.replay.isam;
    for (sg::Index k = 0; k < window.replay.steps.steps; ++k) {
      sg::solve::window_step(window, k);
      check_counts(isam);
      if (options.lag > 0) continue;
      CHECK(isam.tree.ec_bt <= options.budget);
      CHECK(difference(isam, false) < 1e-8);
    }
    if (options.lag == 0) CHECK(window.first == 0);
    returned += window.admission.returned;
    refused += window.admission.offered - window.admission.admitted;
  }
  CHECK(returned > 10);
  CHECK(refused > 10);
}

TEST_CASE("a budget without end admits all that is offered", "[isam2]") {
  Random random(6);
  for (int trial = 0; trial < 4; ++trial) {
    const sg::Graph graph = graph_of(walk(random, 40, 30));
    const sg::factor::Problem problem = sg::factor::make_problem(graph);
    auto window =
        sg::solve::make_isam2_window(problem, exact(3 * trial), 2, false,
                                     {.budget = 1u << 30, .spend = sg::solve::Spend::measurements});
    auto plain = sg::solve::make_isam2_replay(problem, exact(3 * trial), 2, false);
    for (sg::Index k = 0; k < plain.steps.steps; ++k) {
      sg::solve::replay_step(plain, k);
      sg::solve::window_step(window, k);
    }
    CHECK(window.admission.admitted == window.admission.offered);
    CHECK(window.admission.returned == 0);
    CHECK(window.replay.isam.rows == plain.isam.rows);
    CHECK(difference(window.replay.isam, false) < 1e-8);
  }
}

TEST_CASE("gain is by how much variances fall, and what giving back would lose", "[isam2]") {
  Random random(7);
  for (int trial = 0; trial < 6; ++trial) {
    const sg::Graph graph = graph_of(walk(random, 20, 12));
    const sg::factor::Problem problem = sg::factor::make_problem(graph);
    sg::solve::Isam2Options options = exact(0);
    options.relinearize_skip = 0;
    auto replay = sg::solve::make_isam2_replay(problem, options, 1, false);
    // All but the last row that is no odometry.
    sg::Index last = -1;
    for (sg::Index e = 0; e < graph.edges(); ++e) {
      const auto ends = graph.edge(e);
      if (replay.poses.index[ends[0]] >= 0 && replay.poses.index[ends[1]] >= 0 &&
          std::abs(replay.poses.index[ends[0]] - replay.poses.index[ends[1]]) > 2)
        last = e;
    }
    if (last < 0) continue;
    for (sg::Index k = 0; k < replay.steps.steps; ++k) {
      std::vector<sg::Index> edges(replay.edges[k].begin(), replay.edges[k].end());
      std::erase(edges, last);
      const auto in = sg::solve::enter(replay, replay.vertices[k], edges);
      sg::solve::check_solved(replay, k, sg::solve::update(replay.isam, in.variables, in.rows));
    }
    sg::solve::Isam2& isam = replay.isam;
    const auto admission = sg::solve::make_admission(replay);
    const auto row = problem.variables.pattern.rows[last];
    const auto m = sg::solve::measurement(isam, std::array{last});
    // By the definition: covariances of the two ends before and after.
    const auto variance = [&](sg::Index j) {
      return sg::solve::covariance(isam, j).topLeftCorner(2, 2).trace();
    };
    const double u = variance(row[0]), v = variance(row[1]);
    const double told = sg::solve::gain(isam, m, admission.place);
    const bool together = sg::solve::price(isam, row) == 0;
    const auto before = isam.tree.ec_bt;
    const double most = sg::solve::price(isam, row);
    sg::solve::update(isam, {}, std::array{last});
    const double fall_u = u - variance(row[0]), fall_v = v - variance(row[1]);
    const double poses = std::abs(admission.place[row[0]] - admission.place[row[1]]);
    const auto later = admission.place[row[0]] > admission.place[row[1]] ? fall_u : fall_v;
    CHECK(told == Approx(later + poses * (fall_u + fall_v) / 2).epsilon(1e-6));
    CHECK(sg::solve::gain(isam, m, admission.place, true) == Approx(told).epsilon(1e-6));
    CHECK(most >= 0);
    if (together) CHECK(isam.tree.ec_bt <= 2 * before);
  }
}
