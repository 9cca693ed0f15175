// A smoother that lets the past go, against batch elimination of all that it has ever held.
#include "lib/solve/isam2_window.h"

#include <array>

#include "lib/solve/isam2_admit.h"
#include "lib/solve/isam2_covariance.h"
#include "lib/solve/isam2_leave.h"
#include "lib/text/error.h"
#include "tests/unit/walks.h"

using namespace sg::test;

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

TEST_CASE("landmarks seen by bearings leave with their tracks, and no prior reaches them before",
          "[isam2]") {
  Random random(8);
  int forgotten = 0, left = 0;
  for (int trial = 0; trial < 6; ++trial) {
    std::string lines;
    constexpr int poses = 40;
    for (int k = 1; k < poses; ++k) {
      lines += "EDGE_SE2 " + std::to_string(2 * k - 2) + " " + std::to_string(2 * k) + " 1 " +
               text(uniform(random, -0.01, 0.01)) + "0 1e4 0 0 1e4 0 1e6\n";
    }
    for (int l = 0; l < poses; ++l) {
      const int tracked = draw(random, 2, 12);
      for (int k = l; k < std::min(poses, l + tracked); ++k) {
        lines += "EDGE_BEARING_SE2_XY " + std::to_string(2 * k) + " " + std::to_string(2 * l + 1) +
                 " " + text(std::atan2(5, l + 4 - k) + uniform(random, -1e-3, 1e-3)) + "1e6\n";
      }
    }
    const sg::Graph graph = graph_of(lines);
    const sg::factor::Problem problem = sg::factor::make_problem(graph);
    const int min_obs = 2 + trial % 2;
    const sg::solve::WindowOptions options{.lag = draw(random, 3, 8)};
    auto window = sg::solve::make_isam2_window(problem, exact(trial), min_obs, false, options);
    const sg::solve::Isam2& isam = window.replay.isam;
    std::vector<bool> was_there(graph.edges(), false);
    for (sg::Index k = 0; k < window.replay.steps.steps; ++k) {
      sg::solve::window_step(window, k);
      check_counts(isam);
      for (sg::Index v = 0; v < graph.vertices(); ++v) {
        if (graph.role(v) != sg::graph::Role::landmark) continue;
        const sg::Index j = problem.variables.vertex_variable[v];
        if (isam.tree.variable_clique[j] < 0) continue;
        CHECK_FALSE(isam.pinned[j]);
        CHECK(window.last_seen[v] >= window.first);
        CHECK(rows_in(isam, j).size() >= static_cast<std::size_t>(min_obs));
      }
      for (sg::Index e = 0; e < graph.edges(); ++e) {
        const bool there = isam.tree.row_clique[e] >= 0;
        const sg::Index v = graph.edge(e)[1];
        const bool landmark_stays =
            isam.tree.variable_clique[problem.variables.vertex_variable[v]] >= 0;
        if (was_there[e] && !there) ++(landmark_stays ? forgotten : left);
        was_there[e] = there;
      }
    }
  }
  CHECK(forgotten > 100);
  CHECK(left > 100);
}
