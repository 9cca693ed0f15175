// QR factorization of a linearized system whose columns are scaled to unit length: what elimination of the normal
// equations is checked by, and replaced where it loses the digits that count.
#pragma once

#include <span>
#include <vector>

#include "lib/factor/linearize.h"
#include "lib/sparse/qr.h"

namespace sg::solve {

// A column of unit length that stands out of the others by no more than this is taken for one that depends on them.
// Rounding leaves 1e-15 or so of those that do; the far end of a chain of 200,000 poses stands out by 1e-8.
constexpr double dependent = 1e-10;

struct ScaledQr {
  sparse::Qr qr;
  std::vector<double>
      length;  // of A's columns, by scalar of a step; 1 for one that nothing measures
};

// damping: what is added to the diagonal of A' A, by scalar of a step; empty for nothing.
ScaledQr scaled_qr(const factor::LinearSystem& system, std::span<const double> damping = {});

}  // namespace sg::solve
