// What measurements would add to what a graph knows of its poses' positions.
//
// S is the covariance (inverse information) of the rows that are in. Rows with the whitened Jacobian J, added to them,
// make the sum of the variances of all poses' positions fall by
//     tr[ (I + C)^-1  J S P'P S J' ],       C = J S J',
// P picking the positions, and the log determinant of the information grow by log det(I + C).
//
// With the factor L L' = S^-1, a measurement's root is U = L^-1 J', zero off its path in the tree; C = U' U. What is
// added to the factored rows is kept beside it: with the roots of what was added and its own, a measurement is
// conditioned on that by block Cholesky steps of I + C over all of them,
//     Z_i = L_ii^-1 (U_i' U - sum over p < i of Z_ip' Z_p),  C -= Z_i' Z_i,  L_ii L_ii' = I + C_ii,
// so that trying one costs a solve along its path and products with what was added. The trace needs J S P': from k random
// sign vectors, Y = S P' z, (J Y)(J Y)' / k estimates J S P'P S J' (Hutchinson 1990), conditioned alike. A first guess of
// C, before the root is computed, is (J X)(J X)' / k with X = L'^-1 z.
//
// Aligned, positions are judged as after the rigid motion that fits the whole best: P' P gives way to P' (I - D D') P, D an
// orthonormal basis of what rigid motions do to the positions. The sign vectors lose their part in D.
//
// A measurement that is in takes with it, when it goes,
//     tr[ (I - C)^-1  J S P'P S J' ].
#pragma once

#include <boost/random/mersenne_twister.hpp>
#include <cstdint>
#include <vector>

#include "lib/prune/evidence.h"
#include "lib/prune/selection.h"
#include "lib/solve/triangular.h"

namespace sg::prune {

constexpr int draws = 32;
using Draws = Eigen::Matrix<double, Eigen::Dynamic, draws, Eigen::RowMajor>;

// Some rows as one measurement of `variables`.
struct Measurement {
  std::vector<Index> variables;
  Eigen::MatrixXd jacobian;  // whitened, columns of the variables one after the other
};

struct Gain {
  double trace;    // by which the sum of the positions' variances falls
  double log_det;  // by which that of the information grows
};

// A measurement in the light of what was added. Where a stride is wanted, columns are padded to whole lanes.
struct Tried {
  std::vector<Index> path;  // cliques
  Eigen::MatrixXd
      root;  // U, on the path: rows of all its cliques, then zeros, a lane less one or more
  solve::Rows covariance;  // C
  Draws y;                 // J Y
  solve::Rows shared;      // Z, below each other
  std::size_t known = 0;   // of what was added: as far as it is conditioned

  int height() const { return static_cast<int>(y.rows()); }
};

struct Knowledge {
  const Evidence& evidence;
  bool aligned;
  boost::random::mt19937 bits;

  graph::Pattern pattern;         // of the rows that are in; variables that are not stand still
  factor::LinearSystem selected;  // their blocks
  solve::Elimination factor;
  solve::Triangle triangle;
  Draws x, y;                    // in elimination order
  Eigen::MatrixXd drift;         // likewise; no columns unless aligned
  std::vector<double> variance;  // by variable: of its position; 0 of what is no pose

  struct Added {
    std::vector<Index> path;
    Eigen::MatrixXd root;
    Index at, height;  // its rows in all that was added
  };
  std::vector<Added> added;  // since the factor
  Index added_rows = 0;
  Eigen::MatrixXd l;  // of I + C over all that was added, below the diagonal; it may be larger
  Draws added_y;      // l^-1 J Y; it may be longer
  std::vector<double> work;  // zeros between calls
};

Knowledge start_knowledge(const Evidence& evidence, bool aligned, std::uint64_t seed);

// Factors the rows that are in (the gauge's always are), variables that are not standing still, in this order of all
// variables; draws anew. Returns the variables that are left undetermined, ascending: then nothing else is
// of use. Variances stay as they are.
std::vector<Index> refactor(Knowledge& knowledge, const Selection& in, const graph::Order& order);
// Variances of the factored rows, by selected inversion.
void take_variances(Knowledge& knowledge);

// Row r as a measurement.
Measurement measurement(const Evidence& evidence, Index r);
// Several rows that hold a variable nothing else does, with that variable eliminated from them: what they say of the
// others. Nothing (no variables) where they do not determine it.
Measurement without(const Evidence& evidence, std::span<const Index> rows, Index variable);

// As of the factored rows alone.
Gain guessed_gain(const Knowledge& knowledge, const Measurement& measurement);

Tried try_measurement(Knowledge& knowledge, const Measurement& measurement);
void update(const Knowledge& knowledge, Tried& tried);
// The trace estimated, the log determinant exact.
Gain estimated_gain(const Tried& tried);
// By how much both would fall without this measurement, which is one of the factored rows, nothing having been added;
// infinite where it is needed.
Gain estimated_loss(const Tried& tried);
// Adds one that is up to date.
void add(Knowledge& knowledge, Tried tried);

// Mean standard deviation of a pose's position over all of the graph's poses; constants have none.
double mean_sigma(const Knowledge& knowledge);
// The sum of the variances of the factored rows, as they were taken; aligned, less what moves the whole.
double total_variance(const Knowledge& knowledge);

}  // namespace sg::prune
