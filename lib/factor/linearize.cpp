#include "lib/factor/linearize.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>

namespace sg {
namespace {

int columns(const Pattern& pattern, Index r) {
  int sum = 0;
  for (Index j : pattern.rows[r]) sum += pattern.dim[j];
  return sum;
}

void gauge_row(int dim, double* block) {
  std::fill_n(block, dim * (dim + 1), 0.0);
  for (int k = 0; k < dim; ++k) block[k * dim + k] = 1;
}

// An edge with fixed vertices, or with the same vertex twice: columns of constants are left out,
// those of one variable are added up.
void gather_columns(const Problem& problem, Index e, const double* all, double* block) {
  const Pattern& pattern = problem.variables.pattern;
  const int dim = problem.model[e]->dim;
  const auto variables = pattern.rows[e];
  std::fill_n(block, dim * columns(pattern, e), 0.0);
  for (Index v : problem.graph->edge(e)) {
    const int size = dim * problem.graph->dim(v);
    const Index j = problem.variables.vertex_variable[v];
    double* to = block;
    for (Index i : variables) {
      if (i == j) std::transform(all, all + size, to, to, std::plus<>());
      to += dim * pattern.dim[i];
    }
    all += size;
  }
  std::copy_n(all, dim, block + dim * columns(pattern, e));
}

void clear_held(const Problem& problem, Index e, double* block) {
  const Pattern& pattern = problem.variables.pattern;
  for (Index j : pattern.rows[e]) {
    const int size = problem.model[e]->dim * pattern.dim[j];
    if (j == problem.held) std::fill_n(block, size, 0.0);
    block += size;
  }
}

// Scales the block by the root of the kernel's weight.
void reweigh(const Kernel& kernel, int dim, int columns, double* block) {
  const double* const b = block + dim * columns;
  double s = 0;
  for (int k = 0; k < dim; ++k) s += b[k] * b[k];
  const double scale = std::sqrt(weight(kernel, s));
  std::for_each(block, block + dim * (columns + 1), [&](double& number) { number *= scale; });
}

}  // namespace

LinearSystem make_linear_system(const Problem& problem) {
  LinearSystem system;
  const Pattern& pattern = problem.variables.pattern;
  system.pattern = &pattern;
  system.begin.push_back(0);
  for (Index r = 0; r < pattern.rows.size(); ++r) {
    const bool gauge = r == problem.graph->edges();
    system.height.push_back(gauge ? pattern.dim[problem.held] : problem.model[r]->dim);
    system.begin.push_back(system.begin.back() + system.height.back() * (columns(pattern, r) + 1));
  }
  system.numbers.assign(system.begin.back(), 0.0);
  return system;
}

void linearize_row(const Problem& problem, const Values& values, const Kernel& kernel, Index r,
                   double* block) {
  const Pattern& pattern = problem.variables.pattern;
  if (r >= problem.graph->edges()) return gauge_row(pattern.dim[problem.held], block);
  const Model& model = *problem.model[r];
  const Ends x = ends_of(problem, values, r);
  const double* const c = constants_of(problem, r);
  const Whitening U = whitening_of(problem, r);
  const auto variables = pattern.rows[r];
  if (static_cast<int>(variables.size()) == model.arity) {
    model.linearize(x.data(), c, U, block);
  } else {
    double all[max_block];
    model.linearize(x.data(), c, U, all);
    gather_columns(problem, r, all, block);
  }
  if (std::find(variables.begin(), variables.end(), problem.held) != variables.end()) {
    clear_held(problem, r, block);
  }
  if (kernel.shape != KernelShape::none) reweigh(kernel, model.dim, columns(pattern, r), block);
}

void linearize(const Problem& problem, const Values& values, const Kernel& kernel,
               LinearSystem& system) {
  using Range = tbb::blocked_range<Index>;
  tbb::parallel_for(Range(0, system.pattern->rows.size(), 512), [&](const Range& range) {
    for (Index r = range.begin(); r != range.end(); ++r) {
      linearize_row(problem, values, kernel, r, system.block(r));
    }
  });
}

double edge_chi2(const Problem& problem, const Values& values, Index e) {
  const Model& model = *problem.model[e];
  const Ends x = ends_of(problem, values, e);
  double error[max_dim];
  model.error(x.data(), constants_of(problem, e), whitening_of(problem, e), error);
  double sum = 0;
  for (int k = 0; k < model.dim; ++k) sum += error[k] * error[k];
  return sum;
}

double chi2(const Problem& problem, const Values& values, const Kernel& kernel) {
  double sum = 0;
  for (Index e = 0; e < problem.graph->edges(); ++e) {
    sum += rho(kernel, edge_chi2(problem, values, e));
  }
  return sum;
}

}  // namespace sg
