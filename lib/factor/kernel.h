// Robust kernels: rho(s) in place of s, the squared whitened error of a factor, and the weight
// rho'(s) by which its block is scaled (iteratively reweighted least squares). g2o's definitions,
// with width w:
//   huber    rho = s for s <= w^2, else 2 w sqrt(s) - w^2
//   cauchy   rho = w^2 log(1 + s / w^2)
// Source: Triggs et al., Bundle Adjustment: A Modern Synthesis (1999), section 4.3 (first-order
// weights).
#pragma once

#include <cmath>

namespace sg::factor {

enum class KernelShape { none, huber, cauchy };

struct Kernel {
  KernelShape shape = KernelShape::none;
  double width = 1;
};

inline double rho(const Kernel& kernel, double s) {
  const double w2 = kernel.width * kernel.width;
  switch (kernel.shape) {
    case KernelShape::huber:
      return s <= w2 ? s : 2 * kernel.width * std::sqrt(s) - w2;
    case KernelShape::cauchy:
      return w2 * std::log1p(s / w2);
    case KernelShape::none:
      break;
  }
  return s;
}

inline double weight(const Kernel& kernel, double s) {
  const double w2 = kernel.width * kernel.width;
  switch (kernel.shape) {
    case KernelShape::huber:
      return s <= w2 ? 1 : kernel.width / std::sqrt(s);
    case KernelShape::cauchy:
      return 1 / (1 + s / w2);
    case KernelShape::none:
      break;
  }
  return 1;
}

}  // namespace sg::factor
