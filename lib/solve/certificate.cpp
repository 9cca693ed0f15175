#include "lib/solve/certificate.h"

#include <Spectra/SymEigsSolver.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "lib/factor/linearize.h"
#include "lib/geometry/numbers.h"
#include "lib/graph/components.h"
#include "lib/sparse/cholesky.h"
#include "lib/text/error.h"

namespace sg::solve {
namespace {

constexpr double isotropic_rounding = 1e-6;  // of information, beside its largest number
constexpr double first_shift = 1e-13,
                 largest_shift = 1e3;  // beside the largest number of the matrix
constexpr int krylov_dimension = 40;
constexpr int restarts = 1000;
constexpr double tolerance = 1e-10;

using Information = Eigen::MatrixXd;

// tau I and w I such that diag(tau I, w I) is a part of W.
struct Isotropic {
  double translation = 0;
  double rotation = 0;
  bool whole = false;
};

double least_eigenvalue(const Information& W) {
  return Eigen::SelfAdjointEigenSolver<Information>(W, Eigen::EigenvaluesOnly).eigenvalues()[0];
}

// turns: rows of rotation, the last ones.
Isotropic isotropic_part(const Information& W, int turns) {
  const auto moves = static_cast<int>(W.rows()) - turns;
  Isotropic part;
  part.translation = std::max(0.0, least_eigenvalue(W.topLeftCorner(moves, moves)));
  Eigen::VectorXd diagonal = Eigen::VectorXd::Constant(W.rows(), part.translation);
  if (turns > 0) {
    part.rotation = std::max(0.0, least_eigenvalue(W.bottomRightCorner(turns, turns)));
    diagonal.tail(turns).setConstant(part.rotation);
    // What couples the two may leave less of both.
    const Information cross = W.topRightCorner(moves, turns);
    if (cross.cwiseAbs().maxCoeff() > 0) {
      const double product = part.translation * part.rotation;
      const Eigen::VectorXd scale = diagonal.cwiseSqrt().cwiseInverse();
      const double share =
          product > 0
              ? std::clamp(least_eigenvalue(scale.asDiagonal() * W * scale.asDiagonal()), 0.0, 1.0)
              : 0;
      part.translation *= share;
      part.rotation *= share;
      diagonal *= share;
    }
  }
  const Information rest = W - Information(diagonal.asDiagonal());
  part.whole = rest.cwiseAbs().maxCoeff() <= isotropic_rounding * W.cwiseAbs().maxCoeff();
  return part;
}

Information information_of(const factor::Problem& problem, Index e) {
  const int dim = problem.model[e]->dim;
  const Eigen::Map<const Information> U(factor::whitening_of(problem, e).U, dim, dim);
  return U.transpose() * U;
}

// An edge's terms of f.
template <int d>
struct Term {
  Index i, j;  // vertices
  double kappa, tau;
  Eigen::Matrix<double, d, d> R;
  Eigen::Matrix<double, d, 1> t;
};

template <int d>
struct Synchronization {
  std::vector<Term<d>> terms;
  Index isotropic = 0, in_part = 0, left_out = 0;
};

template <int d>
bool has_term(graph::EdgeTag tag) {
  return d == 2 ? tag == graph::EdgeTag::se2 || tag == graph::EdgeTag::se2_xy
                : tag == graph::EdgeTag::se3;
}

template <int d>
void set_measurement(const double* c, graph::EdgeTag tag, Term<d>& term) {
  if constexpr (d == 3) {
    const SE3 z = geometry::se3(c);
    term.R = z.q.toRotationMatrix();
    term.t = z.t;
  } else {
    term.R = geometry::rotation(tag == graph::EdgeTag::se2 ? c[2] : 0);
    term.t = geometry::vector2(c);
  }
}

template <int d>
Synchronization<d> terms_of(const factor::Problem& problem) {
  Synchronization<d> sync;
  const Graph& graph = *problem.graph;
  constexpr double per_rotation = d == 3 ? 8 : 2;  // |R_j - R_i R_ij|^2 of |e_r|^2
  for (Index e = 0; e < graph.edges(); ++e) {
    const graph::EdgeTag tag = graph.edge_tag(e);
    const auto ends = graph.edge(e);
    if (!has_term<d>(tag) || ends[0] == ends[1]) {
      ++sync.left_out;
      continue;
    }
    const int turns = problem.model[e]->dim - d;
    const Isotropic part = isotropic_part(information_of(problem, e), turns);
    ++(part.whole ? sync.isotropic : sync.in_part);
    Term<d> term{ends[0], ends[1], part.rotation / per_rotation, part.translation, {}, {}};
    set_measurement<d>(factor::constants_of(problem, e), tag, term);
    sync.terms.push_back(term);
  }
  return sync;
}

// Scalars of M: d of a pose's rotation, pose by pose; then one of a vertex's position. Positions are relative to that of one
// vertex, the ground, of every part that tau connects: f does not notice where a part stands.
struct Layout {
  std::vector<int> rotation;  // n: first scalar, -1 of what has none
  std::vector<int> position;  // n: scalar, -1 of a ground
  std::vector<Index> ground;  // n
  int rotations = 0, scalars = 0;
};

template <int d>
Layout layout(const factor::Problem& problem, const std::vector<Term<d>>& terms) {
  const Index n = problem.graph->vertices();
  Layout result{std::vector<int>(n, -1), std::vector<int>(n, -1), std::vector<Index>(n)};
  std::vector<bool> used(n);
  graph::Lists<> links;
  for (const Term<d>& term : terms) {
    used[term.i] = used[term.j] = true;
    if (term.tau > 0) links.add(std::array{term.i, term.j});
  }
  for (Index v = 0; v < n; ++v) {
    if (!used[v] || problem.graph->role(v) != graph::Role::pose) continue;
    result.rotation[v] = result.scalars;
    result.scalars += d;
  }
  result.rotations = result.scalars;
  const graph::Components parts = graph::components(links, n);
  std::vector<Index> first(parts.count, -1);
  for (Index v = 0; v < n; ++v) {
    Index& ground = first[parts.of[v]];
    if (ground < 0) ground = v;
    if (ground != v) result.position[v] = result.scalars++;
    result.ground[v] = ground;
  }
  return result;
}

// M, in its lower triangle.
template <int d>
sparse::Triplets matrix(const std::vector<Term<d>>& terms, const Layout& at) {
  sparse::Triplets M;
  const auto add = [&](int row, int column, double x) {
    if (row >= 0 && column >= 0 && x != 0) M.add(std::max(row, column), std::min(row, column), x);
  };
  for (const auto& [i, j, kappa, tau, R, t] : terms) {
    const int a = at.rotation[i], b = at.rotation[j], p = at.position[i], q = at.position[j];
    for (int r = 0; r < d && kappa > 0; ++r) {
      add(a + r, a + r, kappa);
      add(b + r, b + r, kappa);
      for (int c = 0; c < d; ++c) add(a + r, b + c, -kappa * R(r, c));
    }
    // tau u u' of u = t_j - t_i - R_i t_ij.
    add(q, q, tau);
    add(p, p, tau);
    add(p, q, -tau);
    for (int r = 0; r < d; ++r) {
      add(q, a + r, -tau * t[r]);
      add(p, a + r, tau * t[r]);
      for (int c = 0; c <= r; ++c) add(a + r, a + c, tau * t[r] * t[c]);
    }
  }
  return M;
}

template <int d>
Eigen::Matrix<double, d, d> rotation_of(const double* x) {
  if constexpr (d == 3)
    return geometry::se3(x).q.toRotationMatrix();
  else
    return geometry::rotation(x[2]);
}

// X, d x scalars.
template <int d>
Eigen::MatrixXd stacked(const factor::Problem& problem, const factor::Values& values,
                        const Layout& at) {
  Eigen::MatrixXd X = Eigen::MatrixXd::Zero(d, at.scalars);
  const auto position = [&](Index v) {
    return Eigen::Map<const Eigen::Matrix<double, d, 1>>(values.data() + problem.value_at[v]);
  };
  for (Index v = 0; v < problem.graph->vertices(); ++v) {
    if (at.rotation[v] >= 0)
      X.middleCols(at.rotation[v], d) = rotation_of<d>(values.data() + problem.value_at[v]);
    if (at.position[v] >= 0) X.col(at.position[v]) = position(v) - position(at.ground[v]);
  }
  return X;
}

Eigen::MatrixXd product(const Eigen::MatrixXd& X, const sparse::Triplets& M) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(X.rows(), X.cols());
  for (std::size_t k = 0; k < M.value.size(); ++k) {
    const int i = M.row[k], j = M.column[k];
    result.col(j) += M.value[k] * X.col(i);
    if (i != j) result.col(i) += M.value[k] * X.col(j);
  }
  return result;
}

// Takes the blocks of L from M; their trace.
double subtract_multipliers(const Eigen::MatrixXd& X, int d, int rotations, sparse::Triplets& M) {
  const Eigen::MatrixXd XM = product(X, M);
  double trace = 0;
  for (int at = 0; at < rotations; at += d) {
    const Eigen::MatrixXd L = X.middleCols(at, d).transpose() * XM.middleCols(at, d);
    trace += L.trace();
    for (int r = 0; r < d; ++r) {
      for (int c = 0; c <= r; ++c) M.add(at + r, at + c, -(L(r, c) + L(c, r)) / 2);
    }
  }
  return trace;
}

// x -> (Q - L + shift I)^-1 x: the block of rotations of the inverse of M - L + shift (I of rotations).
struct ShiftedInverse {
  using Scalar = double;
  cholmod_factor& factor;
  sparse::Cholmod& session;
  int rotations;
  std::vector<double>& right;  // by scalar, 0 of positions

