#include "lib/sparse/cholesky.h"

#include <sys/resource.h>

#include <limits>
#include <new>
#include <string>

#include "lib/text/error.h"

extern "C" void omp_set_max_active_levels(int levels) __attribute__((weak));

namespace sg::sparse {
namespace {

text::Error too_large() {
  return text::computation_error("the system is too large for CHOLMOD");
}

// Warnings, as of a matrix that is not positive definite, have a positive status.
void check(const Cholmod& session) {
  const int status = session.common.status;
  if (status >= CHOLMOD_OK) return;
  if (status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
  if (status == CHOLMOD_TOO_LARGE) throw too_large();
  throw text::computation_error("CHOLMOD failed (status " + std::to_string(status) + ")");
}

template <class Handle>
Handle checked(typename Handle::pointer result, Cholmod& session) {
  Handle handle(result, {&session.common});
  check(session);
  return handle;
}

// OpenMP, which CHOLMOD's loops use, ends the process where it cannot make its threads: where memory is limited
// (ulimit -v), it makes none.
void spare_threads() {
  rlimit limit{};
  ::getrlimit(RLIMIT_AS, &limit);
  if (limit.rlim_cur != RLIM_INFINITY && omp_set_max_active_levels) omp_set_max_active_levels(0);
}

}  // namespace

Cholmod::Cholmod() {
  spare_threads();
  cholmod_start(&common);
  common.print = 0;
}

Cholmod::~Cholmod() {
  cholmod_finish(&common);
}

CholmodSparse sparse_matrix(int n, Triplets& lower, Cholmod& session) {
  cholmod_triplet view{};
  view.nrow = view.ncol = n;
  view.nnz = view.nzmax = lower.value.size();
  if (view.nnz > static_cast<std::size_t>(std::numeric_limits<int>::max())) throw too_large();
  view.i = lower.row.data();
  view.j = lower.column.data();
  view.x = lower.value.data();
  view.stype = -1;
  view.itype = CHOLMOD_INT;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  return checked<CholmodSparse>(cholmod_triplet_to_sparse(&view, 0, &session.common), session);
}

cholmod_sparse view(std::vector<int>& column_begin, std::vector<int>& rows,
                    std::vector<double>& numbers) {
  cholmod_sparse matrix{};
  matrix.nrow = matrix.ncol = column_begin.size() - 1;
  matrix.nzmax = rows.size();
  matrix.p = column_begin.data();
  matrix.i = rows.data();
  matrix.x = numbers.data();
  matrix.stype = 1;
  matrix.itype = CHOLMOD_INT;
  matrix.xtype = CHOLMOD_REAL;
  matrix.dtype = CHOLMOD_DOUBLE;
  matrix.sorted = matrix.packed = 1;
  return matrix;
}

CholmodFactor analyze(cholmod_sparse& matrix, int ordering, Cholmod& session) {
  session.common.nmethods = 1;
  session.common.method[0].ordering = ordering;
  session.common.postorder = 1;
  return checked<CholmodFactor>(cholmod_analyze(&matrix, &session.common), session);
}

bool factorize(cholmod_sparse& matrix, cholmod_factor& factor, Cholmod& session) {
  cholmod_factorize(&matrix, &factor, &session.common);
  check(session);
  return session.common.status == CHOLMOD_OK;
}

CholmodDense solve(cholmod_factor& factor, std::vector<double>& b, Cholmod& session) {
  cholmod_dense right{};
  right.nrow = right.d = factor.n;
  right.nzmax = b.size();
  right.ncol = b.size() / factor.n;
  right.x = b.data();
  right.xtype = CHOLMOD_REAL;
  right.dtype = CHOLMOD_DOUBLE;
  return checked<CholmodDense>(cholmod_solve(CHOLMOD_A, &factor, &right, &session.common), session);
}

}  // namespace sg::sparse
