// Robust kernels: rho(s) in place of s, the squared whitened error of a factor, and the weight
// rho'(s) by which its block is scaled (iteratively reweighted least squares). With width w, all
// begin as s does and bend at about w^2:
//   huber          rho = s for s <= w^2, else 2 w sqrt(s) - w^2
//   cauchy         rho = w^2 log(1 + s / w^2)
//   tukey          rho = w^2 / 3 (1 - (1 - s / w^2)^3) for s <= w^2, else w^2 / 3
//   geman-mcclure  rho = w^2 s / (w^2 + s)
//   dcs            rho = s for s <= w^2, else 3 w^2 - 4 w^4 / (w^2 + s)
// The first three are g2o's; the fourth is g2o's times w^2 for a delta of w^2; dynamic covariance scaling is g2o's for a
// delta (Phi) of w^2, where rho is what has its weight (2 w^2 / (w^2 + s))^2 for a slope. But for huber, an edge that is
// far off pulls the less the farther it is.
// Source: Triggs et al., Bundle Adjustment: A Modern Synthesis (1999), section 4.3 (first-order
// weights); Agarwal et al., Robust Map Optimization using Dynamic Covariance Scaling (2013).
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "lib/graph/lists.h"

namespace sg::factor {

struct KernelShape {
  std::string_view name;
  double (*rho)(double s, double width);
  double (*weight)(double s, double width);
};
std::span<const KernelShape> kernel_shapes();
const KernelShape* find_kernel_shape(std::string_view name);  // null where there is none

struct Kernel {
  const KernelShape* shape = nullptr;  // null: rho = s
  double width = 1;
};

inline double rho(const Kernel& kernel, double s) {
  return kernel.shape ? kernel.shape->rho(s, kernel.width) : s;
}
inline double weight(const Kernel& kernel, double s) {
  return kernel.shape ? kernel.shape->weight(s, kernel.width) : 1;
}

// What the edges of a graph count: share[e] rho(s), with the kernel where edge e is robust.
struct Loss {
  Kernel kernel = {};
  std::vector<bool> robust = {};   // m, or empty: all are
  std::vector<double> share = {};  // m, or empty: all 1
};

inline bool is_plain(const Loss& loss) {
  return !loss.kernel.shape && loss.share.empty();
}
inline Kernel kernel_of(const Loss& loss, Index e) {
  return loss.robust.empty() || loss.robust[e] ? loss.kernel : Kernel{};
}
inline double share_of(const Loss& loss, Index e) {
  return loss.share.empty() ? 1 : loss.share[e];
}
inline double rho(const Loss& loss, Index e, double s) {
  return share_of(loss, e) * rho(kernel_of(loss, e), s);
}
inline double weight(const Loss& loss, Index e, double s) {
  return share_of(loss, e) * weight(kernel_of(loss, e), s);
}

}  // namespace sg::factor
