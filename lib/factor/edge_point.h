// Points and pairs of points:  EDGE_PRIOR_XY, EDGE_POINTXYZ_PRIOR  e = l - z;
// EDGE_POINTXY, EDGE_POINTXYZ  e = (l_j - l_i) - z.
#pragma once

#include <algorithm>

#include "lib/factor/model.h"
#include "lib/geometry/numbers.h"

namespace sg::factor {

template <graph::EdgeTag type>
struct PointPrior : Registered<type> {
  static constexpr int dim = Registered<type>::dim;

  static void evaluate(const double* const* x, const double* c, double* e, double* const* J) {
    for (int k = 0; k < dim; ++k) e[k] = x[0][k] - c[k];
    if (J) Eigen::Map<Eigen::Matrix<double, dim, dim>>(J[0]).setIdentity();
  }
  static bool place(const double* const*, const double* c, int, double* out) {
    std::copy_n(c, dim, out);
    return true;
  }
};

template <graph::EdgeTag type>
struct PointPair : Registered<type> {
  static constexpr int dim = Registered<type>::dim;

  static void evaluate(const double* const* x, const double* c, double* e, double* const* J) {
    for (int k = 0; k < dim; ++k) e[k] = x[1][k] - x[0][k] - c[k];
    if (!J) return;
    using Square = Eigen::Matrix<double, dim, dim>;
    Eigen::Map<Square>{J[0]} = -Square::Identity();
    Eigen::Map<Square>{J[1]} = Square::Identity();
  }
  static bool place(const double* const* x, const double* c, int end, double* out) {
    for (int k = 0; k < dim; ++k) out[k] = end == 1 ? x[0][k] + c[k] : x[1][k] - c[k];
    return true;
  }
};

template <>
struct EdgeModel<graph::EdgeTag::prior_xy> : PointPrior<graph::EdgeTag::prior_xy> {};
template <>
struct EdgeModel<graph::EdgeTag::pointxyz_prior> : PointPrior<graph::EdgeTag::pointxyz_prior> {};
template <>
struct EdgeModel<graph::EdgeTag::pointxy> : PointPair<graph::EdgeTag::pointxy> {};
template <>
struct EdgeModel<graph::EdgeTag::pointxyz> : PointPair<graph::EdgeTag::pointxyz> {};

}  // namespace sg::factor
