// The paper's closed forms (Frey, Steiner, How, eq. 5 to 7): the elimination complexity of a
// landmark graph in which every pose observes every landmark, landmarks eliminated before poses,
// and of its prunings at a rate r.
//
// With X = d_x n_x the scalar dimension of all poses and L = d_l n_l that of all landmarks:
//   full        (L + X) X^2
//   keyframes   (L + X / r) (X / r)^2
//   decimation  (L + 9 X) (X / r)^2
// They are asymptotic. Exactly, a landmark costs d_l (d_l + X)^2, which the forms write as
// d_l X^2, while the clique of poses costs about X^3 / 3, which they write as X^3. So they bound
// the exact number from above as long as d_l L (2 X + d_l) is below 2/3 X^3 or so: unless landmarks
// outnumber poses by far.
#pragma once

#include "lib/graph/graph.h"

namespace sg::elim {

// Scalar dimensions: X and L. Only these products enter.
struct Sizes {
  double poses = 0;
  double landmarks = 0;
};
// Of a graph's vertices that are not fixed; vertices that are neither stay out.
Sizes sizes(const Graph& graph);

// The mean part of the poses that a landmark is seen from: 1 where the forms hold, 0 without landmarks.
// Below `least_sighted` they say nothing: EC then follows from how poses are joined, not from how many
// there are. (The paper's simulation has 0.11.)
double sighted(const Graph& graph);
constexpr double least_sighted = 0.05;

double predict_full(const Sizes& sizes);
double predict_keyframes(const Sizes& sizes, double rate);
double predict_decimation(const Sizes& sizes, double rate);

}  // namespace sg::elim
