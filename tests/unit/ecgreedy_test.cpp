// Greedy by accuracy per EC: what it says of cost and gain, against new scorings and dense algebra.
#include "lib/prune/ecgreedy.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <numeric>

#include "lib/elim/filled_graph.h"
#include "lib/factor/initialize.h"
#include "lib/factor/linearize.h"
#include "lib/prune/candidates.h"
#include "lib/prune/information_gain.h"
#include "lib/score/sigma.h"
#include "tests/unit/common.h"

using namespace sg;
using namespace sg::test;

namespace {

// Poses along a curve, landmarks beside it, seen by position; closures now and then.
Graph random_world(Random& random, int poses, int landmarks, int closures) {
  std::string text;
  const auto number = [&](double least, double limit) {
    return " " + std::to_string(uniform(random, least, limit));
  };
  for (int i = 0; i < poses; ++i)
    text += "VERTEX_SE2 " + std::to_string(i) + " " + std::to_string(i) + number(-1, 1) +
            number(-1, 1) + "\n";
  for (int l = 0; l < landmarks; ++l)
    text += "VERTEX_XY " + std::to_string(1000 + l) + number(0, poses) + number(-2, 2) + "\n";
  const auto motion = [&](int i, int j) {
    text += "EDGE_SE2 " + std::to_string(i) + " " + std::to_string(j) + " 1 0 0" + number(1, 9) +
            " 0 0" + number(1, 9) + " 0" + number(1, 9) + "\n";
  };
  for (int i = 1; i < poses; ++i) motion(i - 1, i);
  for (int l = 0; l < landmarks; ++l) {
    for (int i = 0; i < poses; ++i) {
      if (draw(random, 0, 2) > 0) continue;
      text += "EDGE_SE2_XY " + std::to_string(i) + " " + std::to_string(1000 + l) + " 1 1" +
              number(1, 9) + " 0" + number(1, 9) + "\n";
    }
  }
  for (int k = 0; k < closures; ++k) {
    const int i = draw(random, 0, poses - 3);
    motion(i, draw(random, i + 2, poses - 1));
  }
  return graph_of(text);
}

struct World {
  Graph graph;
  factor::Problem problem;
  factor::Values values;
  graph::PoseIndex poses;
  std::vector<Index> candidates;
  prune::EcGreedyOptions options;

  explicit World(Graph made)
      : graph(std::move(made)),
        problem(factor::make_problem(graph)),
        values(factor::start_values(problem)),
        poses(graph::pose_index(graph)),
        candidates(prune::candidate_edges(graph, poses, prune::Candidates::both)) {
    options.order = [](const graph::GraphPattern& part) {
      return order::elimination_order("wmf", part.pattern);
    };
  }
  std::vector<prune::Move> moves() const {
    return prune::ecgreedy(problem, values, poses, candidates, options);
  }
};

// The covariance of the poses' positions and angles, by the rows that are in, dense.
Eigen::MatrixXd dense_covariance(const World& world, const std::vector<bool>& edge) {
  factor::LinearSystem system = factor::make_linear_system(world.problem);
  factor::linearize(world.problem, world.values, {}, system);
  const graph::Pattern& pattern = world.problem.variables.pattern;
  const Index n = world.problem.step_at.back();
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(n, n);
  for (Index r = 0; r < pattern.rows.size(); ++r) {
    if (r < world.graph.edges() && !edge[r]) continue;
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(system.height[r], n);
    const double* column = system.block(r);
    for (const Index j : pattern.rows[r]) {
      for (int k = 0; k < pattern.dim[j]; ++k, column += system.height[r])
        a.col(world.problem.step_at[j] + k) =
            Eigen::Map<const Eigen::VectorXd>(column, system.height[r]);
    }
    information += a.transpose() * a;
  }
  for (Index k = 0; k < n; ++k) {  // landmarks that are not in
    if (information(k, k) == 0) information(k, k) = 1;
  }
  return information.inverse();
}

double position_variances(const World& world, const Eigen::MatrixXd& covariance) {
  double sum = 0;
  for (const Index v : world.poses.pose) {
    const Index j = world.problem.variables.vertex_variable[v];
    if (j == world.problem.held) continue;
    const Index at = world.problem.step_at[j];
    sum += covariance(at, at) + covariance(at + 1, at + 1);
  }
  return sum;
}

std::vector<bool> edges_after(const World& world, std::span<const prune::Move> moves) {
  const std::vector<bool> kept = prune::kept_by(world.candidates, moves);
  std::vector<bool> edge(world.graph.edges(), true);
  for (std::size_t i = 0; i < kept.size(); ++i) edge[world.candidates[i]] = kept[i];
  return edge;
}

}  // namespace

