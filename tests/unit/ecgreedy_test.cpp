// Greedy by accuracy per EC: what it says of cost and gain, against new scorings and dense algebra.
#include "lib/prune/ecgreedy.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "lib/elim/filled_graph.h"
#include "lib/factor/initialize.h"
#include "lib/prune/candidates.h"
#include "lib/prune/exchange.h"
#include "lib/prune/offer.h"
#include "tests/unit/common.h"

using namespace sg;
using namespace sg::test;
using prune::Move;

namespace {

// Poses along a curve; landmarks beside it, seen by position, some of them known by a prior as well; closures now and
// then.
std::string random_text(Random& random, int poses, int landmarks, int closures) {
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
      if (i != l && draw(random, 0, 2) > 0) continue;
      text += "EDGE_SE2_XY " + std::to_string(i) + " " + std::to_string(1000 + l) + " 1 1" +
              number(1, 9) + " 0" + number(1, 9) + "\n";
    }
    if (draw(random, 0, 3) == 0)
      text += "EDGE_PRIOR_XY " + std::to_string(1000 + l) + " 1 1 0.1 0 0.1\n";
  }
  for (int k = 0; k < closures; ++k) {
    const int i = draw(random, 0, poses - 3);
    motion(i, draw(random, i + 2, poses - 1));
  }
  return text;
}

struct World {
  Graph graph;
  factor::Problem problem;
  prune::Evidence evidence;
  graph::PoseIndex poses;
  std::vector<Index> candidates;
  prune::Choice choice;
  prune::EcGreedyOptions options;

  explicit World(const std::string& text, Index min_obs = 1)
      : graph(graph_of(text)),
        problem(factor::make_problem(graph)),
        evidence(prune::measured_evidence(problem, factor::start_values(problem))),
        poses(graph::pose_index(graph)),
        candidates(prune::candidate_edges(graph, poses, prune::Candidates::both)),
        choice{graph, poses, candidates, min_obs} {
    options.told = true;
    options.order = [](const graph::GraphPattern& part) {
      return order::elimination_order("wmf", part.pattern);
    };
  }
  World(const World&) = delete;
  std::vector<Move> moves() const { return prune::ecgreedy(choice, evidence, options); }
  // Up to this EC, and with what is better there.
  std::vector<Move> exchanged(std::vector<Move> moves, elim::Wide ec) const {
    prune::EcGreedyOptions bounded = options;
    bounded.ec = ec;
    moves.resize(prune::moves_within(choice, moves, ec, bounded));
    return prune::exchanged(choice, evidence, bounded, std::move(moves));
  }
};

// The information of all variables by the edges that are in, dense.
Eigen::MatrixXd dense_information(const prune::Evidence& evidence, const std::vector<bool>& edge) {
  const Index n = evidence.step_at.back();
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(n, n);
  for (Index r = 0; r < evidence.pattern.rows.size(); ++r) {
    if (r < static_cast<Index>(edge.size()) && !edge[r]) continue;
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(evidence.height[r], n);
    const double* column = evidence.block(r);
    for (const Index j : evidence.pattern.rows[r]) {
      for (int k = 0; k < evidence.pattern.dim[j]; ++k, column += evidence.height[r])
        a.col(evidence.step_at[j] + k) =
            Eigen::Map<const Eigen::VectorXd>(column, evidence.height[r]);
    }
    information += a.transpose() * a;
  }
  return information;
}

// Of the scalars of variables that are in.
Eigen::MatrixXd of_those_in(const prune::Evidence& evidence, const std::vector<bool>& vertex,
                            const Eigen::MatrixXd& information) {
  std::vector<Index> scalars;
  for (Index j = 0; j < evidence.pattern.variables(); ++j) {
    for (int k = 0; k < evidence.pattern.dim[j]; ++k) {
      if (vertex[evidence.variable_vertex[j]]) scalars.push_back(evidence.step_at[j] + k);
    }
  }
  return information(scalars, scalars);
}

