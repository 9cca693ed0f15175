// Matrix Market (Boisvert, Pozo, Remington 1996): the pattern of the system matrix A^T A, its lower
// triangle with the diagonal, column by column. Rows are the variables by ascending id; or, scalar,
// their dimensions one after the other.
#pragma once

#include "formats/convert.h"

namespace sg::formats {

void write_mtx(const Graph& graph, const WriteOptions& options, Sink& sink);

}  // namespace sg::formats
