// Measurements that are fitted and exchanged over a whole graph, against dense matrices.
#include "lib/marginalize/whole.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <limits>

#include "lib/marginalize/errors.h"
#include "lib/marginalize/exchange.h"
#include "lib/order/order.h"
#include "tests/unit/common.h"
#include "tests/unit/marginal_worlds.h"

using namespace sg;
using namespace sg::test;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// A graph without some of its vertices, what a tree leaves of it taken, and further pairs offered.
struct Case {
  Subject full;
  marginalize::At at = full.at();
  std::vector<bool> removed;
  marginalize::Draft trees;
  marginalize::Whole whole;
  marginalize::Offered offered;

  Case(const std::string& text, Random& random)
      : full(text),
        removed(some_vertices(random, full.graph)),
        trees(marginalize::one_pass(at, removed, {.clusters = marginalize::Clusters::global})),
        whole(at, removed, trees.edge_gone),
        offered(*marginalize::offered(whole, pairs(random))) {
    for (marginalize::Offer& offer : offered.offers) {
      for (const marginalize::Measurement& m : trees.measurements) {
        if (m.of.first != offer.of.first || m.of.second != offer.of.second) continue;
        offer.information =
            offer.taken ? MatrixXd(offer.information + m.information) : m.information;
        offer.taken = true;
      }
    }
  }

  // Each once, the trees' among them.
  std::vector<marginalize::Measurable> pairs(Random& random) const {
    std::vector<marginalize::Measurable> result;
    for (Index u = 0; u < full.graph.vertices(); ++u) {
      for (Index v = u + 1; v < full.graph.vertices(); ++v) {
        if (removed[u] || removed[v]) continue;
        const auto of = marginalize::between(at, u, v);
        const bool landmarks = full.graph.id[u] >= 100 && full.graph.id[v] >= 100;
        const bool of_tree =
            of && std::ranges::any_of(trees.measurements, [&](const marginalize::Measurement& m) {
              return m.of.first == of->first && m.of.second == of->second;
            });
        if (of && (of_tree || (!landmarks && draw(random, 0, 2) == 0))) result.push_back(*of);
      }
    }
    for (const marginalize::Measurement& m : trees.measurements) {
      if (m.of.second < 0) result.push_back(m.of);
    }
    return result;
  }
  // The scalars of what stays and is not held, in those of all.
  std::vector<int> scalars() const {
    std::vector<int> result;
    const std::vector<int> start = marginalize::starts_of_all(at);
    for (Index v = 0; v < full.graph.vertices(); ++v) {
      for (int i = start[v]; !removed[v] && v != whole.held && i < start[v + 1]; ++i)
        result.push_back(i);
    }
    return result;
  }
  // Of what is measured, in them.
  MatrixXd slope(const marginalize::Measurable& of) const {
    const std::vector<int> start = marginalize::starts_of_all(at);
    const MatrixXd own = marginalize::slope(at, of);
    MatrixXd J = MatrixXd::Zero(own.rows(), start.back());
    const int first = at.dim(of.first);
    J.middleCols(start[of.first], first) = own.leftCols(first);
    if (of.second >= 0)
      J.middleCols(start[of.second], own.cols() - first) = own.rightCols(own.cols() - first);
    return J(Eigen::all, scalars());
  }
  // What the whole graph knows of them.
  MatrixXd truth() const {
    const MatrixXd W = full.whole().information;
    const std::vector<int> start = marginalize::starts_of_all(at);
    std::vector<int> varies;
    for (Index v = 0; v < full.graph.vertices(); ++v) {
      for (int i = start[v]; v != whole.held && i < start[v + 1]; ++i) varies.push_back(i);
    }
    MatrixXd all = MatrixXd::Zero(W.rows(), W.cols());
    const MatrixXd own = W(varies, varies), S = own.inverse();
    all(varies, varies) = S;
    const std::vector<int> stay = scalars();
    return all(stay, stay);
  }
  // What is left with those that are taken.
  MatrixXd left(const std::vector<marginalize::Offer>& offers) const {
    MatrixXd Q = MatrixXd::Zero(full.whole().information.rows(), full.whole().information.rows());
    const std::vector<int> start = marginalize::starts_of_all(at);
    const auto add = [&](const marginalize::Piece& piece) {
      std::vector<int> place;
      for (const Index v : piece.vertices) {
        for (int i = start[v]; i < start[v + 1]; ++i) place.push_back(i);
      }
      Q(place, place) += piece.information;
    };
    for (Index e = 0; e < full.graph.edges(); ++e) {
      if (!trees.edge_gone[e]) add(marginalize::piece_of_edge(at, e));
    }
    for (const marginalize::Offer& offer : offers) {
      if (offer.taken)
        add(marginalize::piece_of(
            at, {offer.of, marginalize::measured(at, offer.of), offer.information}));
    }
    const std::vector<int> stay = scalars();
    return Q(stay, stay);
  }
  marginalize::Rest with_all() const {
    std::vector<const marginalize::Offer*> all;
    for (const marginalize::Offer& offer : offered.offers) all.push_back(&offer);
    return {whole, all,
            [](const graph::Pattern& p) { return sg::order::elimination_order("wmf", p); }};
  }
  double divergence(const std::vector<marginalize::Offer>& offers) const {
    const MatrixXd Q = left(offers), product = Q * truth();
    const double determinant = product.determinant();
    if (!(determinant > 1e-14)) return std::numeric_limits<double>::infinity();
    return (product.trace() - static_cast<double>(Q.rows()) - std::log(determinant)) / 2;
  }
};