// The sum of the variances of the poses' positions, as they are and after the rigid motion that fits them best, and their
// mean standard deviation.
struct Accuracy {
  double sum = 0, aligned = 0, mean_sigma = 0;
};
// x, y of every pose as the whole moves by a little: along x, along y, and turned.
Eigen::MatrixXd rigid_motions(const World& world) {
  const factor::Values values = factor::start_values(world.problem);
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(world.problem.step_at.back(), 3);
  for (const Index v : world.poses.pose) {
    const Index at = world.problem.step_at[world.problem.variables.vertex_variable[v]];
    const double* const x = values.data() + world.problem.value_at[v];
    result.middleRows(at, 2) << 1, 0, -x[1], 0, 1, x[0];
  }
  return result;
}
Accuracy dense_accuracy(const World& world, const prune::Selection& in) {
  Eigen::MatrixXd information = dense_information(world.evidence, in.edge);
  for (Index k = 0; k < information.rows(); ++k) {  // landmarks that are not in
    if (information(k, k) == 0) information(k, k) = 1;
  }
  const Eigen::MatrixXd covariance = information.inverse();
  Accuracy result;
  std::vector<Index> positions;
  for (const Index v : world.poses.pose) {
    const Index j = world.problem.variables.vertex_variable[v];
    if (j == world.problem.held) continue;
    const Index at = world.problem.step_at[j];
    const double variance = covariance(at, at) + covariance(at + 1, at + 1);
    positions.insert(positions.end(), {at, at + 1});
    result.sum += variance;
    result.mean_sigma += std::sqrt(variance) / static_cast<double>(world.poses.pose.size());
  }
  const Eigen::MatrixXd motions = rigid_motions(world);  // of held poses, too
  const Eigen::MatrixXd moved = motions(positions, Eigen::all);
  const Eigen::MatrixXd inner = moved.transpose() * covariance(positions, positions) * moved;
  result.aligned = result.sum - ((motions.transpose() * motions).inverse() * inner).trace();
  return result;
}

prune::Selection after(const World& world, std::span<const Move> moves) {
  return prune::selection(world.choice, prune::kept_by(world.candidates, moves));
}

bool determined(const Eigen::MatrixXd& information) {
  return Eigen::FullPivLU<Eigen::MatrixXd>(information).isInvertible();
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
    INFO("trial " << trial);
    REQUIRE(filled.ec == elim::elimination_complexity(pattern, order));
    for (int k = 0; k < 10; ++k) {
      std::vector<Index> factor;
      for (Index j = 0; j < n; ++j) {
        if (draw(random, 0, n) < 3) factor.push_back(j);
      }
      const elim::Wide before = filled.ec, promised = elim::increase(filled, factor);
      CHECK(filled.ec == before);
      pattern.rows.add(factor);
      CHECK(elim::add_factor(filled, factor) == promised);
      CHECK(filled.ec == elim::elimination_complexity(pattern, order));
      CHECK(filled.ec == before + promised);
      CHECK(elim::increase(filled, factor) == 0);
    }
  }
}

TEST_CASE("variables that are absent at first have no part in EC", "[ecgreedy]") {
  for (int trial = 0; trial < 100; ++trial) {
    Random random(trial);
    const int absent = draw(random, 1, 5), present = draw(random, 1, 12);
    graph::Pattern pattern = odd_pattern(random, present);
    graph::Pattern all;
    for (int k = 0; k < absent; ++k) all.dim.push_back(draw(random, 1, 3));
    all.dim.insert(all.dim.end(), pattern.dim.begin(), pattern.dim.end());
    for (Index r = 0; r < pattern.rows.size(); ++r) {
      std::vector<Index> row;
      for (const Index j : pattern.rows[r]) row.push_back(j + absent);
      all.rows.add(row);
    }
    graph::Order order(all.dim.size());
    std::iota(order.begin(), order.end(), 0);
    elim::FilledGraph filled = elim::filled_graph(elim::ordered(all, order), absent);
    elim::Wide still_absent = 0;
    for (int k = 0; k < absent; ++k) still_absent += elim::elimination_cost(all.dim[k], all.dim[k]);
    INFO("trial " << trial);
    CHECK(filled.ec + still_absent == elim::elimination_complexity(all, order));
    for (Index k = 0; k < absent; ++k) {
      std::vector<Index> factor{k};
      for (Index j = absent; j < absent + present; ++j) {
        if (draw(random, 0, 3) == 0) factor.push_back(j);
      }
      elim::add_factor(filled, factor);
      all.rows.add(factor);
      still_absent -= elim::elimination_cost(all.dim[k], all.dim[k]);
      CHECK(filled.ec + still_absent == elim::elimination_complexity(all, order));
    }
  }
}

