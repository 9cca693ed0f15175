// The errors of recovered measurements. A measurement that says what its vertices' estimates say has none, and no
// gradient: the minimum of the whole would move. What the vertices' gradients lack is owed to them, and is brought by
// errors that are as small as they can be,
//     r_k = J_k x,    sum_k J_k' W_k J_k x = what is owed,
// over all that is recovered at once: what one piece owes to a vertex and another owes in return needs no error at all.
//
// The slopes of measurements depend on their errors, where these are large. Its slope with an error is M J_k, M a matrix that
// turns what is measured, since it still notices no motion of both its vertices. So each by itself is given the error
// M r_k and the information M^-T W_k M^-1: it pulls by J_k' W_k r_k, and knows J_k' W_k J_k, as without an error.
#pragma once

#include <span>

#include "lib/marginalize/measurement.h"

namespace sg::marginalize {

// Of measurements that say what the estimates say. owed: by scalar of all vertices' steps, one vertex behind the other. Of
// constants it does not matter.
void set_errors(const At& at, const Eigen::VectorXd& owed,
                std::span<Measurement* const> measurements);

// A measurement without an error: its slope in the steps of its vertices, and its information.
struct Spring {
  const Measurable& of;
  const Eigen::MatrixXd &slope, &information;
};
// Half of r_k' W_k r_k, nearly: what each would have of the graph's chi-square at the estimates.
std::vector<double> strains(const At& at, const Eigen::VectorXd& owed,
                            std::span<const Spring> springs);

}  // namespace sg::marginalize
