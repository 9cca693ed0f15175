// Measurements between the vertices that stay, fitted to what the whole graph knows, and not each blanket's to what it
// does.
//
// With S the covariance that the whole graph has of the vertices that stay, Q_0 the information of the edges that stay
// and Q = Q_0 + sum_k J_k' W_k J_k, twice the divergence of the whole is, but for what does not depend on the W_k,
//     sum_k tr(W_k A_k) - log det Q,      A_k = J_k S J_k'.
// It is convex in the W_k. A_k comes from one elimination of the whole graph, B_k = J_k Q^-1 J_k' and log det Q from one of
// what is left: nothing dense but cliques. Beside the others, what they know of the measurement being C_k = B_k^-1 - W_k,
// the best W_k is A_k^-1 - C_k without its negative part; all of them at once are a direction in which the divergence
// falls, since tr((A - B)(A^-1 - B^-1)) < 0, and a line is searched along it.
//
// So a measurement that is there is worth what would be lost without it, -(log det(I - W B) + tr(W A)) / 2, and one that is
// not what would be gained with it, the sum of (r - 1 - log r) / 2 over the eigenvalues r < 1 of B^-1 A; both exact
// where the others stay as they are.
#pragma once

#include <functional>
#include <optional>

#include "lib/factor/linearize.h"
#include "lib/marginalize/pass.h"
#include "lib/solve/eliminate.h"

namespace sg::marginalize {

// A measurement that could be taken.
struct Offer {
  Measurable of;
  Eigen::MatrixXd slope;        // J, in the steps of its vertices (measurement.h)
  Eigen::MatrixXd truth;        // A
  Eigen::MatrixXd information;  // W, where it is taken
  bool taken = false;
};

// A whole graph, and what of it stays. What is held where something has to be is the same in both.
struct Whole {
  const At& at;
  const std::vector<bool>& removed;
  const std::vector<bool>& edge_gone;
  factor::Problem problem;
  factor::LinearSystem edges;  // linearized
  Index held = -1;             // vertex

  Whole(const At& where, const std::vector<bool>& gone, const std::vector<bool>& edges_gone);
  Whole(const Whole&) = delete;
};

struct Offered {
  std::vector<Offer> offers;  // none of them taken
  double constant;            // what `fit` returns beyond the divergence, less
};
// Nothing where the graph leaves variables undetermined.
std::optional<Offered> offered(const Whole& whole, std::span<const Measurable> of);

// What is left with some of what is offered: a row for every edge that stays, for every offer, and for what is held.
struct Rest {
  graph::GraphPattern left;
  factor::LinearSystem rows;    // with the offers' whitened slopes
  factor::LinearSystem slopes;  // with their slopes, and zeros
  Index first = 0;              // row of the first offer
  solve::Elimination elimination;

  Rest(const Whole& whole, std::span<const Offer* const> offers,
       const std::function<graph::Order(const graph::Pattern&)>& order);
  Rest(const Rest&) = delete;
};

// Sets the informations of all that is taken to the best: until no more than about `gap` nats could be gained, or `steps`
// are done. order: of what is left (pattern_left). Returns the divergence but for a constant, in nats; nothing where what
// is taken leaves variables undetermined.
std::optional<double> fit(const Whole& whole, const graph::Order& order, double gap, int steps,
                          std::vector<Offer>& offers);

// What each is worth, in nats: infinite where nothing else would determine what it does. all: with all of them, in their
// order; it is planned once for all turns, as it does not depend on which of them are taken.
std::vector<double> worths(const std::vector<Offer>& offers, Rest& all);

// What is left with those that are taken.
graph::GraphPattern pattern_left(const Whole& whole, const std::vector<Offer>& offers);

}  // namespace sg::marginalize
