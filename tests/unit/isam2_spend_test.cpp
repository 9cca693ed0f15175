// What a budget is spent on: poses that are composed away, and whatever costs least, against batch elimination of the rows
// that were kept.
#include "lib/solve/isam2_spend.h"

#include <array>

#include "lib/factor/initialize.h"
#include "lib/solve/isam2_leave.h"
#include "lib/solve/relative_pose.h"
#include "tests/unit/walks.h"

using namespace sg::test;

namespace {

struct Run {
  sg::solve::Isam2Window& window;
  std::vector<bool> marginalized = {};  // rows that left with one of their variables, by age
  std::vector<bool> in = {};

  // After a step.
  void look() {
    const sg::solve::Isam2& isam = window.replay.isam;
    const auto& variables = isam.problem->variables;
    const std::size_t rows = isam.tree.row_clique.size();
    marginalized.resize(rows, false);
    in.resize(rows, false);
    for (std::size_t r = 0; r < rows; ++r) {
      const bool now = isam.tree.row_clique[r] >= 0;
      // Rows that came and went in one step have been linearized in it.
      const bool was = in[r] || isam.row_update[r] == isam.updates;
      bool by_age = false, composed = false;
      for (const sg::Index j : variables.pattern.rows[static_cast<sg::Index>(r)]) {
        const sg::Index v = variables.variable_vertex[j], pose = window.replay.poses.index[v];
        const bool is_composed = pose >= 0 && sg::solve::is_composed(window.keyframes, pose);
        composed |= is_composed;
        by_age |= window.left[v] && !is_composed && isam.tree.variable_clique[j] < 0;
      }
      if (was && !now && by_age && !composed) marginalized[r] = true;
      in[r] = now;
    }
  }
  double difference() const {
    return sg::test::difference(window.replay.isam, false,
                                [&](sg::Index r) { return in[r] || marginalized[r]; });
  }
};

}  // namespace

TEST_CASE("keyframes and mixed: what is there is batch's solution of the rows that were kept",
          "[isam2]") {
  Random random(11);
  sg::Index composed = 0, moved = 0, returned = 0, left = 0;
  for (int trial = 0; trial < 24; ++trial) {
    const sg::Graph graph = graph_of(walk(random, 60, draw(random, 2, 40)));
    const sg::factor::Problem problem = sg::factor::make_problem(graph);
    const bool mixed = trial % 2 == 1;
    const sg::solve::WindowOptions options{
        .budget = 4000u << draw(random, 0, 3),
        .spend = mixed ? sg::solve::Spend::mixed : sg::solve::Spend::keyframes};
    auto window =
        sg::solve::make_isam2_window(problem, exact(trial), 1 + trial / 2 % 2, false, options);
    Run run{window};
    for (sg::Index k = 0; k < window.replay.steps.steps; ++k) {
      sg::solve::window_step(window, k);
      run.look();
      check_counts(window.replay.isam);
      CHECK(window.replay.isam.tree.ec_bt <= options.budget);
      CHECK(run.difference() < 1e-7);
      CHECK(window.there >= 1);
    }
    composed += window.keyframes.composed;
    moved += window.keyframes.moved;
    returned += window.keyframes.returned;
    left +=
        static_cast<sg::Index>(std::ranges::count(window.left, true)) - window.keyframes.composed;
  }
  CHECK(composed > 100);
  CHECK(moved > 100);
  CHECK(returned > 20);
  CHECK(left > 20);
}

