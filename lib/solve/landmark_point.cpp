#include "lib/solve/landmark_point.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include "lib/factor/initialize.h"
#include "lib/factor/linearize.h"

namespace sg::solve {
namespace {

using Point = std::array<double, 3>;

double along(const factor::Ray& ray, const Point& p, std::size_t dim) {
  double sum = 0;
  for (std::size_t k = 0; k < dim; ++k) sum += ray.ahead[k] * (p[k] - ray.origin[k]);
  return sum;
}

// Ahead of every observer, and on none's lens: Jacobians grow without bound there.
bool well_ahead(std::span<const factor::Ray> rays, const Point& p, std::size_t dim) {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const factor::Ray& ray : rays) {
    const double distance = along(ray, p, dim);
    least = std::min(least, distance);
    most = std::max(most, distance);
  }
  return least > 1e-3 * most;
}

// The share of the step at which a distance has halved or doubled, 1 at most.
double trusted_share(std::span<const factor::Ray> rays, const Point& from, const Point& to,
                     std::size_t dim) {
  double share = 1;
  for (const factor::Ray& ray : rays) {
    const double distance = along(ray, from, dim);
    const double change = along(ray, to, dim) - distance;
    if (distance <= 0) continue;
    if (change < -distance / 2) share = std::min(share, -distance / 2 / change);
    if (change > distance) share = std::min(share, distance / change);
  }
  return share;
}

}  // namespace

bool sees_along_ray(const factor::Problem& problem, Index e) {
  return problem.model[e]->rays != nullptr;
}

double ray_distance(const factor::Problem& problem, Index e, const factor::Values& values) {
  const auto ends = problem.graph->edge(e);
  const auto landmark = std::ranges::find_if(
      ends, [&](Index v) { return problem.graph->role(v) == graph::Role::landmark; });
  const auto dim = static_cast<std::size_t>(problem.graph->dim(*landmark));
  Point point{};
  std::copy_n(values.data() + problem.value_at[*landmark], dim, point.begin());
  return along(factor::ray_of(problem, e, values), point, dim);
}

double ray_damping(double distance) {
  const double damped = std::max(std::abs(distance), nearest_seen);
  return 1 / (damped * damped);
}

void move_landmark(const factor::Problem& problem, Index v, std::span<const Index> edges,
                   std::span<const double> step, factor::Values& estimate, double* point) {
  const std::size_t dim = step.size();
  assert(dim <= std::tuple_size_v<Point>);
  std::vector<factor::Ray> rays;
  for (Index e : edges) {
    if (sees_along_ray(problem, e)) rays.push_back(factor::ray_of(problem, e, estimate));
  }
  Point from{}, full{};
  std::copy_n(point, dim, from.begin());
  for (std::size_t k = 0; k < dim; ++k) full[k] = from[k] + step[k];
  const double share = trusted_share(rays, from, full, dim);
  Point cut{}, meeting{};
  for (std::size_t k = 0; k < dim; ++k) cut[k] = from[k] + share * step[k];
  const bool meet = factor::triangulate(rays, static_cast<int>(dim), meeting.data());

  double least = std::numeric_limits<double>::infinity();
  for (const Point& candidate : {cut, meet ? meeting : cut, from}) {
    if (!well_ahead(rays, candidate, dim)) continue;
    std::copy_n(candidate.begin(), dim, estimate.begin() + problem.value_at[v]);
    double sum = 0;
    for (Index e : edges) sum += factor::edge_chi2(problem, estimate, e);
    if (!(sum < least)) continue;
    least = sum;
    std::copy_n(candidate.begin(), dim, point);
  }
}

}  // namespace sg::solve
