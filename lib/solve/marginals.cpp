#include "lib/solve/marginals.h"

#include <Eigen/Dense>
#include <algorithm>
#include <numeric>
#include <utility>

#include "lib/order/order.h"
#include "lib/solve/assembly.h"

namespace sg::solve {
namespace {

using Eigen::MatrixXd;
using Piece = Eigen::Map<const MatrixXd, 0, Eigen::OuterStride<>>;

Piece l11(const Front& front) {
  return {front.l, front.f, front.f, Eigen::OuterStride<>(front.ld_l())};
}

Piece l21(const Front& front) {
  return {front.l + front.f, front.s(), front.f, Eigen::OuterStride<>(front.ld_l())};
}

// A matrix as kernels want it: rows that mean nothing behind the last one, up to a lane.
struct Padded {
  int rows = 0;
  MatrixXd numbers;

  int columns() const { return static_cast<int>(numbers.cols()); }
  int ld() const { return static_cast<int>(numbers.rows()); }
  auto view() { return numbers.topRows(rows); }
  auto view() const { return numbers.topRows(rows); }
};

Padded padded(int rows, int columns) {
  return {rows, MatrixXd(round_up(rows), columns)};
}

Padded transposed(const Padded& matrix) {
  Padded result = padded(matrix.columns(), matrix.rows);
  result.view() = matrix.view().transpose();
  return result;
}

// -a b'
Padded negative_product(const Padded& a, const Padded& b) {
  Padded c = padded(a.rows, b.rows);
  kernels().negative_product(c.numbers.data(), c.ld(), a.numbers.data(), a.ld(), b.numbers.data(),
                             b.ld(), a.rows, b.rows, a.columns());
  return c;
}

// What a clique's frontals have, from their separator's covariance.
struct Below {
  MatrixXd frontal;  // S_ff
  Padded cross;      // -S_sf
};

Below below(const Front& front, const Padded& separator) {
  const int f = front.f, s = front.s();
  Padded root = padded(f, f);  // L11^-T
  kernels().invert(front, root.numbers.data());
  Below result;
  result.frontal = -negative_product(root, root).view();
  if (s == 0) return result;
  Padded k = padded(s, f);  // -K
  kernels().negative_product(k.numbers.data(), k.ld(), front.l + f, front.ld_l(),
                             root.numbers.data(), root.ld(), s, f, f);
  const Padded kt = transposed(k);
  result.cross = negative_product(separator, kt);
  result.frontal += negative_product(kt, transposed(result.cross)).view();
  return result;
}

Padded whole(const Below& below, const Padded& separator) {
  const auto f = static_cast<int>(below.frontal.rows()), s = separator.rows;
  Padded joint = padded(f + s, f + s);
  joint.view().topLeftCorner(f, f) = below.frontal;
  if (s == 0) return joint;
  joint.view().bottomLeftCorner(s, f) = -below.cross.view();
  joint.view().topRightCorner(f, s) = -below.cross.view().transpose();
  joint.view().bottomRightCorner(s, s) = separator.view();
  return joint;
}

// Of the rows that these runs take a child's separator to; the last run ends with the right-hand side's.
Padded gathered(const Padded& joint, std::span<const Run> runs) {
  const int s = rows_covered(runs) - 1;
  Padded result = padded(s, s);
  for (const Run& columns : runs) {
    const int width = std::min(columns.length, s - columns.from);
    for (const Run& rows : runs) {
      const int height = std::min(rows.length, s - rows.from);
      result.numbers.block(rows.from, columns.from, height, width) =
          joint.numbers.block(rows.to, columns.to, height, width);
    }
  }
  return result;
}

void set_blocks(const Elimination& e, Index c, const MatrixXd& frontal,
                std::vector<MatrixXd>& blocks) {
  int row = 0;
  for (const Index j : e.tree.frontals[c]) {
    blocks[j] = frontal.block(row, row, e.dim[j], e.dim[j]);
    row += e.dim[j];
  }
}

// The cliques on the ways from some variables to their roots, in elimination order.
std::vector<Index> path(const CliqueTree& tree, std::span<const Index> variables) {
  std::vector<bool> on(tree.cliques(), false);
  for (Index c = 0; c < tree.cliques(); ++c) {
    for (const Index j : tree.frontals[c]) on[c] = on[c] || std::ranges::count(variables, j) > 0;
    if (on[c] && tree.parent[c] >= 0) on[tree.parent[c]] = true;
  }
  std::vector<Index> result;
  for (Index c = 0; c < tree.cliques(); ++c) {
    if (on[c]) result.push_back(c);
  }
  return result;
}

// Calls visit(row, scalar, dim) for some variables: their rows one below the other, and in all of a step.
void each_row(const Elimination& e, std::span<const Index> variables, const auto& visit) {
  int row = 0;
  for (const Index j : variables) {
    visit(row, e.step_at[j], e.dim[j]);
    row += e.dim[j];
  }
}

// Calls visit(c, below, separator's covariance) for every clique, parents before children.
void each_clique(Elimination& e, const auto& visit) {
  std::vector<Padded> separator(e.tree.cliques());  // of every clique that waits for its turn
  for (Index c = e.tree.cliques() - 1; c >= 0; --c) {
    const bool leaf = e.children[c].empty();
    if (leaf && e.tree.parent[c] >= 0) continue;  // with its parent, lest all leaves wait at once
    const Padded above = std::exchange(separator[c], {});
    const Below here = below(e.front(c), above);
    visit(c, here, above);
    if (leaf) continue;
    const Padded joint = whole(here, above);
    for (Index i = e.children.begin[c]; i < e.children.begin[c + 1]; ++i) {
      const Index child = e.children.items[i];
      Padded of_child = gathered(joint, e.child_runs[i]);
      if (e.children[child].empty()) {
        visit(child, below(e.front(child), of_child), of_child);
      } else {
        separator[child] = std::move(of_child);
      }
    }
  }
}

// Where the columns of a row, without its right-hand side, are in the front of its clique.
std::vector<int> places(std::span<const Run> runs) {
  std::vector<int> result(rows_covered(runs));
  for (const Run& run : runs)
    std::iota(result.begin() + run.from, result.begin() + run.from + run.length, run.to);
  result.pop_back();
  return result;
}

// Calls visit(r, A_r, covariance of its variables) for every row of the system that is not zero.
void each_row_block(Elimination& e, const factor::LinearSystem& system, const auto& visit) {
  each_clique(e, [&](Index c, const Below& here, const Padded& above) {
    MatrixXd joint;
    for (Index i = e.rows.begin[c]; i < e.rows.begin[c + 1]; ++i) {
      const Index r = e.rows.items[i];
      const std::span block(system.block(r), system.block(r + 1));
      if (std::ranges::all_of(block, [](double x) { return x == 0; })) continue;
      if (joint.size() == 0) joint = whole(here, above).view();
      const std::vector<int> at = places(e.row_runs[i]);
      const Eigen::Map<const MatrixXd> A(block.data(), system.height[r],
                                         static_cast<Eigen::Index>(at.size()));
      visit(r, A, joint(at, at));
    }
  });
}

}  // namespace

std::vector<MatrixXd> marginal_covariances(Elimination& e) {
  std::vector<MatrixXd> blocks(e.dim.size());
  each_clique(e, [&](Index c, const Below& here, const Padded&) {
    set_blocks(e, c, here.frontal, blocks);
  });
  return blocks;
}

std::vector<double> row_variances(Elimination& e, const factor::LinearSystem& system) {
  std::vector<double> result(system.height.size(), 0);
  each_row_block(e, system, [&](Index r, const auto& A, const MatrixXd& S) {
    result[r] = (A * S).cwiseProduct(A).sum();
  });
  return result;
}

std::vector<MatrixXd> row_covariances(Elimination& e, const factor::LinearSystem& system) {
  std::vector<MatrixXd> result(system.height.size());
  each_row_block(e, system, [&](Index r, const auto& A, const MatrixXd& S) {
    result[r] = A * S * A.transpose();
  });
  return result;
}

std::optional<double> log_determinant_given_others(const factor::LinearSystem& system,
                                                   const std::vector<bool>& some) {
  const graph::Pattern& whole = *system.pattern;
  std::vector<Index> number(whole.variables(), -1);
  graph::Pattern rest;
  for (Index j = 0; j < whole.variables(); ++j) {
    if (!some[j]) continue;
    number[j] = rest.variables();
    rest.dim.push_back(whole.dim[j]);
  }
  if (rest.dim.empty()) return 0;
  factor::LinearSystem part{&rest, {}, {0}, {}};
  for (Index r = 0; r < whole.rows.size(); ++r) {
    const double* block = system.block(r);
    for (const Index j : whole.rows[r]) {
      const int size = system.height[r] * whole.dim[j];
      if (number[j] >= 0) {
        rest.rows.items.push_back(number[j]);
        part.numbers.insert(part.numbers.end(), block, block + size);
      }
      block += size;
    }
    part.numbers.insert(part.numbers.end(), block, block + system.height[r]);
    rest.rows.close();
    part.height.push_back(system.height[r]);
    part.begin.push_back(static_cast<Offset>(part.numbers.size()));
  }
  auto elimination = eliminated(part, order::elimination_order("wmf", rest));
  if (!elimination) return std::nullopt;
  return log_determinant(*elimination);
}

void solve_normal_equations(Elimination& e, Eigen::VectorXd& x) {
  const auto gather = [&](std::span<const Index> variables, int dim) {
    Eigen::VectorXd part(dim);
    each_row(e, variables,
             [&](int row, Index at, int size) { part.segment(row, size) = x.segment(at, size); });
    return part;
  };
  const auto scatter = [&](std::span<const Index> variables, const Eigen::VectorXd& part) {
    each_row(e, variables,
             [&](int row, Index at, int size) { x.segment(at, size) = part.segment(row, size); });
  };
  for (Index c = 0; c < e.tree.cliques(); ++c) {
    const Front front = e.front(c);
    Eigen::VectorXd frontal = gather(e.tree.frontals[c], front.f);
    l11(front).triangularView<Eigen::Lower>().solveInPlace(frontal);
    scatter(e.tree.frontals[c], frontal);
    scatter(e.tree.separators[c], gather(e.tree.separators[c], front.s()) - l21(front) * frontal);
  }
  for (Index c = e.tree.cliques() - 1; c >= 0; --c) {
    const Front front = e.front(c);
    Eigen::VectorXd frontal = gather(e.tree.frontals[c], front.f);
    frontal -= l21(front).transpose() * gather(e.tree.separators[c], front.s());
    l11(front).transpose().triangularView<Eigen::Upper>().solveInPlace(frontal);
    scatter(e.tree.frontals[c], frontal);
  }
}

MatrixXd joint_covariance(Elimination& e, std::span<const Index> variables) {
  int width = 0;
  for (const Index j : variables) width += e.dim[j];
  MatrixXd x = MatrixXd::Zero(e.step_at.back(), width);
  each_row(e, variables,
           [&](int row, Index at, int dim) { x.block(at, row, dim, dim).setIdentity(); });
  MatrixXd joint = MatrixXd::Zero(width, width);
  for (const Index c : path(e.tree, variables)) {
    const Front front = e.front(c);
    MatrixXd frontal(front.f, width);
    each_row(e, e.tree.frontals[c], [&](int row, Index at, int dim) {
      frontal.middleRows(row, dim) = x.middleRows(at, dim);
    });
    l11(front).triangularView<Eigen::Lower>().solveInPlace(frontal);
    joint.noalias() += frontal.transpose() * frontal;
    if (front.s() == 0) continue;
    const MatrixXd known = l21(front) * frontal;
    each_row(e, e.tree.separators[c], [&](int row, Index at, int dim) {
      x.middleRows(at, dim) -= known.middleRows(row, dim);
    });
  }
  return joint;
}

}  // namespace sg::solve
