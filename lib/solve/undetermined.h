// What a system whose elimination broke down leaves undetermined, by its rank: the columns that depend on others in the
// QR factorization of A, scaled to unit columns (scaled_qr.h). Pivots of the normal equations do not tell: at the far
// end of a long chain, which is sound, they are as small as rounding leaves them where nothing is measured.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "lib/factor/linearize.h"
#include "lib/text/error.h"

namespace sg::solve {

struct NullSpace {
  Index dimension = 0;              // scalars; 0: all is determined
  bool scale = false;               // the change of scale is in it
  std::vector<Index> undetermined;  // variables that move in it otherwise; ascending
  std::vector<Index> lost;  // those that moving costs little more than rounding: ill-conditioned
};

// scaling: a step in the null space that does not count (free_scaling; gauge.h); empty for none.
NullSpace null_space(const factor::LinearSystem& system, std::span<const double> scaling = {});

// The Error for such a system. id: by variable.
text::Error singular_error(const NullSpace& open, std::span<const Id> id);

// "vertex 5" or "vertices 3, 7-12 and 15", from ascending ids; at most 20 ranges, then "and 7 more".
std::string id_ranges(const std::vector<Id>& ids);

}  // namespace sg::solve
