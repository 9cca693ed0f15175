// A frontal matrix: the dense symmetric system that one clique of the Bayes tree eliminates, and
// the kernels that work on it.
//
// Its n = f + s + 1 rows are the f scalars of the frontal variables, the s scalars of the
// separator, and the right-hand side: the Gram matrix [A b]' [A b] of what meets in the clique. The
// lower triangle is kept by column in two pieces, since they live for different times:
//     l   f columns of all n rows          becomes [L11; L21; y'], the clique's conditional
//     u   s + 1 columns of the last s + 1  becomes the Schur complement, the update for the parent
// A column starts at a multiple of its leading dimension, which is the row count rounded up to
// `lane`; what lies above the diagonal within a lane, and below the last row, is never read as a
// number of the matrix. Kernels read up to `lane` numbers past the end of a piece: keep that much
// slack behind the last one.
//
// Partial Cholesky:  F11 = L11 L11',  L21 = F21 L11^-T,  U = F22 - L21 L21'.  The last row of L21
// is y = L11^-1 b, and the step solves  L11' x_f = y - L21' x_s. Source: Duff and Reid, The
// multifrontal solution of indefinite sparse symmetric linear equations (1983); Davis, Direct
// Methods, section 4.8 and 6.
#pragma once

#include <cstdint>
#include <span>

namespace sg::solve {

constexpr int lane = 8;
constexpr int round_up(int rows) {
  return (rows + lane - 1) / lane * lane;
}

// Where a square matrix of this leading dimension has its k-th diagonal entry: beyond int from 46341
// rows on.
constexpr std::int64_t diagonal_at(std::int64_t k, std::int64_t ld) {
  return k * (ld + 1);
}

struct Front {
  double* l;
  double* u;  // null: it is not formed, and kernels leave it out
  int f;      // frontal scalars
  int n;      // all rows: frontal, separator, right-hand side

  int s() const { return n - f - 1; }  // separator scalars
  int ld_l() const { return round_up(n); }
  int ld_u() const { return round_up(n - f); }
  std::int64_t size_l() const { return std::int64_t{f} * ld_l(); }
  std::int64_t size_u() const { return std::int64_t{n - f} * ld_u(); }
  double& pivot(int k) const { return l[diagonal_at(k, ld_l())]; }  // of frontal scalar k
};

// Consecutive rows of a small symmetric matrix and of the front that it is added to.
struct Run {
  int from;
  int to;
  int length;
};

// Some columns of a front's L11, and what is below them packed for the caches: rows by tiles, each
// tile by column. Source: Goto and van de Geijn, Anatomy of high-performance matrix multiplication
// (2008).
struct Panel {
  int first, width;
  double* block;      // ld_block * width: its square of L11
  double* diagonals;  // 10 * width / 4: its blocks of four on the diagonal, factorized
  double* packed;     // tiles * tile * width

  int ld_block() const { return round_up(width) + lane; }  // no power of two
};

// The kernels are compiled for several instruction sets. Sums are taken in another order on another
// instruction set, but always in the same one on the same.
struct Kernels {
  const char* name;
  int tile;  // rows in one of a panel

  void (*clear)(const Front& front);

  // front := matrix where its rows and columns `from` go to `to`, 0 elsewhere: what clear and add make of it, in one pass.
  // Runs are as for add; the last one ends with the front.
  void (*set)(const Front& front, const double* matrix, int ld, const Run* runs, int count);

  // gram := block' block, the full square by column. The block is height x width, by column.
  // `work`: height * (width + lane) numbers; gram has `lane` numbers of slack.
  void (*gram)(const double* block, int height, int width, double* gram, double* work);

  // front += matrix, lower triangle only: rows and columns `from` go to `to`. The runs ascend in
  // `to`; where they do not in `from`, the full square of the matrix is read, not only its lower
  // triangle.
  void (*add)(const Front& front, const double* matrix, int ld, const Run* runs, int count);

  // front -= a a', lower triangle only: a has `depth` columns; its rows `from` go to `to`, ascending in `to`.
  void (*subtract_square)(const Front& front, const double* a, int lda, int depth, const Run* runs,
                          int count);

  // Partial Cholesky. A pivot that is not above its `floor` (f numbers; pivots.h), or not finite, is
  // dropped: its column becomes zero (NaN where it was that), as if the scalar were held. Returns
  // how many were.
  int (*factorize)(const Front& front, const double* floor);

  // The same by panels (factorize.h): how many tiles of rows lie below one; its square of L11; its columns in some of these
  // tiles; and what they take from the columns behind it, in the rows of some tiles.
  int (*tiles)(const Front& front, const Panel& panel);
  int (*factorize_block)(const Front& front, const Panel& panel, const double* floor);
  void (*solve_tiles)(const Front& front, const Panel& panel, int first, int last);
  void (*update_tiles)(const Front& front, const Panel& panel, int first, int last);

  // r := L11^-T, f x f by column of leading dimension round_up(f), zero below the diagonal. No pivot of L11 was dropped.
  void (*invert)(const Front& front, double* r);

  // c := -a b', with c rows x columns, a rows x depth, b columns x depth, by column. The leading dimensions are multiples
  // of `lane`; what lies below the last row of c is written over.
  void (*negative_product)(double* c, int ldc, const double* a, int lda, const double* b, int ldb,
                           int rows, int columns, int depth);
  // c -= a b', of the same shapes.
  void (*subtract_product)(double* c, int ldc, const double* a, int lda, const double* b, int ldb,
                           int rows, int columns, int depth);

  // Many right-hand sides, by row: `columns` numbers in rows of ldx, a multiple of `lane`; what lies behind the last number
  // of a row is written over. L is lower triangular, by column, without a dropped pivot.
  // x := L^-1 x in rows from .. to - 1, where those before are done.
  void (*solve_lower)(const double* l, int ldl, double* x, int ldx, int from, int to, int columns);
  // x_f := L11^-T (x_f - L21' x_s), f rows at x and s rows at `above`, of one ldx.
  void (*solve_upper)(const Front& front, double* x, int ldx, const double* above, int columns);

  // c += a' b, c by row, a and b by column with `rows` rows. Nothing behind the last row is read.
  void (*add_inner_products)(double* c, int ldc, const double* a, int lda, int a_columns,
                             const double* b, int ldb, int b_columns, int rows);

  // x has ld_l numbers: x_s in its place, -1 for the right-hand side, 0 elsewhere; fills in x_f.
  void (*back_substitute)(const Front& front, double* x);
};

// Those of this process, decided once: those that SGTOOLS_KERNELS names in the environment, without
// it the last of all_kernels(). Throws a usage Error that lists the names for one that is none, or
// that this machine cannot run.
const Kernels& kernels();

// All that this machine can run, the plainest first.
std::span<const Kernels* const> all_kernels();

}  // namespace sg::solve
