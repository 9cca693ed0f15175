#include "lib/solve/triangular.h"

#include <algorithm>
#include <cassert>

namespace sg::solve {
namespace {

int stride(const RowsRef& x) {
  assert(x.outerStride() % lane == 0 && x.outerStride() >= round_up(static_cast<int>(x.cols())));
  return static_cast<int>(x.outerStride());
}

// As many rows as the largest separator has, of a matrix like x.
Rows separator_like(const Triangle& t, const RowsRef& x) {
  return {t.most_separator_rows, stride(x)};
}

void solve_lower(const Triangle& t, Index c, RowsRef& x, Rows& above) {
  const Front front = t.elimination->front(c);
  const auto columns = static_cast<int>(x.cols());
  double* const frontal = x.row(t.first_row[c]).data();
  kernels().solve_lower(front.l, front.ld_l(), frontal, stride(x), 0, front.f, columns);
  const auto separator = t.separator_rows[c];
  kernels().negative_product(above.data(), stride(x), frontal, stride(x), front.l + front.f,
                             front.ld_l(), columns, front.s(), front.f);
  for (std::size_t k = 0; k < separator.size(); ++k)
    x.row(separator[k]) += above.row(static_cast<Eigen::Index>(k)).head(columns);
}

}  // namespace

Triangle triangle(Elimination& e) {
  Triangle t{&e, std::vector<Index>(e.dim.size()), {0}, {}, 0};
  for (Index c = 0; c < e.tree.cliques(); ++c) {
    for (const Index j : e.tree.frontals[c]) t.clique[j] = c;
    t.first_row.push_back(t.first_row.back() + e.tree.frontal_dim[c]);
    for (const Index j : e.tree.separators[c]) {
      for (int k = 0; k < e.dim[j]; ++k) t.separator_rows.items.push_back(e.floor_at[j] + k);
    }
    t.separator_rows.close();
    t.most_separator_rows = std::max(t.most_separator_rows, e.tree.separator_dim[c]);
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
  Rows above = separator_like(t, x);
  for (const Index c : cliques) solve_lower(t, c, x, above);
}

void solve_lower(const Triangle& t, RowsRef x) {
  Rows above = separator_like(t, x);
  for (Index c = 0; c < t.elimination->tree.cliques(); ++c) solve_lower(t, c, x, above);
}

void solve_upper(const Triangle& t, RowsRef x) {
  Rows above = separator_like(t, x);
  for (Index c = t.elimination->tree.cliques() - 1; c >= 0; --c) {
    const auto separator = t.separator_rows[c];
    for (std::size_t k = 0; k < separator.size(); ++k)
      above.row(static_cast<Eigen::Index>(k)).head(x.cols()) = x.row(separator[k]);
    kernels().solve_upper(t.elimination->front(c), x.row(t.first_row[c]).data(), stride(x),
                          above.data(), static_cast<int>(x.cols()));
  }
}

}  // namespace sg::solve