TEST_CASE("gains and sigmas of moves are those of dense algebra", "[ecgreedy]") {
  std::ptrdiff_t drops = 0;
  for (int trial = 0; trial < 14; ++trial) {
    Random random(50 + trial);
    const int landmarks = trial % 3 == 0 ? 0 : draw(random, 1, 8);
    World world(random_text(random, draw(random, 8, 40), landmarks, draw(random, 2, 12)),
                1 + trial % 4);
    if (trial % 2 == 0) world.options.kept = static_cast<Index>(world.candidates.size() / 2);
    const bool aligned = trial % 4 > 1;
    if (aligned) world.options.gain = prune::GainKind::aligned;
    std::vector<Move> moves = world.moves();
    REQUIRE(!moves.empty());
    world.options.kept.reset();
    if (trial % 2 == 1) moves = world.exchanged(moves, (moves.front().ec + moves.back().ec) / 2);
    drops += std::ranges::count(moves, Move::Kind::drop, &Move::kind);
    if (const auto free = prune::free_edges(world.choice, world.evidence, moves, world.options)) {
      CHECK(free->ec == prune::ec_after(world.choice, moves, world.options));
      moves.push_back(*free);
    }
    Accuracy before;
    for (std::size_t k = 0; k < moves.size(); ++k) {
      const prune::Selection in = after(world, std::span(moves).first(k + 1));
      const Accuracy now = dense_accuracy(world, in);
      INFO("move " << k << " of trial " << trial);
      const double gain = aligned ? before.aligned - now.aligned : before.sum - now.sum;
      if (k > 0) CHECK(moves[k].gain == Approx(gain).epsilon(1e-6).margin(1e-9));
      CHECK(moves[k].sigma == Approx(now.mean_sigma));
      const std::vector<bool> kept =
          prune::kept_by(world.candidates, std::span(moves).first(k + 1));
      CHECK(moves[k].kept == std::count(kept.begin(), kept.end(), true));
      for (std::size_t i = 0; i < kept.size(); ++i) CHECK(in.edge[world.candidates[i]] == kept[i]);
      before = now;
    }
  }
  CHECK(drops > 0);
}

TEST_CASE("in one order, increases and drops add up to EC", "[ecgreedy]") {
  for (int trial = 0; trial < 6; ++trial) {
    Random random(300 + trial);
    World world(random_text(random, draw(random, 20, 40), 0, 20));
    world.options.order = [](const graph::GraphPattern& part) {  // no other, whatever is in
      graph::Order order(part.pattern.variables());
      std::iota(order.begin(), order.end(), 0);
      return order;
    };
    std::vector<Move> moves = world.moves();
    moves = world.exchanged(moves, (moves.front().ec + moves.back().ec) / 2);
    for (std::size_t k = 0; k < moves.size(); ++k) {
      INFO("move " << k << " of trial " << trial);
      CHECK(moves[k].ec ==
            prune::ec_after(world.choice, std::span(moves).first(k + 1), world.options));
      if (k > 0 && moves[k].kind != Move::Kind::drop)
        CHECK(moves[k].ec == moves[k - 1].ec + moves[k].increase);
    }
  }
}

TEST_CASE("what would be lost without a row is that of dense algebra", "[ecgreedy]") {
  double told = 0, lost = 0;
  for (int trial = 0; trial < 12; ++trial) {
    Random random(400 + trial);
    World world(random_text(random, 12, trial % 3 * 2, 10), 1);
    world.options.seed = trial;
    prune::Part part = prune::make_part(world.choice, world.evidence, world.options);
    const std::vector<bool> all(world.candidates.size(), true);
    prune::select(part, all);
    REQUIRE(prune::refactor(part).empty());
    const double whole = std::log(
        of_those_in(world.evidence, part.in.vertex, dense_information(world.evidence, part.in.edge))
            .determinant());
    const double sum = dense_accuracy(world, part.in).sum;
    for (const Index e : world.candidates) {
      if (!part.in.edge[e]) continue;
      prune::Selection less = part.in;
      less.edge[e] = false;
      const Eigen::MatrixXd rest =
          of_those_in(world.evidence, less.vertex, dense_information(world.evidence, less.edge));
      const prune::Gain loss = prune::estimated_loss(
          prune::try_measurement(part.knowledge, prune::measurement(world.evidence, e)));
      INFO("edge " << e << " of trial " << trial);
      CHECK(std::isfinite(loss.log_det) == determined(rest));
      if (!std::isfinite(loss.log_det)) continue;
      CHECK(loss.log_det ==
            Approx(whole - std::log(rest.determinant())).epsilon(1e-6).margin(1e-9));
      told += loss.trace;
      lost += dense_accuracy(world, less).sum - sum;
    }
  }
  CHECK(told == Approx(lost).epsilon(0.2));  // estimates, of many
}