  Eigen::Index rows() const { return rotations; }
  Eigen::Index cols() const { return rotations; }
  void perform_op(const double* in, double* out) const {
    std::copy_n(in, rotations, right.begin());
    const sparse::CholmodDense x = sparse::solve(factor, right, session);
    std::copy_n(static_cast<const double*>(x->x), rotations, out);
  }
};

// The least eigenvalue of the Schur complement of S's positions. S is shifted until it is positive definite: then that
// eigenvalue, shifted, is the largest of the inverse, and Lanczos' iterations find it soon.
double least_eigenvalue(const sparse::Triplets& S, const Layout& at) {
  sparse::Cholmod session;
  session.common.supernodal = CHOLMOD_SUPERNODAL;
  session.common.quick_return_if_not_posdef = 1;
  double scale = 0;
  for (const double x : S.value) scale = std::max(scale, std::abs(x));
  for (double shift = first_shift * scale; shift < largest_shift * scale; shift *= 10) {
    sparse::Triplets shifted = S;
    for (int k = 0; k < at.rotations; ++k) shifted.add(k, k, shift);
    const sparse::CholmodSparse A = sparse::sparse_matrix(at.scalars, shifted, session);
    const sparse::CholmodFactor factor = sparse::analyze(*A, CHOLMOD_AMD, session);
    if (!sparse::factorize(*A, *factor, session)) continue;
    std::vector<double> right(at.scalars);
    ShiftedInverse inverse{*factor, session, at.rotations, right};
    Spectra::SymEigsSolver<ShiftedInverse> solver(inverse, 1,
                                                  std::min(krylov_dimension, at.rotations));
    solver.init();
    solver.compute(Spectra::SortRule::LargestAlge, restarts, tolerance);
    if (solver.info() != Spectra::CompInfo::Successful) break;
    return 1 / solver.eigenvalues()[0] - shift;
  }
  throw text::computation_error("the iteration for the certificate's eigenvalue does not converge");
}

template <int d>
Certificate certified(const factor::Problem& problem, const factor::Values& values) {
  const Synchronization<d> sync = terms_of<d>(problem);
  const Layout at = layout<d>(problem, sync.terms);
  if (at.rotations == 0) {
    std::string types;
    for (const auto tag : {graph::EdgeTag::se2, graph::EdgeTag::se2_xy, graph::EdgeTag::se3})
      types += (types.empty() ? "" : ", ") + std::string(graph::name(tag));
    throw text::input_error(problem.graph->file, 0,
                            "no edge is of a type that a certificate speaks of (" + types + ")");
  }
  sparse::Triplets S = matrix<d>(sync.terms, at);
  const double trace = subtract_multipliers(stacked<d>(problem, values, at), d, at.rotations, S);
  const double eigenvalue = least_eigenvalue(S, at);
  return {.chi2 = factor::finite_chi2(problem, values),
          .bound = std::max(0.0, trace + std::min(eigenvalue, 0.0) * at.rotations),
          .eigenvalue = eigenvalue,
          .isotropic = sync.isotropic,
          .in_part = sync.in_part,
          .left_out = sync.left_out};
}

}  // namespace

bool is_certified(const Certificate& certificate) {
  return certificate.chi2 - certificate.bound <= certified_gap * std::max(1.0, certificate.chi2);
}

Certificate certify(const factor::Problem& problem, const factor::Values& values) {
  const bool in_space = std::ranges::any_of(
      problem.space, [](graph::Space space) { return space == graph::Space::se3; });
  return in_space ? certified<3>(problem, values) : certified<2>(problem, values);
}

}  // namespace sg::solve
