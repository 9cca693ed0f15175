// What an elimination costs (Frey, Steiner, How, eq. 2 to 4, and the classical measures beside
// them). All of it exact.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lib/elim/etree.h"

namespace sg::elim {

// Sums of cubes outgrow 64 bits from some millions of scalars on.
__extension__ typedef unsigned __int128 Wide;
std::string to_string(Wide value);
double to_double(Wide value);

// The symbolic elimination of a pattern in an order.
struct Symbolic {
  std::vector<int> dim;             // d_f by position
  std::vector<Index> parent;        // elimination tree
  std::vector<std::int64_t> count;  // d_f + d_s by position
};
Symbolic symbolic(const graph::Pattern& pattern, const graph::Order& order);

// d_f (d_f + d_s)^2 of one variable or one clique.
inline Wide elimination_cost(std::int64_t frontal, std::int64_t total) {
  return static_cast<Wide>(frontal) * static_cast<Wide>(total) * static_cast<Wide>(total);
}

struct Score {
  Wide ec = 0;     // sum over variables of d_f (d_f + d_s)^2
  Wide rose = 0;   // 1/2 sum over scalar columns of d (d + 3): multiplications (Rose 1972)
  Wide flops = 0;  // sum over scalar columns of (d + 1)^2: CHOLMOD's flop count
  Wide nnz = 0;    // scalar entries of R, its diagonal included
  std::int64_t max_clique = 0;  // largest d_f + d_s
  Index height = 0;             // of the elimination tree, in variables
  Index cliques = 0;            // of the Bayes tree
  Wide ec_bt = 0;               // sum over cliques of d_f (d_f + d_s)^2
};
Score score(const Symbolic& symbolic);
// The same without the Bayes tree's cliques and ec_bt, for who does not want them.
Score column_score(const Symbolic& symbolic);

// EC alone.
Wide elimination_complexity(const Symbolic& symbolic);
Wide elimination_complexity(const graph::Pattern& pattern, const graph::Order& order);

// Scalar entries of the upper triangle of A^T A, diagonal included: fill = Score::nnz - this.
Wide system_nnz(const graph::Pattern& pattern);

}  // namespace sg::elim
