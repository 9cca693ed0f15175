// Square roots of information matrices.
#pragma once

#include <span>

namespace sg::factor {

// U (dim x dim, by column) with U' U = W, from W's upper triangle row by row, as the file format
// writes it. Cholesky's factor where W is positive definite; of a semidefinite W the spectral root. Diagonal where W is.
// False where W is indefinite.
bool whitening(std::span<const double> triangle, int dim, double* U);

}  // namespace sg::factor
