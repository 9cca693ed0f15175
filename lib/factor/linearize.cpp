#include "lib/factor/linearize.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "lib/parallel/parallel.h"
#include "lib/text/error.h"

namespace sg::factor {
namespace {

// Those of A_r, without b.
int columns(const graph::Pattern& pattern, Index r) {
  return block_columns(pattern, r) - 1;
}

void gauge_row(int held, int dim, double* block) {
  std::fill_n(block, held * (dim + 1), 0.0);
  for (int k = 0; k < held; ++k) block[k * held + k] = 1;
}

// An edge with fixed vertices, or with the same vertex twice: columns of constants are left out,
// those of one variable are added up.
void gather_columns(const Problem& problem, Index e, const double* all, double* block) {
  const graph::Pattern& pattern = problem.variables.pattern;
  const int dim = dim_of(problem, e);
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
  const graph::Pattern& pattern = problem.variables.pattern;
  for (Index j : pattern.rows[e]) {
    const int height = dim_of(problem, e);
    if (j == problem.held) std::fill_n(block, height * held_dim(problem), 0.0);
    block += height * pattern.dim[j];
  }
}

// Scales the block by the root of the edge's weight.
void reweigh(const Loss& loss, Index e, int dim, int columns, double* block) {
  const double* const b = block + dim * columns;
  double s = 0;
  for (int k = 0; k < dim; ++k) s += b[k] * b[k];
  const double scale = std::sqrt(weight(loss, e, s));
  std::for_each(block, block + dim * (columns + 1), [&](double& number) { number *= scale; });
}

text::Error error_of_edge(const Problem& problem, Index e, const std::string& cause) {
  const Graph& graph = *problem.graph;
  return {text::Fault::computation, graph.file, graph::line_number(graph, graph.edge_line[e]),
          graph.type_of_edge(e).tag + cause};
}

}  // namespace

int block_rows(const Problem& problem, Index r) {
  const bool gauge = r >= problem.graph->edges();
  return gauge ? held_dim(problem) : dim_of(problem, r);
}

int block_columns(const graph::Pattern& pattern, Index r) {
  int sum = 1;
  for (Index j : pattern.rows[r]) sum += pattern.dim[j];
  return sum;
}

bool is_laid_out(const LinearSystem& system) {
  const Index rows = system.pattern->rows.size();
  if (static_cast<Index>(system.height.size()) != rows) return false;
  if (static_cast<Index>(system.begin.size()) != rows + 1) return false;
  for (Index r = 0; r < rows; ++r) {
    const Offset size = Offset{system.height[r]} * block_columns(*system.pattern, r);
    if (system.begin[r + 1] - system.begin[r] != size) return false;
  }
  return system.begin.back() == static_cast<Offset>(system.numbers.size());
}

LinearSystem make_linear_system(const Problem& problem) {
  LinearSystem system;
  const graph::Pattern& pattern = problem.variables.pattern;
  system.pattern = &pattern;
  system.begin.push_back(0);
  for (Index r = 0; r < pattern.rows.size(); ++r) {
    system.height.push_back(block_rows(problem, r));
    system.begin.push_back(system.begin.back() + system.height.back() * block_columns(pattern, r));
  }
  system.numbers.assign(system.begin.back(), 0.0);
  return system;
}

void linearize_row(const Problem& problem, const Values& values, const Loss& loss, Index r,
                   double* block) {
  const graph::Pattern& pattern = problem.variables.pattern;
  assert(0 <= r && r < pattern.rows.size());
  assert(static_cast<Index>(values.size()) == problem.value_at.back());
  if (r >= problem.graph->edges())
    return gauge_row(held_dim(problem), pattern.dim[problem.held], block);
  const Model& model = *problem.model[r];
  const Ends x = ends_of(problem, values, r);
  const double* const c = constants_of(problem, r);
  const Whitening U = whitening_of(problem, r);
  const auto variables = pattern.rows[r];
  const auto vertices = problem.graph->edge(r);
  if (variables.size() == vertices.size()) {
    model.linearize(x.data(), c, U, block);
  } else {
    int width = 1;
    for (Index v : vertices) width += problem.graph->dim(v);
    Room<double, max_block> all(dim_of(problem, r) * width);
    model.linearize(x.data(), c, U, all.data());
    gather_columns(problem, r, all.data(), block);
  }
  if (std::find(variables.begin(), variables.end(), problem.held) != variables.end()) {
    clear_held(problem, r, block);
  }
  if (!is_plain(loss)) reweigh(loss, r, dim_of(problem, r), columns(pattern, r), block);
}

void check_row(const Problem& problem, Index r, std::span<const double> block) {
  bool fine = true;
  for (double number : block) fine &= std::abs(number) <= largest_entry;  // false for NaN, too
  if (fine) return;
  const bool finite = std::ranges::all_of(block, [](double x) { return std::isfinite(x); });
  throw error_of_edge(
      problem, r,
      finite ? " weighs too much to calculate with: its information or its error is too large"
             : " has no derivative at this estimate");
}

void linearize(const Problem& problem, const Values& values, const Loss& loss,
               LinearSystem& system) {
  assert(is_laid_out(system) && system.pattern->dim == problem.variables.pattern.dim);
  parallel::each_part<Index>(system.pattern->rows.size(), 512, [&](Index first, Index last) {
    for (Index r = first; r < last; ++r) linearize_row(problem, values, loss, r, system.block(r));
  });
  for (Index r = 0; r < problem.graph->edges(); ++r)  // the first one in the file is told
    check_row(problem, r, {system.block(r), system.block(r + 1)});
}

LinearSystem linearized(const Problem& problem, const Values& values, const Loss& loss) {
  LinearSystem system = make_linear_system(problem);
  linearize(problem, values, loss, system);
  return system;
}

double edge_chi2(const Problem& problem, const Values& values, Index e) {
  const Model& model = *problem.model[e];
  const Ends x = ends_of(problem, values, e);
  const int dim = dim_of(problem, e);
  Room<double, max_dim> error(dim);
  model.error(x.data(), constants_of(problem, e), whitening_of(problem, e), error.data());
  double sum = 0;
  for (int k = 0; k < dim; ++k) sum += error[k] * error[k];
  return sum;
}

double chi2(const Problem& problem, const Values& values, const Loss& loss) {
  double sum = 0;
  for (Index e = 0; e < problem.graph->edges(); ++e) {
    sum += rho(loss, e, edge_chi2(problem, values, e));
  }
  return sum;
}

double finite_edge_chi2(const Problem& problem, const Values& values, Index e) {
  const double value = edge_chi2(problem, values, e);
  if (!std::isfinite(value))
    throw error_of_edge(problem, e, " has no finite error at this estimate");
  return value;
}

double finite_chi2(const Problem& problem, const Values& values, const Loss& loss) {
  double sum = 0;
  for (Index e = 0; e < problem.graph->edges(); ++e)
    sum += rho(loss, e, finite_edge_chi2(problem, values, e));
  return sum;
}

}  // namespace sg::factor
