#include "lib/trees/spanning_trees.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lib/sparse/cholesky.h"
#include "lib/text/error.h"

namespace sg::trees {
namespace {

Index root(std::vector<Index>& part, Index node) {
  while (part[node] != node) node = part[node] = part[part[node]];
  return node;
}

void find_parts(SpanningTrees& trees, std::span<const TreeEdge> links,
                std::span<const double> weight) {
  trees.part.resize(trees.position.size());
  std::iota(trees.part.begin(), trees.part.end(), 0);
  for (std::size_t k = 0; k < links.size(); ++k) {
    if (weight[k] <= 0) continue;
    const Index a = root(trees.part, links[k].u), b = root(trees.part, links[k].v);
    trees.part[std::max(a, b)] = std::min(a, b);
  }
  trees.ground = trees.part;  // of a root: itself
}

// The lower triangle of the grounded Laplacian, links of weight 0 included.
sparse::Triplets laplacian(const SpanningTrees& trees, std::span<const TreeEdge> links,
                           std::span<const double> weight) {
  sparse::Triplets lower;
  for (Index v = 0; v < static_cast<Index>(trees.part.size()); ++v)
    lower.add(v, v, trees.part[v] == v ? 1 : 0);
  for (std::size_t k = 0; k < links.size(); ++k) {
    const auto [u, v] = links[k];
    if (u == v) continue;
    lower.add(u, u, weight[k]);
    lower.add(v, v, weight[k]);
    lower.add(std::max(u, v), std::min(u, v), -weight[k]);
  }
  return lower;
}

// Takes the columns of CHOLMOD's factor, diagonal first in each.
void take_factor(SpanningTrees& trees, const cholmod_factor& factor) {
  const auto n = static_cast<Index>(factor.n);
  const auto* perm = static_cast<const int*>(factor.Perm);
  const auto* p = static_cast<const int*>(factor.p);
  const auto* count = static_cast<const int*>(factor.nz);
  const auto* i = static_cast<const int*>(factor.i);
  const auto* x = static_cast<const double*>(factor.x);
  trees.begin.push_back(0);
  for (Index k = 0; k < n; ++k) {
    trees.position[perm[k]] = k;
    trees.diagonal.push_back(x[p[k]]);
    trees.log_trees += std::log(x[p[k]]);
    trees.row.insert(trees.row.end(), i + p[k] + 1, i + p[k] + count[k]);
    trees.value.insert(trees.value.end(), x + p[k] + 1, x + p[k] + count[k]);
    trees.begin.push_back(static_cast<Index>(trees.row.size()));
  }
}

void factorize(SpanningTrees& trees, std::span<const TreeEdge> links,
               std::span<const double> weight) {
  sparse::Cholmod session;
  session.common.final_ll = false;  // L D L^T
  session.common.supernodal = CHOLMOD_SIMPLICIAL;
  sparse::Triplets lower = laplacian(trees, links, weight);
  const sparse::CholmodSparse matrix =
      sparse::sparse_matrix(static_cast<Index>(trees.part.size()), lower, session);
  const sparse::CholmodFactor factor = sparse::analyze(*matrix, CHOLMOD_AMD, session);
  const bool done = sparse::factorize(*matrix, *factor, session);
  if (done) take_factor(trees, *factor);
  if (!done || std::any_of(trees.diagonal.begin(), trees.diagonal.end(),
                           [](double d) { return !(d > 0) || !std::isfinite(d); }))
    throw text::computation_error(
        "the graph's Laplacian cannot be factored: weights differ too much");
}

// The next column on the path to the root, -1 behind it.
Index parent(const SpanningTrees& trees, Index column) {
  const Index first = trees.begin[column];
  return first < trees.begin[column + 1] ? trees.row[first] : -1;
}

// Adds scale x x^T to L D L^T, where x is `work`, whose first entry stands at `start` and whose
// pattern lies on the path from there. Leaves zeros in `work`.
void update(SpanningTrees& trees, Index start, double scale) {
  auto& x = trees.work;
  for (Index k = start; k >= 0; k = parent(trees, k)) {
    const double xk = x[k], old = trees.diagonal[k];
    x[k] = 0;
    if (xk == 0) continue;
    const double renewed = old + scale * xk * xk;
    const double along = scale * xk / renewed;
    trees.diagonal[k] = renewed;
    for (Index at = trees.begin[k]; at < trees.begin[k + 1]; ++at) {
      const Index i = trees.row[at];
      x[i] -= xk * trees.value[at];
      trees.value[at] += along * x[i];
    }
    scale *= old / renewed;
  }
}

}  // namespace

SpanningTrees spanning_trees(Index nodes, std::span<const TreeEdge> links,
                             std::span<const double> weight) {
  SpanningTrees trees;
  trees.position.resize(nodes);
  trees.work.assign(nodes, 0);
  find_parts(trees, links, weight);
  if (nodes == 0) {
    trees.begin.push_back(0);
  } else {
    factorize(trees, links, weight);
  }
  return trees;
}

bool joined(SpanningTrees& trees, const TreeEdge& link) {
  return root(trees.part, link.u) == root(trees.part, link.v);
}

double resistance(SpanningTrees& trees, const TreeEdge& link) {
  if (link.u == link.v) return 0;
  auto& x = trees.work;
  x[trees.position[link.u]] = 1;
  x[trees.position[link.v]] = -1;
  double sum = 0;
  for (Index k = std::min(trees.position[link.u], trees.position[link.v]); k >= 0;
       k = parent(trees, k)) {
    const double xk = x[k];
    x[k] = 0;
    if (xk == 0) continue;
    sum += xk * xk / trees.diagonal[k];
    for (Index at = trees.begin[k]; at < trees.begin[k + 1]; ++at) {
      x[trees.row[at]] -= xk * trees.value[at];
    }
  }
  return sum;
}

double gain(SpanningTrees& trees, const TreeEdge& link, double weight) {
  return joined(trees, link) ? std::log1p(weight * resistance(trees, link)) : std::log(weight);
}

double add_link(SpanningTrees& trees, const TreeEdge& link, double weight) {
  if (link.u == link.v) return 0;
  const double result = gain(trees, link, weight);
  const Index u = trees.position[link.u], v = trees.position[link.v];
  const Index a = root(trees.part, link.u), b = root(trees.part, link.v);
  trees.work[u] = 1;
  trees.work[v] = -1;
  update(trees, std::min(u, v), weight);
  if (a != b) {  // one tie to the ground is enough for both
    const Index ground = trees.position[trees.ground[std::max(a, b)]];
    trees.part[std::max(a, b)] = std::min(a, b);
    trees.work[ground] = 1;
    update(trees, ground, -1);
  }
  trees.log_trees += result;
  return result;
}

void solve(SpanningTrees& trees, std::span<double> x) {
  const auto n = static_cast<Index>(trees.diagonal.size());
  auto& y = trees.work;
  for (Index v = 0; v < n; ++v) y[trees.position[v]] = x[v];
  for (Index k = 0; k < n; ++k) {
    for (Index at = trees.begin[k]; at < trees.begin[k + 1]; ++at)
      y[trees.row[at]] -= y[k] * trees.value[at];
  }
  for (Index k = n - 1; k >= 0; --k) {
    y[k] /= trees.diagonal[k];
    for (Index at = trees.begin[k]; at < trees.begin[k + 1]; ++at)
      y[k] -= y[trees.row[at]] * trees.value[at];
  }
  for (Index v = 0; v < n; ++v) x[v] = y[trees.position[v]];
  std::fill(y.begin(), y.end(), 0);
}

}  // namespace sg::trees