TEST_CASE("an exchange stays within its budget and leaves more", "[ecgreedy]") {
  int better = 0;
  for (int trial = 0; trial < 10; ++trial) {
    Random random(500 + trial);
    World world(random_text(random, draw(random, 20, 40), trial % 2 * 8, draw(random, 10, 25)),
                1 + trial % 3);
    const std::vector<Move> moves = world.moves();
    const elim::Wide ec = (2 * moves.front().ec + moves.back().ec) / 3;
    const auto within = prune::moves_within(world.choice, moves, ec, world.options);
    const std::vector<Move> made = world.exchanged(moves, ec);
    INFO("trial " << trial);
    CHECK(prune::ec_after(world.choice, made, world.options) <= ec);
    const double before = dense_accuracy(world, after(world, std::span(moves).first(within))).sum;
    const prune::Selection in = after(world, made);
    const double now = dense_accuracy(world, in).sum;
    CHECK(now <= before * (1 + 1e-9));
    better += now < 0.999 * before;
    CHECK(determined(
        of_those_in(world.evidence, in.vertex, dense_information(world.evidence, in.edge))));
  }
  CHECK(better >= 5);
}

TEST_CASE("gains of log determinants are those of dense algebra", "[ecgreedy]") {
  for (int trial = 0; trial < 6; ++trial) {
    Random random(70 + trial);
    World world(random_text(random, draw(random, 8, 30), 0, draw(random, 4, 12)));
    world.options.gain = prune::GainKind::log_det;
    if (trial % 2 == 1) world.evidence = prune::tree_evidence(world.graph);
    const std::vector<Move> moves = world.moves();
    double before = 0;
    for (std::size_t k = 0; k < moves.size(); ++k) {
      const Eigen::MatrixXd information =
          dense_information(world.evidence, after(world, std::span(moves).first(k + 1)).edge);
      const double now = std::log(information.determinant());
      INFO("move " << k << " of trial " << trial);
      if (k > 0) CHECK(moves[k].gain == Approx(now - before).epsilon(1e-6).margin(1e-9));
      before = now;
    }
  }
}

TEST_CASE("tree evidence counts spanning trees", "[ecgreedy]") {
  // A ring of four poses with one chord: 8 trees.
  std::string ring;
  for (const char* ends : {"0 1", "1 2", "2 3", "3 0", "0 2"})
    ring += std::string("EDGE_SE2 ") + ends + " 1 0 0 1 0 0 1 0 1\n";
  const Graph graph = graph_of(ring);
  const prune::Evidence evidence = prune::tree_evidence(graph);
  CHECK(dense_information(evidence, std::vector<bool>(5, true)).determinant() == Approx(8));
}

TEST_CASE("what is in is always determined, and all that can come in does", "[ecgreedy]") {
  for (int trial = 0; trial < 12; ++trial) {
    Random random(90 + trial);
    World world(random_text(random, draw(random, 8, 24), draw(random, 0, 8), draw(random, 0, 8)),
                1 + trial % 3);
    const std::vector<Move> moves = world.moves();
    INFO("trial " << trial);
    REQUIRE(!moves.empty());
    for (std::size_t k = 0; k < moves.size(); ++k) {
      const prune::Selection in = after(world, std::span(moves).first(k + 1));
      CHECK(determined(
          of_those_in(world.evidence, in.vertex, dense_information(world.evidence, in.edge))));
    }
    // Landmarks that can be determined have all come back.
    const prune::Selection whole =
        prune::selection(world.choice, std::vector<bool>(world.candidates.size(), true));
    CHECK(after(world, moves).edge == whole.edge);
    CHECK(after(world, moves).vertex == whole.vertex);
  }
}

TEST_CASE("the same call makes the same moves, and budgets are kept", "[ecgreedy]") {
  Random random(3);
  World world(random_text(random, 40, 6, 20));
  const std::vector<Move> moves = world.moves(), again = world.moves();
  REQUIRE(moves.size() == again.size());
  for (std::size_t k = 0; k < moves.size(); ++k) {
    CHECK(moves[k].edges == again[k].edges);
    CHECK(moves[k].gain == again[k].gain);
    CHECK(moves[k].sigma == again[k].sigma);
  }
  world.options.told = false;
  const std::vector<Move> untold = world.moves();
  REQUIRE(untold.size() == moves.size());
  for (std::size_t k = 0; k < moves.size(); ++k) {
    CHECK(untold[k].edges == moves[k].edges);
    CHECK(untold[k].increase == moves[k].increase);
  }
  const elim::Wide middle = (moves.front().ec + moves.back().ec) / 2;
  const std::size_t count = prune::moves_within(world.choice, moves, middle, world.options);
  CHECK(count > 1);
  CHECK(count < moves.size());
  CHECK(prune::ec_after(world.choice, std::span(moves).first(count), world.options) <= middle);

  world.options.kept = 30;
  CHECK(world.moves().back().kept <= 30);
  CHECK(world.moves().back().kept >= 28);
  world.options.kept.reset();
  world.options.sigma = 1.1 * moves.back().sigma;
  const std::vector<Move> floor = world.moves();
  CHECK(floor.back().sigma <= *world.options.sigma);
  CHECK(floor[floor.size() - 2].sigma > *world.options.sigma);
  CHECK(prune::whole_sigma(world.choice, world.evidence, world.options).value() ==
        Approx(moves.back().sigma));
}

