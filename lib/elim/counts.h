// Dimension-weighted column counts: how large each variable's separator is when its turn comes.
//
// Gilbert, Ng, Peyton (An efficient algorithm to compute row and column counts for sparse Cholesky
// factorization, 1994) in the form of Davis (Direct Methods, section 4.4 and 4.7) for A^T A, with
// each row subtree weighing its root's dimension instead of one. Near-linear in the size of A;
// neither the factor nor A^T A is formed.
#pragma once

#include <cstdint>
#include <vector>

#include "lib/elim/etree.h"

namespace sg::elim {

// For every position k: d_f(k) + d_s(k), the scalar dimension of the variable and its separator
// together. dim and parent by position.
std::vector<std::int64_t> column_counts(const Links& links, const std::vector<int>& dim,
                                        const std::vector<Index>& parent);
inline std::vector<std::int64_t> column_counts(const OrderedPattern& pattern,
                                               const std::vector<Index>& parent) {
  return column_counts(links(pattern), pattern.dim, parent);
}

}  // namespace sg::elim