std::vector<bool> taken_of(const std::vector<marginalize::Offer>& offers) {
  std::vector<bool> result;
  for (const marginalize::Offer& offer : offers) result.push_back(offer.taken);
  return result;
}

std::string text_of(Random& random, int seed) {
  return random_text(random, {.plane = seed % 2 == 0,
                              .poses = draw(random, 6, 10),
                              .closures = draw(random, 2, 10),
                              .landmarks = draw(random, 0, 3),
                              .anchored = seed % 4 == 0});
}

}  // namespace

TEST_CASE("what the whole graph knows of a pair, and the divergence, by dense inverses",
          "[marginalize]") {
  for (int seed = 0; seed < 24; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    Case test(text_of(random, seed), random);
    auto& offers = test.offered.offers;
    const double before = test.divergence(offers);
    const auto order =
        sg::order::elimination_order("wmf", marginalize::pattern_left(test.whole, offers).pattern);
    const auto lost = marginalize::fit(test.whole, order, 0, 0, offers);
    REQUIRE(lost);
    CHECK(*lost + test.offered.constant == Approx(before).epsilon(1e-7).margin(1e-8));

    const auto fitted = marginalize::fit(test.whole, order, 1e-9, 1000, offers);
    REQUIRE(fitted);
    CHECK(*fitted <= *lost + 1e-12);
    CHECK(*fitted + test.offered.constant ==
          Approx(test.divergence(offers)).epsilon(1e-7).margin(1e-8));
    // Nothing to gain in any direction: A - B >= 0, and 0 where there is information.
    for (const marginalize::Offer& offer : offers) {
      if (!offer.taken) continue;
      std::vector<marginalize::Offer> moved = offers;
      auto& W = moved[&offer - offers.data()].information;
      const auto d = W.rows();
      for (int k = 0; k < 4; ++k) {
        const VectorXd x = VectorXd::NullaryExpr(d, [&] { return uniform(random, -1, 1); });
        W = offer.information + 1e-3 * x * x.transpose() / x.dot(offer.truth * x);
        CHECK(test.divergence(moved) > test.divergence(offers) - 1e-6);
        W = 0.999 * offer.information;
        CHECK(test.divergence(moved) > test.divergence(offers) - 1e-6);
      }
    }
  }
}