TEST_CASE("poses composed along odometry are marginalized: nothing is lost of the rest",
          "[isam2]") {
  Random random(12);
  for (int trial = 0; trial < 6; ++trial) {
    std::string lines;
    const int poses = 40;
    const auto relate = [&](int i, int j, double noise) {
      lines += "EDGE_SE2 " + std::to_string(i) + " " + std::to_string(j) + " " +
               text(j - i + uniform(random, -noise, noise)) + text(uniform(random, -noise, noise)) +
               text(uniform(random, -noise, noise)) + "100 3 0 90 5 400\n";
    };
    for (int k = 1; k < poses; ++k) relate(k - 1, k, 0.1);
    relate(0, poses - 1, 0.01);
    const sg::Graph graph = graph_of(lines);
    const sg::factor::Problem problem = sg::factor::make_problem(graph);
    auto options = exact(0);
    options.relinearize_skip = 0;
    auto window = sg::solve::make_isam2_window(
        problem, options, 1, false, {.budget = 3000, .spend = sg::solve::Spend::keyframes});
    for (sg::Index k = 0; k < poses; ++k) sg::solve::window_step(window, k);
    CHECK(window.keyframes.composed > 15);
    // All rows as they were given, linearized where the poses started: there odometry has no error.
    auto plain = sg::solve::make_isam2_replay(problem, options, 1, false);
    for (sg::Index k = 0; k < poses; ++k) sg::solve::replay_step(plain, k);
    double most = 0;
    for (sg::Index j = 0; j < poses; ++j) {
      if (window.replay.isam.tree.variable_clique[j] < 0) continue;
      for (sg::Index i = problem.step_at[j]; i < problem.step_at[j + 1]; ++i)
        most = std::max(most, std::abs(window.replay.isam.step[i] - plain.isam.step[i]));
    }
    CHECK(most < 1e-9);
    sg::solve::place_composed(window.replay, window.keyframes);
    CHECK(window.replay.isam.estimate != plain.isam.estimate);  // to first order, and by one host
  }
}

TEST_CASE("a budget without end composes nothing", "[isam2]") {
  Random random(13);
  for (const auto spend : {sg::solve::Spend::keyframes, sg::solve::Spend::mixed}) {
    const sg::Graph graph = graph_of(walk(random, 40, 30));
    const sg::factor::Problem problem = sg::factor::make_problem(graph);
    auto window = sg::solve::make_isam2_window(problem, exact(0), 1, false,
                                               {.budget = 1u << 30, .spend = spend});
    auto plain = sg::solve::make_isam2_replay(problem, exact(0), 1, false);
    for (sg::Index k = 0; k < plain.steps.steps; ++k) {
      sg::solve::replay_step(plain, k);
      sg::solve::window_step(window, k);
    }
    CHECK(window.keyframes.composed == 0);
    CHECK(plain.isam.estimate == window.replay.isam.estimate);
  }
}

TEST_CASE("relative poses of every kind are composed, inverted, and place as their edges measure",
          "[isam2]") {
  const std::string identity3 = "1 0 0 0 0 0 2 0 0 0 0 3 0 0 0 4 0 0 5 0 6";
  const std::array<std::string, 3> kinds{"SE2", "SE3:QUAT", "SE3:EXPMAP"};
  for (const std::string& kind : kinds) {
    const bool planar = kind == "SE2";
    const std::array<std::string, 3> at =
        planar ? std::array<std::string, 3>{"1 2 0.3", "2 2.5 0.7", "2 4 -0.2"}
               : std::array<std::string, 3>{"1 2 3 0.5 0.5 0.5 0.5", "2 2 2 0 0 0.6 0.8",
                                            "2 4 1 0.6 0 0 0.8"};
    const std::string z[2] = {planar ? "1 0.5 0.4" : "1 0.5 0.2 0 0.6 0 0.8",
                              planar ? "0.3 2 -1" : "0.3 2 1 0.6 0 0 0.8"};
    const std::string information = planar ? "4 0 0 5 0 6" : identity3;
    std::string lines;
    for (int k = 0; k < 3; ++k)
      lines += "VERTEX_" + kind + " " + std::to_string(k) + " " + at[k] + "\n";
    for (int k = 0; k < 2; ++k)
      lines += "EDGE_" + kind + " " + std::to_string(k) + " " + std::to_string(k + 1) + " " + z[k] +
               " " + information + "\n";
    const sg::Graph graph = graph_of(lines);
    const sg::factor::Problem problem = sg::factor::make_problem(graph);
    sg::factor::Values x = sg::factor::file_values(problem);
    const auto pose = [&](sg::Index v) { return x.data() + problem.value_at[v]; };
    const auto first = sg::solve::relative_pose(problem, 0),
               second = sg::solve::relative_pose(problem, 1);
    sg::solve::place(first, pose(0), pose(1));
    sg::solve::place(second, pose(1), pose(2));
    CHECK(sg::factor::finite_edge_chi2(problem, x, 0) == Approx(0).margin(1e-18));
    CHECK(sg::factor::finite_edge_chi2(problem, x, 1) == Approx(0).margin(1e-18));
    const auto both = sg::solve::compose(first, second);
    const std::vector<double> there(pose(2), pose(2) + (planar ? 3 : 7)),
        start(pose(0), pose(0) + (planar ? 3 : 7));
    sg::solve::place(both, pose(0), pose(2));
    sg::solve::place(sg::solve::inverse(both), pose(2), pose(0));
    for (std::size_t i = 0; i < there.size(); ++i) {
      CHECK(pose(2)[i] == Approx(there[i]).margin(1e-12));
      CHECK(pose(0)[i] == Approx(start[i]).margin(1e-12));
    }
    CHECK(sg::solve::variance(both) > sg::solve::variance(first));
    // All the way to another estimate, and none of it.
    sg::solve::blend(problem.space[0], pose(1), 0, pose(0));
    for (std::size_t i = 0; i < there.size(); ++i)
      CHECK(pose(0)[i] == Approx(start[i]).margin(1e-12));
    sg::solve::blend(problem.space[0], pose(1), 1, pose(0));
    for (std::size_t i = 0; i < there.size(); ++i)
      CHECK(pose(0)[i] == Approx(pose(1)[i]).margin(1e-12));
  }
}

