// The errors of recovered measurements. A measurement that says what its vertices' estimates say has none, and no
// gradient: the minimum of the whole would move. What the vertices' gradients lack is owed to them, and is brought by
// errors that are as small as they can be,
//     r_k = J_k x,    sum_k J_k' W_k J_k x = what is owed,
// over all that is recovered at once: what one piece owes to a vertex and another owes in return needs no error at all.
// The slopes of measurements depend on their errors; so x is refined until the gradient of the measurements as they will
// be read is what is owed, or where it cannot be, comes no nearer.
#pragma once

#include <span>

#include "lib/marginalize/measurement.h"

namespace sg::marginalize {

// owed: by scalar of all vertices' steps, one vertex behind the other. Of constants it does not matter. conservative: an
// error must not make a measurement know more; it knows less then.
void set_errors(const At& at, const Eigen::VectorXd& owed, bool conservative,
                std::span<Measurement* const> measurements);

}  // namespace sg::marginalize