TEST_CASE("a worth is what goes with a measurement, or comes with it", "[marginalize]") {
  int finite = 0, gained = 0;
  for (int seed = 0; seed < 24; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    Case test(text_of(random, seed), random);
    auto& offers = test.offered.offers;
    for (marginalize::Offer& offer : offers) {  // more than trees
      if (offer.taken || draw(random, 0, 2) > 0) continue;
      offer.taken = true;
      offer.information = offer.truth.inverse() / 3;
    }
    const double before = test.divergence(offers);
    marginalize::Rest all = test.with_all();
    const std::vector<double> worth = marginalize::worths(offers, all);
    {  // What is planned once is of any that are taken.
      std::vector<marginalize::Offer> others = offers;
      for (marginalize::Offer& offer : others) {
        if (offer.taken && draw(random, 0, 3) == 0) offer.taken = false;
      }
      marginalize::Rest fresh = test.with_all();
      CHECK(marginalize::worths(others, all) == marginalize::worths(others, fresh));
      CHECK(marginalize::worths(offers, all) == worth);
    }
    for (std::size_t k = 0; k < offers.size(); ++k) {
      std::vector<marginalize::Offer> other = offers;
      other[k].taken = !other[k].taken;
      if (offers[k].taken) {
        const double without = test.divergence(other);
        if (!(worth[k] < 8)) {
          CHECK(!(without < before + 7));
          continue;
        }
        CHECK(without - before == Approx(worth[k]).epsilon(1e-5).margin(1e-7));
        ++finite;
      } else {
        other[k].information = offers[k].truth.inverse();
        // The others as they are: all that stays fixed but one.
        std::vector<marginalize::Offer> one = other;
        double best = before;
        for (int step = 0; step < 200; ++step) {
          const MatrixXd J = test.slope(one[k].of),
                         B = J * test.left(one).inverse() * J.transpose();
          // W -> the geometric mean of A^-1 and W B W: no step goes up, whatever its start.
          const MatrixXd L = MatrixXd(one[k].truth.llt().matrixL()), back = L.inverse();
          const MatrixXd W = L.transpose() * one[k].information * L,
                         M = W * back * B * back.transpose() * W;
          const Eigen::SelfAdjointEigenSolver<MatrixXd> spectrum((M + M.transpose()) / 2);
          const MatrixXd root = spectrum.eigenvectors() *
                                spectrum.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal() *
                                spectrum.eigenvectors().transpose();
          one[k].information = back.transpose() * root * back;
          best = std::min(best, test.divergence(one));
        }
        CHECK(before - best <= worth[k] + 1e-6);
        CHECK(before - best >= 0.9 * worth[k] - 1e-3);
        gained += worth[k] > 0.01;
      }
    }
  }
  CHECK(finite > 20);
  CHECK(gained > 5);
}

TEST_CASE("measurements come and go, and every state is what it is said to be", "[marginalize]") {
  int changed = 0;
  for (int seed = 0; seed < 24; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    Case test(text_of(random, seed), random);
    auto& offers = test.offered.offers;
    const std::size_t before = std::ranges::count(offers, true, &marginalize::Offer::taken);
    const double rate = seed % 3 == 0 ? 1e-9 : seed % 3 == 1 ? 1e-4 : 1;
    double first = 0, least = std::numeric_limits<double>::infinity(), last = 0;
    int states = 0;
    marginalize::Exchange exchange{offers};
    const VectorXd none = VectorXd::Zero(test.trees.owed.size());
    bool settling = false;
    const auto see = [&](const marginalize::State& state) {
      // Every turn starts from the best, and makes the first of the moves that share no vertex.
      std::size_t moved = 0, apart = 0;
      for (std::size_t k = 0; k < exchange.best.size(); ++k)
        moved += state.offers[k].taken != exchange.best[k].taken;
      std::vector<bool> touched(test.full.graph.vertices(), false);
      for (const marginalize::Move& move : exchange.moves) {
        const auto ends = marginalize::ends_of(offers[move.offer].of);
        if (std::ranges::any_of(ends, [&](Index v) { return touched[v]; })) continue;
        for (const Index v : ends) touched[v] = true;
        ++apart;
      }
      CHECK(static_cast<double>(moved) ==
            (settling ? 0 : std::ceil(exchange.part * static_cast<double>(apart))));
      const graph::Pattern left = marginalize::pattern_left(test.whole, state.offers).pattern;
      CHECK(state.ec == elim::to_double(elim::elimination_complexity(
                            left, order::elimination_order("wmf", left))));
      CHECK(state.lost + test.offered.constant ==
            Approx(test.divergence(state.offers)).epsilon(1e-6).margin(1e-7));
      CHECK(std::isfinite(test.divergence(state.offers)));
      CHECK(state.strain == 0);
      last = state.lost + rate * state.ec;
      if (states++ == 0) first = last;
      least = std::min(least, last);
    };
    const marginalize::Terms terms{test.whole, none, rate, see};
    marginalize::Rest all = test.with_all();
    marginalize::advance(terms, 1, all, exchange);
    // Cut short, it has its best all the same.
    marginalize::Exchange cut = exchange;
    settling = true;
    marginalize::settle(terms, cut);
    CHECK(taken_of(cut.offers) == taken_of(exchange.best));
    settling = false;
    // In parts, as if nothing had been between them.
    marginalize::advance(terms, 1, all, exchange);
    marginalize::advance(terms, 13, all, exchange);
    const std::vector<bool> best = taken_of(exchange.best);
    settling = true;
    marginalize::settle(terms, exchange);
    CHECK(taken_of(exchange.offers) == best);
    offers = exchange.offers;
    REQUIRE(states > 0);
    CHECK(last <= least + 1e-9);
    CHECK(last <= first + 1e-9);
    const std::size_t after = std::ranges::count(offers, true, &marginalize::Offer::taken);
    changed += after != before;
    // What costs next to nothing comes; where EC is dear, no more stays than holds the graph together.
    if (rate < 1e-8) CHECK(after >= before);
    if (rate == 1) CHECK(after <= before);
  }
  CHECK(changed > 4);
}