TEST_CASE("what came back to an age is expected of it", "[isam2]") {
  sg::solve::Returns returns;
  CHECK(sg::solve::expected_edges(returns, 5) == 0);
  for (int k = 0; k < 3000; ++k) {
    sg::solve::next_step(returns);
    sg::solve::note_return(returns, 64);
    sg::solve::note_return(returns, 64);
  }
  CHECK(sg::solve::expected_edges(returns, 30) == Approx(2).epsilon(1e-3));
  CHECK(sg::solve::expected_edges(returns, 2000) == 0);
}

TEST_CASE("what nothing has come back to yet is told by the tail of the ages", "[isam2]") {
  sg::solve::Returns laps, anywhere;
  CHECK(sg::solve::expected_edges(sg::solve::tail_of(laps), 1000) == 1);
  for (int k = 0; k < 400; ++k) {
    for (auto* const returns : {&laps, &anywhere}) sg::solve::next_step(*returns);
    sg::solve::note_return(laps, 48 + k % 5);
    sg::solve::note_return(anywhere, 4 << k % 7);
    if (k > 0) continue;  // one edge says little
    CHECK(sg::solve::expected_edges(sg::solve::tail_of(laps), 600) > 0.1);
  }
  CHECK(sg::solve::expected_edges(laps, 600) == 0);
  CHECK(sg::solve::expected_edges(sg::solve::tail_of(laps), 600) < 1e-5);
  CHECK(sg::solve::expected_edges(anywhere, 600) == 0);
  CHECK(sg::solve::expected_edges(sg::solve::tail_of(anywhere), 600) > 0.02);
  CHECK(sg::solve::expected_edges(sg::solve::tail_of(anywhere), 1) < 1);
}

TEST_CASE("mixed lets poses leave that laps will not come back to, and composes none", "[isam2]") {
  std::string lines;
  for (int k = 1; k < 200; ++k) {
    const auto relate = [&](int i, const std::string& z) {
      lines += "EDGE_SE2 " + std::to_string(i) + " " + std::to_string(k) + " " + z +
               " 100 0 0 100 0 400\n";
    };
    relate(k - 1, "1 0 0.785398");
    if (k >= 8) relate(k - 8, "0 0 0");
  }
  const sg::Graph graph = graph_of(lines);
  const sg::factor::Problem problem = sg::factor::make_problem(graph);
  auto window = sg::solve::make_isam2_window(problem, exact(0), 1, false,
                                             {.budget = 100'000, .spend = sg::solve::Spend::mixed});
  for (sg::Index k = 0; k < window.replay.steps.steps; ++k) {
    sg::solve::window_step(window, k);
    CHECK(window.replay.isam.tree.ec_bt <= window.options.budget);
  }
  CHECK(window.keyframes.composed == 0);
  CHECK(window.dropped == 0);
  CHECK(window.first > 100);
}