TEST_CASE("nothing is selected from what its edges do not determine", "[ecgreedy]") {
  const World world(
      "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 0\nVERTEX_XY 2 1 1\n"
      "EDGE_SE2_XY 0 2 1 1 1 0 1\nEDGE_SE2_XY 1 2 0 1 1 0 1\n");
  CHECK(world.moves().empty());
  CHECK(!prune::whole_sigma(world.choice, world.evidence, world.options).has_value());
}

namespace {

// The least sum of variances of any subset of the candidates within this EC: branch and bound. Candidates that are not
// decided yet tell something, if anything; and those that are in cost no less with others (Lemma 1), but for what a
// heuristic's orders are off by.
struct Best {
  const World& world;
  elim::Wide ec;
  double sum;  // of the best that is known
  std::vector<bool> kept = {};
  std::size_t visited = 0;

  prune::Selection with(std::size_t decided, bool others) const {
    std::vector<bool> all = kept;
    for (std::size_t i = decided; i < all.size(); ++i) all[i] = others;
    return prune::selection(world.choice, all);
  }
  elim::Wide ec_of(const prune::Selection& in) const {
    const graph::GraphPattern part = graph::graph_pattern(world.graph, in.vertex, in.edge);
    return elim::elimination_complexity(part.pattern, world.options.order(part));
  }
  void search() { visit(0, ec_of(with(0, false)), dense_accuracy(world, with(0, true)).sum); }
  // least: EC of those that are in; most: the sum with all that are not out. A candidate that is in leaves the one as it
  // was, one that is out the other.
  void visit(std::size_t decided, elim::Wide least, double most) {
    constexpr double off = 1.1;
    ++visited;
    if (elim::to_double(least) > off * elim::to_double(ec) || most >= sum * (1 - 1e-12)) return;
    if (decided == kept.size()) {
      if (least <= ec) sum = most;
      return;
    }
    kept[decided] = true;
    visit(decided + 1, ec_of(with(decided + 1, false)), most);
    kept[decided] = false;
    visit(decided + 1, least, dense_accuracy(world, with(decided + 1, true)).sum);
  }
};

}  // namespace

TEST_CASE("greedy and exchange are near the best of all subsets", "[ecgreedy]") {
  double greedy_share = 0, exchange_share = 0;
  int points = 0;
  for (int trial = 0; trial < 3; ++trial) {
    Random random(200 + trial);
    const World world(random_text(random, 16, 0, 20));
    const std::vector<Move> moves = world.moves();
    const double none = dense_accuracy(world, after(world, std::span(moves).first(1))).sum;
    for (const int third : {1, 2}) {
      const elim::Wide ec = moves.front().ec + (moves.back().ec - moves.front().ec) * third / 3;
      const auto within = prune::moves_within(world.choice, moves, ec, world.options);
      const double greedy = dense_accuracy(world, after(world, std::span(moves).first(within))).sum;
      const double exchanged = dense_accuracy(world, after(world, world.exchanged(moves, ec))).sum;
      Best best{world, ec, exchanged, std::vector<bool>(world.candidates.size(), false)};
      best.search();
      INFO("trial " << trial << ", budget " << third << ": " << best.visited << " visited");
      CHECK(none - exchanged > 0.9 * (none - best.sum));
      greedy_share += (none - greedy) / (none - best.sum);
      exchange_share += (none - exchanged) / (none - best.sum);
      ++points;
    }
  }
  INFO("mean share of the best fall of variance at equal EC: greedy "
       << greedy_share / points << ", exchanged " << exchange_share / points);
  CHECK(greedy_share / points > 0.99);
  CHECK(exchange_share / points > 0.99);
}