TEST_CASE("increases of EC are those of a new scoring", "[ecgreedy]") {
  for (int trial = 0; trial < 200; ++trial) {
    Random random(trial);
    const int n = draw(random, 1, 30);
    graph::Pattern pattern = odd_pattern(random, n);
    graph::Order order(n);
    std::iota(order.begin(), order.end(), 0);
    elim::FilledGraph filled = elim::filled_graph(elim::ordered(pattern, order));
    REQUIRE(filled.ec == elim::elimination_complexity(pattern, order));
    for (int k = 0; k < 10; ++k) {
      std::vector<Index> factor;
      for (Index j = 0; j < n; ++j) {
        if (draw(random, 0, n) < 3) factor.push_back(j);
      }
      const elim::Wide before = filled.ec, promised = elim::increase(filled, factor);
      pattern.rows.add(factor);
      CHECK(elim::add_factor(filled, factor) == promised);
      CHECK(filled.ec == elim::elimination_complexity(pattern, order));
      CHECK(filled.ec == before + promised);
      CHECK(elim::increase(filled, factor) == 0);
    }
  }
}

TEST_CASE("gains and sigmas are those of dense algebra", "[ecgreedy]") {
  for (int trial = 0; trial < 12; ++trial) {
    Random random(50 + trial);
    const int landmarks = trial % 3 == 0 ? 0 : draw(random, 1, 8);
    const World world(random_world(random, draw(random, 8, 40), landmarks, draw(random, 2, 12)));
    const std::vector<prune::Move> moves = world.moves();
    double before = 0;
    for (std::size_t k = 0; k < moves.size(); ++k) {
      const std::span<const prune::Move> made(moves.data(), k + 1);
      const double now = position_variances(world, dense_covariance(world, edges_after(world, made)));
      INFO("move " << k << " of trial " << trial);
      if (k > 0) CHECK(moves[k].gain == Approx(before - now).epsilon(1e-6).margin(1e-9));
      before = now;
    }
    CHECK(moves.back().kept == static_cast<Index>(world.candidates.size()));
    const auto sigmas = score::pose_sigmas(
        world.problem, world.values,
        order::elimination_order("colamd", world.problem.variables.pattern));
    double sum = 0;
    for (const score::PoseSigma& pose : sigmas) sum += pose.sigma;
    CHECK(moves.back().sigma == Approx(sum / static_cast<double>(sigmas.size())));
  }
}

TEST_CASE("the same call makes the same moves, and a budget is kept", "[ecgreedy]") {
  Random random(3);
  World world(random_world(random, 40, 6, 20));
  const std::vector<prune::Move> moves = world.moves(), again = world.moves();
  REQUIRE(moves.size() == again.size());
  for (std::size_t k = 0; k < moves.size(); ++k) {
    CHECK(moves[k].edges == again[k].edges);
    CHECK(moves[k].gain == again[k].gain);
  }
  const elim::Wide middle = (moves.front().ec + moves.back().ec) / 2;
  const std::size_t count = prune::moves_within(world.graph, world.poses, world.candidates, moves,
                                                middle, world.options);
  CHECK(count > 1);
  CHECK(count < moves.size());
  world.options.sigma = 1.1 * moves.back().sigma;
  CHECK(world.moves().back().sigma <= *world.options.sigma);
}
