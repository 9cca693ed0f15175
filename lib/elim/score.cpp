#include "lib/elim/score.h"

#include <algorithm>

#include "lib/elim/bayes_tree.h"
#include "lib/elim/counts.h"

namespace sg::elim {

std::string to_string(Wide value) {
  std::string digits;
  do {
    digits.push_back(static_cast<char>('0' + static_cast<int>(value % 10)));
    value /= 10;
  } while (value > 0);
  std::reverse(digits.begin(), digits.end());
  return digits;
}

double to_double(Wide value) {
  return static_cast<double>(value);
}

Symbolic symbolic(const graph::Pattern& pattern, const graph::Order& order) {
  const Links by_position = links(pattern, order);
  std::vector<int> dim(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) dim[k] = pattern.dim[order[k]];
  std::vector<Index> parent = elimination_tree(by_position);
  std::vector<std::int64_t> count = column_counts(by_position, dim, parent);
  return {std::move(dim), std::move(parent), std::move(count)};
}

Wide elimination_complexity(const Symbolic& symbolic) {
  Wide ec = 0;
  for (std::size_t k = 0; k < symbolic.dim.size(); ++k)
    ec += elimination_cost(symbolic.dim[k], symbolic.count[k]);
  return ec;
}

Wide elimination_complexity(const graph::Pattern& pattern, const graph::Order& order) {
  return elimination_complexity(symbolic(pattern, order));
}

Score column_score(const Symbolic& symbolic) {
  Score score;
  score.ec = elimination_complexity(symbolic);
  for (std::size_t k = 0; k < symbolic.dim.size(); ++k) {
    for (int s = 0; s < symbolic.dim[k]; ++s) {
      const auto entries =
          static_cast<Wide>(symbolic.count[k] - s);  // of this scalar column, diagonal included
      const Wide degree = entries - 1;
      score.nnz += entries;
      score.flops += entries * entries;
      score.rose += degree * (degree + 3) / 2;
    }
    score.max_clique = std::max(score.max_clique, symbolic.count[k]);
  }
  score.height = height(symbolic.parent);
  return score;
}

Score score(const Symbolic& symbolic) {
  Score score = column_score(symbolic);
  const BayesTree tree = bayes_tree(symbolic);
  score.ec_bt = elimination_complexity(tree);
  score.cliques = tree.cliques();
  return score;
}

Wide system_nnz(const graph::Pattern& pattern) {
  const graph::Lists<> column = graph::columns(pattern);
  std::vector<Index> seen(pattern.variables(), -1);
  Wide twice_off_diagonal = 0;
  Wide diagonal = 0;
  for (Index j = 0; j < pattern.variables(); ++j) {
    seen[j] = j;
    const auto dim = static_cast<Wide>(pattern.dim[j]);
    diagonal += dim * (dim + 1) / 2;
    for (Index r : column[j]) {
      for (Index i : pattern.rows[r]) {
        if (seen[i] != j) twice_off_diagonal += dim * static_cast<Wide>(pattern.dim[i]);
        seen[i] = j;
      }
    }
  }
  return diagonal + twice_off_diagonal / 2;
}

}  // namespace sg::elim
