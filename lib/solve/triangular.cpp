#include "lib/solve/triangular.h"

#include <Eigen/Dense>
#include <algorithm>
#include <numeric>

namespace sg::solve {
namespace {

using Piece = Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>;

Piece l11(const Front& front) {
  return {front.l, front.f, front.f, Eigen::OuterStride<>(front.ld_l())};
}

Piece l21(const Front& front) {
  return {front.l + front.f, front.s(), front.f, Eigen::OuterStride<>(front.ld_l())};
}

void solve_lower(const Triangle& t, Index c, RowsRef& x, Rows& above) {
  const Front front = t.elimination->front(c);
  auto frontal = x.middleRows(t.first_row[c], front.f);
  l11(front).triangularView<Eigen::Lower>().solveInPlace(frontal);
  const auto separator = t.separator_rows[c];
  if (separator.empty()) return;
  above.noalias() = l21(front) * frontal;
  for (std::size_t k = 0; k < separator.size(); ++k)
    x.row(separator[k]) -= above.row(static_cast<Eigen::Index>(k));
}

}  // namespace

Triangle triangle(Elimination& e) {
  Triangle t{&e, std::vector<Index>(e.dim.size()), {0}, {}};
  for (Index c = 0; c < e.tree.cliques(); ++c) {
    for (const Index j : e.tree.frontals[c]) t.clique[j] = c;
    t.first_row.push_back(t.first_row.back() + e.tree.frontal_dim[c]);
    for (const Index j : e.tree.separators[c]) {
      for (int k = 0; k < e.dim[j]; ++k) t.separator_rows.items.push_back(e.floor_at[j] + k);
    }
    t.separator_rows.close();
  }
  return t;
}

std::vector<Index> path(const Triangle& t, std::span<const Index> variables) {
  std::vector<Index> heads, result;
  for (const Index j : variables) heads.push_back(t.clique[j]);
  while (!heads.empty()) {
    const Index c = *std::ranges::min_element(heads);
    result.push_back(c);
    const Index above = t.elimination->tree.parent[c];
    std::erase(heads, c);
    if (above >= 0) heads.push_back(above);
  }
  return result;
}

void solve_lower(const Triangle& t, std::span<const Index> cliques, RowsRef x) {
  Rows above;
  for (const Index c : cliques) solve_lower(t, c, x, above);
}

void solve_lower(const Triangle& t, RowsRef x) {
  Rows above;
  for (Index c = 0; c < t.elimination->tree.cliques(); ++c) solve_lower(t, c, x, above);
}

void solve_upper(const Triangle& t, RowsRef x) {
  Rows above;
  for (Index c = t.elimination->tree.cliques() - 1; c >= 0; --c) {
    const Front front = t.elimination->front(c);
    auto frontal = x.middleRows(t.first_row[c], front.f);
    const auto separator = t.separator_rows[c];
    if (!separator.empty()) {
      above.resize(static_cast<Eigen::Index>(separator.size()), x.cols());
      for (std::size_t k = 0; k < separator.size(); ++k)
        above.row(static_cast<Eigen::Index>(k)) = x.row(separator[k]);
      frontal.noalias() -= l21(front).transpose() * above;
    }
    l11(front).transpose().triangularView<Eigen::Upper>().solveInPlace(frontal);
  }
}

}  // namespace sg::solve
