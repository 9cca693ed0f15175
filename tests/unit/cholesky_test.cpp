// The handles of CHOLMOD, and what becomes of it without memory.
#include "lib/sparse/cholesky.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <new>

#include "lib/text/error.h"
#include "lib/trees/spanning_trees.h"

using namespace sg;

namespace {

// Allocations that CHOLMOD may still make.
long left = 0;

void* limited_malloc(std::size_t size) {
  return left-- > 0 ? std::malloc(size) : nullptr;
}
void* limited_calloc(std::size_t count, std::size_t size) {
  return left-- > 0 ? std::calloc(count, size) : nullptr;
}
void* limited_realloc(void* block, std::size_t size) {
  return left-- > 0 ? std::realloc(block, size) : nullptr;
}

void set_allocators(void* (*by_size)(std::size_t), void* (*by_count)(std::size_t, std::size_t),
                    void* (*again)(void*, std::size_t)) {
#if SUITESPARSE_VERSION >= SUITESPARSE_VER_CODE(6, 0)
  SuiteSparse_config_malloc_func_set(by_size);
  SuiteSparse_config_calloc_func_set(by_count);
  SuiteSparse_config_realloc_func_set(again);
#else
  SuiteSparse_config.malloc_func = by_size;
  SuiteSparse_config.calloc_func = by_count;
  SuiteSparse_config.realloc_func = again;
#endif
}

struct Limit {
  explicit Limit(long allocations) {
    left = allocations;
    set_allocators(limited_malloc, limited_calloc, limited_realloc);
  }
  ~Limit() { set_allocators(std::malloc, std::calloc, std::realloc); }
};

// How many allocations `work` needs: with fewer it must throw bad_alloc.
long allocations_of(const auto& work) {
  for (long allowed = 0;; ++allowed) {
    try {
      const Limit limit(allowed);
      work();
      return allowed;
    } catch (const std::bad_alloc&) {  // and nothing else
    }
  }
}

// 2 on the diagonal, -1 beside it.
sparse::Triplets second_difference(int n) {
  sparse::Triplets lower;
  for (int i = 0; i < n; ++i) {
    lower.add(i, i, 1);
    lower.add(i, i, 1);  // entries of one place add up
    if (i > 0) lower.add(i, i - 1, -1);
  }
  return lower;
}

}  // namespace

TEST_CASE("a system is solved, and one without memory is an error at every step", "[cholesky]") {
  for (const int supernodal : {CHOLMOD_SIMPLICIAL, CHOLMOD_SUPERNODAL}) {
    for (const int ordering : {CHOLMOD_NATURAL, CHOLMOD_AMD}) {
      constexpr int n = 9;
      std::vector<double> solution;
      const long needed = allocations_of([&] {
        sparse::Cholmod session;
        session.common.supernodal = supernodal;
        sparse::Triplets lower = second_difference(n);
        const sparse::CholmodSparse matrix = sparse::sparse_matrix(n, lower, session);
        const sparse::CholmodFactor factor = sparse::analyze(*matrix, ordering, session);
        const bool definite = sparse::factorize(*matrix, *factor, session);
        CHECK(definite);
        std::vector<double> b(n, 0);
        b.back() = n + 1;
        const sparse::CholmodDense x = sparse::solve(*factor, b, session);
        const auto* numbers = static_cast<const double*>(x->x);
        solution.assign(numbers, numbers + n);
      });
      CHECK(needed > 10);
      for (int i = 0; i < n; ++i) CHECK(solution[i] == Approx(i + 1));
    }
  }
}

TEST_CASE("a matrix that is not positive definite is told from a failure", "[cholesky]") {
  sparse::Cholmod session;
  sparse::Triplets lower;
  lower.add(0, 0, 1);
  lower.add(1, 0, 2);
  lower.add(1, 1, 1);
  const sparse::CholmodSparse matrix = sparse::sparse_matrix(2, lower, session);
  session.common.supernodal = CHOLMOD_SUPERNODAL;
  const sparse::CholmodFactor factor = sparse::analyze(*matrix, CHOLMOD_NATURAL, session);
  CHECK(!sparse::factorize(*matrix, *factor, session));
}

TEST_CASE("spanning trees without memory are an error", "[cholesky]") {
  const std::vector<trees::Edge> links{{0, 1}, {1, 2}, {2, 3}, {3, 0}};
  const std::vector<double> weight(links.size(), 1);
  double log_trees = 0;
  CHECK(allocations_of([&] { log_trees = trees::spanning_trees(4, links, weight).log_trees; }) >
        10);
  CHECK(log_trees == Approx(std::log(4)));
}
