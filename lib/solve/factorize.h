// Partial Cholesky of a front (front.h) of any size.
//
// A small one is done column by column, as it lies in a cache. A large one is done by panels of
// columns: the square of L11 on the diagonal, then the panel's rows below it, which are packed, then
// the product of these with themselves, taken from all that is behind the panel. Every number sees
// the same operations in the same order either way and by any number of threads, so that the results
// are the same bytes.
#pragma once

#include <cstddef>

#include "lib/solve/front.h"

namespace sg::solve {

// Whether a front of f frontal and n rows is done by panels.
bool is_large(int f, int n);

// Numbers of `work` that a front of f frontal and n rows needs; 0 for a small one.
std::size_t factorization_work(const Kernels& kernel, int f, int n);

// As Kernels::factorize. With several threads, it is to be called within an arena of theirs.
int factorize(const Kernels& kernel, const Front& front, const double* floor, double* work,
              int threads);

// The same by panels of this width, a multiple of 4, however small the front.
int factorize_by_panels(const Kernels& kernel, const Front& front, const double* floor,
                        double* work, int threads, int width);
std::size_t panel_work(const Kernels& kernel, int n, int width);

}  // namespace sg::solve
