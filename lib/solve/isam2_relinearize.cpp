#include <algorithm>
#include <iterator>

#include "lib/solve/isam2_steps.h"
#include "lib/solve/landmark_point.h"
#include "lib/solve/pivots.h"

namespace sg::solve {
namespace {

void damp_ray(Isam2& isam, Index r, double* gram) {
  const factor::Problem& problem = *isam.problem;
  const graph::Pattern& pattern = pattern_of(isam);
  const int width = factor::block_columns(pattern, r);
  const double distance = ray_distance(problem, r, isam.linearized);
  const bool unseen = distance < nearest_seen;
  if (unseen) std::fill_n(gram, width * width, 0.0);
  int column = 0;
  for (Index j : pattern.rows[r]) {
    const bool landmark =
        problem.graph->role(problem.variables.variable_vertex[j]) == graph::Role::landmark;
    if (landmark && unseen) {
      isam.unseen[j] = true;
      propose(isam, j);
    }
    for (int k = 0; k < pattern.dim[j]; ++k, ++column) {
      if (landmark) gram[diagonal_at(column, width)] += ray_damping(distance);
    }
  }
}

bool seen_along_ray(const Isam2& isam, Index r) {
  return r < isam.problem->graph->edges() && sees_along_ray(*isam.problem, r);
}

// A block whose numbers are not finite, or too large, shows on the diagonal of its Gram matrix.
void check_factor(const Isam2& isam, Index r, const double* block, const double* gram, int width) {
  bool fine = true;
  for (int k = 0; k < width; ++k)
    fine &= gram[diagonal_at(k, width)] <= factor::largest_entry * factor::largest_entry;
  if (fine) return;
  const int size = factor::block_rows(*isam.problem, r) * width;
  factor::check_row(*isam.problem, r, {block, static_cast<std::size_t>(size)});
}

// Theta_j := Theta_j (+) Delta_j, Delta_j := 0.
void move_point(Isam2& isam, Index j) {
  const factor::Problem& problem = *isam.problem;
  const Index v = problem.variables.variable_vertex[j];
  std::vector<Index>& edges = isam.work.edges;
  edges.clear();
  std::ranges::copy_if(rows_of(isam, j), std::back_inserter(edges), [&](Index r) {
    return isam.tree.row_clique[r] >= 0 && r < problem.graph->edges();
  });
  double* const point = isam.linearized.data() + problem.value_at[v];
  const bool by_rays =
      problem.graph->role(v) == graph::Role::landmark &&
      std::ranges::any_of(edges, [&](Index e) { return sees_along_ray(problem, e); });
  if (by_rays) {
    const auto step = std::span(isam.step).subspan(problem.step_at[j], pattern_of(isam).dim[j]);
    move_landmark(problem, v, edges, step, isam.estimate, point);
  } else {
    std::copy(isam.estimate.begin() + problem.value_at[v],
              isam.estimate.begin() + problem.value_at[v + 1], point);
  }
  for (Index k = problem.step_at[j]; k < problem.step_at[j + 1]; ++k)
    isam.step[k] = isam.told[k] = 0;
}

// Moves those of the candidates that have gone too far, and lists them in work.variables.
void move_points(Isam2& isam) {
  std::vector<Index>& moved = isam.work.variables;
  moved.clear();
  for (Index j : isam.candidates) {
    isam.moved[j] = false;
    if (isam.pinned[j] || isam.tree.variable_clique[j] < 0) continue;
    if (largest(isam, j) < isam.options.relinearize_threshold && !isam.unseen[j]) continue;
    isam.unseen[j] = false;
    move_point(isam, j);
    moved.push_back(j);
  }
  isam.candidates.clear();
}

}  // namespace

void linearize_factor(Isam2& isam, Index r) {
  const graph::Pattern& pattern = pattern_of(isam);
  const int height = factor::block_rows(*isam.problem, r),
            width = factor::block_columns(pattern, r);
  isam.work.numbers.resize(height * width + width * width + lane + height * (width + lane));
  double* const block = isam.work.numbers.data();
  double* const gram = block + height * width;
  factor::linearize_row(*isam.problem, isam.linearized, {}, r, block);
  kernels().gram(block, height, width, gram, gram + width * width + lane);
  check_factor(isam, r, block, gram, width);
  if (seen_along_ray(isam, r)) damp_ray(isam, r, gram);
  std::copy_n(gram, width * width, isam.grams.data() + isam.gram_at[r]);
  isam.row_update[r] = isam.updates;
  int column = 0;
  for (Index j : pattern.rows[r]) {
    for (int k = 0; k < pattern.dim[j]; ++k, ++column)
      raise_floor(isam.floor[isam.problem->step_at[j] + k], gram[diagonal_at(column, width)]);
  }
}

Index relinearize(Isam2& isam) {
  const int skip = isam.options.relinearize_skip;
  if (skip <= 0 || isam.updates % skip != 0) return 0;
  move_points(isam);
  const std::vector<Index>& moved = isam.work.variables;
  for (Index j : moved) {  // all their rows are linearized anew
    std::fill(isam.floor.begin() + isam.problem->step_at[j],
              isam.floor.begin() + isam.problem->step_at[j + 1], 0.0);
  }
  for (Index j : moved) {
    mark_to_root(isam, isam.tree.variable_clique[j]);
    for (Index r : rows_of(isam, j)) {
      if (isam.tree.row_clique[r] < 0 || isam.row_update[r] == isam.updates) continue;
      linearize_factor(isam, r);
      mark_to_root(isam, isam.tree.row_clique[r]);
    }
  }
  return static_cast<Index>(moved.size());
}

void mark_to_root(Isam2& isam, Index c) {
  std::vector<Isam2Clique>& cliques = isam.tree.cliques;
  for (; c >= 0 && cliques[c].marked != isam.updates; c = cliques[c].parent) {
    cliques[c].marked = isam.updates;
    isam.work.marked.push_back(c);
  }
}

void mark_all(Isam2& isam) {
  for (Index c = 0; c < static_cast<Index>(isam.tree.cliques.size()); ++c) {
    const Isam2Clique& clique = isam.tree.cliques[c];
    if (is_there(clique) && !is_prior(clique)) mark_to_root(isam, c);
  }
}

}  // namespace sg::solve
