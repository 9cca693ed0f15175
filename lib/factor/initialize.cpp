#include "lib/factor/initialize.h"

#include <Eigen/QR>
#include <algorithm>
#include <queue>

#include "lib/geometry/numbers.h"

namespace sg::factor {
namespace {

// Where v stands in edge e, if all other ends are placed; -1 otherwise.
int free_end(const Graph& graph, const std::vector<bool>& placed, Index e, Index v) {
  int end = -1;
  const auto vertices = graph.edge(e);
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    if (vertices[k] != v && !placed[vertices[k]]) return -1;
    if (vertices[k] != v) continue;
    if (end >= 0) return -1;  // joins v to itself
    end = static_cast<int>(k);
  }
  return end;
}

bool place_by_rays(const Problem& problem, Index v, std::span<const Index> edges,
                   const std::vector<bool>& placed, Values& values) {
  std::vector<Ray> rays;
  for (Index e : edges) {
    const Model& model = *problem.model[e];
    if (!model.rays || free_end(*problem.graph, placed, e, v) < 0) continue;
    if (problem.graph->role(v) != graph::Role::landmark) continue;
    rays.push_back(ray_of(problem, e, values));
  }
  if (rays.empty()) return false;
  const int dim = problem.graph->dim(v);
  double* const out = values.data() + problem.value_at[v];
  if (rays.size() > 1 && triangulate(rays, dim, out)) return true;
  for (int i = 0; i < dim; ++i) out[i] = rays[0].origin[i] + lone_range * rays[0].ahead[i];
  return true;
}

// Edges at every vertex, in file order.
graph::Lists<> incidence(const Graph& graph) {
  return graph::counting_sort(graph.vertices(), [&](const auto& put) {
    for (Index e = 0; e < graph.edges(); ++e) {
      for (Index v : graph.edge(e)) put(v, e);
    }
  });
}

// Spreads over the vertices of one role: always the lowest vertex that an edge joins to a placed
// one.
struct Spread {
  const Problem& problem;
  const graph::Lists<>& at;
  graph::Role role;
  std::vector<bool>& placed;
  Values& values;
  std::priority_queue<Index, std::vector<Index>, std::greater<>> reached{};
};

void reach_neighbours(Spread& spread, Index v) {
  const Graph& graph = *spread.problem.graph;
  for (Index e : spread.at[v]) {
    for (Index u : graph.edge(e)) {
      if (!spread.placed[u] && graph.role(u) == spread.role) spread.reached.push(u);
    }
  }
}

// The vertex of the same role before v, -1 if v is the first.
Index predecessor(const Spread& spread, Index v) {
  const Graph& graph = *spread.problem.graph;
  while (--v >= 0 && graph.role(v) != spread.role) continue;
  return v;
}

// Edges at v, those to its predecessor first: odometry goes before loop closures.
std::vector<Index> by_preference(const Spread& spread, Index v) {
  const auto edges = spread.at[v];
  const Index before = predecessor(spread, v);
  std::vector<Index> sorted(edges.begin(), edges.end());
  std::stable_partition(sorted.begin(), sorted.end(), [&](Index e) {
    return std::ranges::count(spread.problem.graph->edge(e), before) > 0;
  });
  return sorted;
}

void place_reached(Spread& spread) {
  while (!spread.reached.empty()) {
    const Index v = spread.reached.top();
    spread.reached.pop();
    if (spread.placed[v]) continue;
    if (!place_vertex(spread.problem, v, by_preference(spread, v), spread.placed, spread.values)) {
      continue;
    }
    spread.placed[v] = true;
    reach_neighbours(spread, v);
  }
}

// From what is placed; then from the first in each part that its own prior places; what is left of a
// part without one starts where it is.
void place_all(Spread& spread, std::vector<Index>& adrift) {
  const Graph& graph = *spread.problem.graph;
  for (Index v = 0; v < graph.vertices(); ++v) {
    if (spread.placed[v]) reach_neighbours(spread, v);
  }
  place_reached(spread);
  bool alone = std::ranges::none_of(spread.placed, [](bool placed) { return placed; });
  for (const bool by_prior : {true, false}) {
    for (Index v = 0; v < graph.vertices(); ++v) {
      if (spread.placed[v] || graph.role(v) != spread.role) continue;
      const bool known =
          place_vertex(spread.problem, v, spread.at[v], spread.placed, spread.values);
      if (!known && by_prior) continue;
      if (!known && !alone) adrift.push_back(v);
      alone = false;
      spread.placed[v] = true;
      reach_neighbours(spread, v);
      place_reached(spread);
    }
  }
}

}  // namespace

Ray ray_of(const Problem& problem, Index e, const Values& values) {
  const Ends x = ends_of(problem, values, e);
  return problem.model[e]->rays(x.data(), constants_of(problem, e));
}

bool triangulate(std::span<const Ray> rays, int dim, double* out) {
  Eigen::MatrixXd A(0, dim);
  Eigen::VectorXd b(0);
  for (const Ray& ray : rays) {
    for (int k = 0; k < ray.rows; ++k) {
      A.conservativeResize(A.rows() + 1, dim);
      b.conservativeResize(A.rows());
      for (int i = 0; i < dim; ++i) A(A.rows() - 1, i) = ray.row[k][i];
      b[A.rows() - 1] = ray.row[k][3];
    }
  }
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr;
  qr.setThreshold(1e-3);
  qr.compute(A);
  if (qr.rank() < dim) return false;
  const Eigen::VectorXd point = qr.solve(b);
  for (const Ray& ray : rays) {
    double ahead = 0;
    for (int i = 0; i < dim; ++i) ahead += ray.ahead[i] * (point[i] - ray.origin[i]);
    if (ahead <= 0) return false;
  }
  std::copy_n(point.data(), dim, out);
  return true;
}

bool place_vertex(const Problem& problem, Index v, std::span<const Index> edges,
                  const std::vector<bool>& placed, Values& values) {
  for (Index e : edges) {
    const Model& model = *problem.model[e];
    const int end = free_end(*problem.graph, placed, e, v);
    if (end < 0 || !model.place) continue;
    const Ends x = ends_of(problem, values, e);
    const double* const c = constants_of(problem, e);
    if (model.place(x.data(), c, end, values.data() + problem.value_at[v])) return true;
  }
  return place_by_rays(problem, v, edges, placed, values);
}

Composed compose(const Problem& problem) {
  const Graph& graph = *problem.graph;
  std::vector<bool> placed(graph.vertices(), false);
  Composed result;
  Values& values = result.values;
  if (graph.edges_only) {
    values.resize(problem.value_at.back());
    for (Index v = 0; v < graph.vertices(); ++v) {
      set_origin(problem.space[v], values.data() + problem.value_at[v]);
    }
  } else {
    values = file_values(problem);
    placed = graph.fixed;
    if (problem.held >= 0) placed[problem.variables.variable_vertex[problem.held]] = true;
  }
  result.adrift = place_rest(problem, placed, values);
  return result;
}

std::vector<Index> place_rest(const Problem& problem, std::vector<bool>& placed, Values& values) {
  std::vector<Index> adrift;
  const graph::Lists<> at = incidence(*problem.graph);
  for (graph::Role role : {graph::Role::pose, graph::Role::landmark, graph::Role::other}) {
    Spread spread{problem, at, role, placed, values};
    place_all(spread, adrift);
  }
  return adrift;
}

Values initial_values(const Problem& problem) {
  return compose(problem).values;
}

Values start_values(const Problem& problem) {
  return problem.graph->edges_only ? initial_values(problem) : file_values(problem);
}

}  // namespace sg::factor
