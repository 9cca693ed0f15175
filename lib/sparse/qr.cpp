#include "lib/sparse/qr.h"

#include <SuiteSparseQR.hpp>
#include <cassert>
#include <memory>
#include <new>
#include <string>

#include "lib/text/error.h"

namespace sg::sparse {
namespace {

static_assert(sizeof(SuiteSparse_long) == sizeof(std::int64_t));

// SPQR wants CHOLMOD's sessions with long indices.
struct Session {
  Session() {
    cholmod_l_start(&common);
    common.print = 0;
  }
  ~Session() { cholmod_l_finish(&common); }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
  cholmod_common common{};
};

template <auto Free>
struct Freed {
  cholmod_common* common;
  void operator()(auto* handle) const { Free(&handle, common); }
};
using Sparse = std::unique_ptr<cholmod_sparse, Freed<cholmod_l_free_sparse>>;
using Dense = std::unique_ptr<cholmod_dense, Freed<cholmod_l_free_dense>>;

void check(const Session& session) {
  const int status = session.common.status;
  if (status >= CHOLMOD_OK) return;
  if (status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
  throw text::computation_error("SPQR failed (status " + std::to_string(status) + ")");
}

Sparse compressed(Entries& A, Session& session) {
  cholmod_triplet view{};
  view.nrow = A.rows;
  view.ncol = A.columns;
  view.nnz = view.nzmax = A.value.size();
  view.i = A.row.data();
  view.j = A.column.data();
  view.x = A.value.data();
  view.itype = CHOLMOD_LONG;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  Sparse result(cholmod_l_triplet_to_sparse(&view, 0, &session.common), {&session.common});
  check(session);
  return result;
}

cholmod_dense view(std::vector<double>& b) {
  cholmod_dense dense{};
  dense.nrow = dense.d = dense.nzmax = b.size();
  dense.ncol = 1;
  dense.x = b.data();
  dense.xtype = CHOLMOD_REAL;
  dense.dtype = CHOLMOD_DOUBLE;
  return dense;
}

// R is a staircase: a column that reaches one row further than all before it has a pivot there.
void set_pivots(Qr& result) {
  std::int64_t next = 0;
  for (std::size_t k = 0; k < result.column.size(); ++k) {
    const bool alive =
        result.begin[k + 1] > result.begin[k] && result.rows[result.begin[k + 1] - 1] == next;
    result.pivot.push_back(alive ? next++ : -1);
    result.dead += !alive;
  }
}

}  // namespace

Qr qr(Entries& A, std::vector<double>& b, double tolerance) {
  assert(static_cast<std::int64_t>(b.size()) == A.rows);
  if (A.columns == 0) return {{}, {0}, {}, {}, {}, {}, 0};
  Session session;
  const Sparse matrix = compressed(A, session);
  cholmod_dense right = view(b);
  cholmod_dense* c = nullptr;
  cholmod_sparse* r = nullptr;
  SuiteSparse_long* e = nullptr;
  SuiteSparseQR<double>(SPQR_ORDERING_DEFAULT, tolerance, 0, matrix.get(), &right, &c, &r, &e,
                        &session.common);
  const Dense C(c, {&session.common});
  const Sparse R(r, {&session.common});
  Qr result;
  for (std::int64_t k = 0; k < A.columns; ++k) result.column.push_back(e ? e[k] : k);
  cholmod_l_free(A.columns, sizeof(SuiteSparse_long), e, &session.common);
  check(session);
  cholmod_l_sort(R.get(), &session.common);
  check(session);
  const auto* begin = static_cast<const std::int64_t*>(R->p);
  const auto* rows = static_cast<const std::int64_t*>(R->i);
  const auto* numbers = static_cast<const double*>(R->x);
  result.begin.assign(begin, begin + A.columns + 1);
  result.rows.assign(rows, rows + result.begin.back());
  result.numbers.assign(numbers, numbers + result.begin.back());
  const auto* given = static_cast<const double*>(C->x);
  result.right.assign(given, given + C->nrow);
  set_pivots(result);
  return result;
}

std::vector<double> back_substitute(const Qr& qr, std::vector<double> right,
                                    std::span<const double> dead) {
  std::vector<double> x(qr.column.size());
  auto next_dead = static_cast<std::size_t>(qr.dead);
  for (std::size_t k = x.size(); k-- > 0;) {
    double value = 0;
    if (qr.pivot[k] >= 0) {
      value = right[qr.pivot[k]] / qr.numbers[qr.begin[k + 1] - 1];
    } else if (--next_dead < dead.size()) {
      value = dead[next_dead];
    }
    x[qr.column[k]] = value;
    for (std::int64_t at = qr.begin[k]; at < qr.begin[k + 1]; ++at) {
      right[qr.rows[at]] -= qr.numbers[at] * value;
    }
  }
  return x;
}

}  // namespace sg::sparse