TEST_CASE("errors bring what is owed, however large they have to be", "[marginalize]") {
  for (int seed = 0; seed < 24; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    const bool plane = seed % 2 == 0;
    const Subject full(
        random_text(random, {.plane = plane, .poses = 9, .closures = 0, .landmarks = 2}));
    const marginalize::At at = full.at();
    std::vector<marginalize::Measurement> all;
    const auto measure = [&](Index u, Index v) {
      const auto of = *marginalize::between(at, u, v);
      const auto d = marginalize::slope(at, of).rows();
      const MatrixXd root = MatrixXd::NullaryExpr(d, d, [&] { return uniform(random, -1, 1); }) +
                            2 * MatrixXd::Identity(d, d);
      all.push_back({of, marginalize::measured(at, of), root.transpose() * root});
    };
    for (Index v = 1; v < 9; ++v) measure(draw(random, 0, v - 1), v);
    measure(0, 5);
    measure(3, 9);
    measure(7, 10);
    const std::vector<int> start = marginalize::starts_of_all(at);
    // As errors of half a radian and a metre would be owed, were slopes the same.
    VectorXd owed = VectorXd::Zero(start.back());
    const double size = seed < 8 ? 0.01 : plane ? 0.6 : 0.25;
    for (const marginalize::Measurement& m : all) {
      const MatrixXd J = marginalize::slope(at, m.of);
      const VectorXd error =
          VectorXd::NullaryExpr(J.rows(), [&] { return uniform(random, -size, size); });
      const VectorXd force = J.transpose() * m.information * error;
      const int first = at.dim(m.of.first);
      owed.segment(start[m.of.first], first) += force.head(first);
      owed.segment(start[m.of.second], force.size() - first) += force.tail(force.size() - first);
    }
    std::vector<marginalize::Measurement*> pointers;
    for (marginalize::Measurement& m : all) pointers.push_back(&m);
    const auto known = [&] {
      MatrixXd sum = MatrixXd::Zero(owed.size(), owed.size());
      for (const marginalize::Measurement& m : all) {
        const marginalize::Piece piece = marginalize::piece_of(at, m);
        std::vector<int> place;
        for (const Index v : piece.vertices) {
          for (int i = start[v]; i < start[v + 1]; ++i) place.push_back(i);
        }
        sum(place, place) += piece.information;
      }
      return sum;
    };
    const MatrixXd before = known();
    // Of the errors J x, with x of all vertices but the first.
    const int rest = static_cast<int>(owed.size()) - at.dim(0);
    VectorXd x = VectorXd::Zero(owed.size());
    x.tail(rest) = before.bottomRightCorner(rest, rest).ldlt().solve(owed.tail(rest));
    std::vector<MatrixXd> slopes;
    for (const marginalize::Measurement& m : all) slopes.push_back(marginalize::slope(at, m.of));
    std::vector<marginalize::Spring> springs;
    for (std::size_t k = 0; k < all.size(); ++k)
      springs.push_back({all[k].of, slopes[k], all[k].information});
    const std::vector<double> strain = marginalize::strains(at, owed, springs);
    for (std::size_t k = 0; k < all.size(); ++k) {
      const int first = at.dim(all[k].of.first), second = at.dim(all[k].of.second);
      VectorXd own(first + second);
      own << x.segment(start[all[k].of.first], first), x.segment(start[all[k].of.second], second);
      const VectorXd error = slopes[k] * own;
      CHECK(strain[k] == Approx(error.dot(all[k].information * error) / 2).epsilon(1e-3));
    }
    marginalize::set_errors(at, owed, pointers);
    CHECK((known() - before).norm() < 1e-8 * before.norm());
    VectorXd given = VectorXd::Zero(owed.size());
    for (const marginalize::Measurement& m : all) {
      const marginalize::Piece piece = marginalize::piece_of(at, m);
      int row = 0;
      for (const Index v : piece.vertices) {
        given.segment(start[v], at.dim(v)) += piece.gradient.segment(row, at.dim(v));
        row += at.dim(v);
      }
    }
    CHECK((given - owed).norm() < 1e-8 * owed.norm());
  }
}
