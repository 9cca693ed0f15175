#include "lib/solve/marginals.h"

#include <Eigen/Dense>
#include <algorithm>
#include <numeric>

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

// The covariance of a clique's frontals, and theirs with the separator, from the separator's.
struct Below {
  MatrixXd frontal;  // S_ff
  MatrixXd cross;    // S_sf
};

Below below(const Front& front, const MatrixXd& separator) {
  const int f = front.f, s = front.s();
  Below result;
  const MatrixXd root =
      l11(front).triangularView<Eigen::Lower>().solve(MatrixXd::Identity(f, f));  // L11^-1
  result.frontal.noalias() = root.transpose() * root;
  if (s == 0) return result;
  const MatrixXd k = l21(front) * root;
  result.cross.noalias() = -separator * k;
  result.frontal.noalias() -= k.transpose() * result.cross;
  return result;
}

MatrixXd whole(const Below& below, const MatrixXd& separator) {
  const auto f = below.frontal.rows(), s = below.cross.rows();
  MatrixXd joint(f + s, f + s);
  joint.topLeftCorner(f, f) = below.frontal;
  if (s == 0) return joint;
  joint.bottomLeftCorner(s, f) = below.cross;
  joint.topRightCorner(f, s) = below.cross.transpose();
  joint.bottomRightCorner(s, s) = separator;
  return joint;
}

// Of the rows that these runs take a child's separator to; the last run ends with the right-hand side's.
MatrixXd gathered(const MatrixXd& joint, std::span<const Run> runs) {
  std::vector<int> row(rows_covered(runs));
  for (const Run& run : runs) std::iota(&row[run.from], &row[run.from] + run.length, run.to);
  row.pop_back();
  return joint(row, row);
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

}  // namespace

std::vector<MatrixXd> marginal_covariances(Elimination& e) {
  std::vector<MatrixXd> blocks(e.dim.size());
  std::vector<MatrixXd> separator(e.tree.cliques());  // of every clique that waits for its turn
  for (Index c = e.tree.cliques() - 1; c >= 0; --c) {
    const bool leaf = e.children[c].empty();
    if (leaf && e.tree.parent[c] >= 0) continue;  // with its parent, lest all leaves wait at once
    const MatrixXd joint = whole(below(e.front(c), separator[c]), separator[c]);
    separator[c].resize(0, 0);
    set_blocks(e, c, joint, blocks);
    for (Index i = e.children.begin[c]; i < e.children.begin[c + 1]; ++i) {
      const Index child = e.children.items[i];
      MatrixXd of_child = gathered(joint, e.child_runs[i]);
      if (e.children[child].empty()) {
        set_blocks(e, child, below(e.front(child), of_child).frontal, blocks);
      } else {
        separator[child] = std::move(of_child);
      }
    }
  }
  return blocks;
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
