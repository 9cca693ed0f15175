#include "lib/factor/gauge.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numeric>

#include "lib/geometry/numbers.h"
#include "lib/graph/components.h"

namespace sg::factor {
namespace {

// Columns: translation along x, y, z, rotation about them, change of scale.
constexpr int motions = 7, rigid = 6;
using Motions = Eigen::Matrix<double, Eigen::Dynamic, motions>;
using Gram = Eigen::Matrix<double, motions, motions>;

constexpr double unnoticed = 1e-9;     // of a motion by a row, beside the length of A's own
constexpr double uninformed = 1e-7;    // length of a row of A, beside the longest of its edge
constexpr double least_share = 1e-12;  // of an eigenvalue, beside the largest: 1e-6 of a motion

// Motions turn and scale about the centre, in units of the radius: so all are of like size.
struct Frame {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double radius = 1;
};

Eigen::Vector3d position(graph::Space space, const double* x) {
  switch (space) {
    case graph::Space::se2:
    case graph::Space::xy:
      return {x[0], x[1], 0};
    case graph::Space::expmap:
    case graph::Space::bal_camera:
      return inverse(geometry::se3(x)).t;
    default:
      return geometry::vector3(x);
  }
}

Eigen::Vector3d position(const Problem& problem, const Values& values, Index v) {
  return position(problem.space[v], values.data() + problem.value_at[v]);
}

Frame frame_of(const Problem& problem, const Values& values, std::span<const Index> vertices) {
  Frame frame;
  for (Index v : vertices) frame.center += position(problem, values, v);
  if (!vertices.empty()) frame.center /= static_cast<double>(vertices.size());
  double radius = 0;
  for (Index v : vertices) {
    radius = std::max(radius, (position(problem, values, v) - frame.center).norm());
  }
  if (radius > 0 && std::isfinite(radius)) frame.radius = radius;
  return frame;
}

// The steps (space.h) of vertex v that the motions make.
Motions motions_of(const Problem& problem, const Values& values, Index v, const Frame& frame) {
  const graph::Space space = problem.space[v];
  const double* const x = values.data() + problem.value_at[v];
  const Eigen::Vector3d p = (position(space, x) - frame.center) / frame.radius;
  Eigen::Matrix<double, 3, motions> moved, turned;
  moved << Eigen::Matrix3d::Identity(), -geometry::skew(p), p;
  turned << Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Identity() / frame.radius,
      Eigen::Vector3d::Zero();
  Motions step = Motions::Zero(graph::space_dim(space), motions);
  switch (space) {
    case graph::Space::se2:
      step << moved.topRows(2), turned.bottomRows(1);
      break;
    case graph::Space::se3: {
      const Eigen::Matrix3d to_body = geometry::se3(x).q.toRotationMatrix().transpose();
      step << to_body * moved, to_body * turned / 2;
      break;
    }
    case graph::Space::expmap:
    case graph::Space::bal_camera: {
      const Eigen::Matrix3d to_camera = geometry::se3(x).q.toRotationMatrix();
      step.topRows<rigid>() << -to_camera * turned, -to_camera * moved;
      break;
    }
    case graph::Space::xy:
      step = moved.topRows(2);
      break;
    default:
      step = moved;
  }
  return step;
}

// What of the motions one row of the system notices, line by line, beside the length of A's own lines.
struct Noticed {
  Motions motions;
  Eigen::VectorXd length;
};
Noticed noticed(const Problem& problem, const Values& values, const Frame& frame, Index r,
                const double* block) {
  const int height = dim_of(problem, r);
  Noticed result{Motions::Zero(height, motions), Eigen::VectorXd::Zero(height)};
  for (Index j : problem.variables.pattern.rows[r]) {
    const int dim = problem.variables.pattern.dim[j];
    const Eigen::Map<const Eigen::MatrixXd> A(block, height, dim);
    result.motions += A * motions_of(problem, values, problem.variables.variable_vertex[j], frame);
    result.length += A.rowwise().squaredNorm();
    block += height * dim;
  }
  result.length = result.length.cwiseSqrt();
  return result;
}

int rank(const Gram& gram) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, rigid, rigid>> spectrum(
      Eigen::Matrix<double, rigid, rigid>(gram.topLeftCorner<rigid, rigid>()));
  const auto& values = spectrum.eigenvalues();
  return static_cast<int>(
      std::ranges::count_if(values, [&](double x) { return x > least_share * values[rigid - 1]; }));
}

// Of all vertices, their number if there is none.
Index first_pose(const Graph& graph) {
  Index v = 0;
  while (v < graph.vertices() && graph.role(v) != graph::Role::pose) ++v;
  return v;
}

}  // namespace

Eigen::MatrixXd rigid_motions(const Problem& problem, const Values& values) {
  std::vector<Index> vertices(problem.graph->vertices());
  std::iota(vertices.begin(), vertices.end(), 0);
  const Frame frame = frame_of(problem, values, vertices);
  Eigen::MatrixXd result(problem.step_at.back(), rigid);
  for (Index j = 0; j < problem.variables.pattern.variables(); ++j) {
    const Motions steps = motions_of(problem, values, problem.variables.variable_vertex[j], frame);
    result.middleRows(problem.step_at[j], steps.rows()) = steps.leftCols<rigid>();
  }
  return result;
}

bool is_anchor(const Problem& problem, Index e) {
  const Graph& graph = *problem.graph;
  const auto ends = graph.edge(e);
  return ends.size() == 1 || graph.edge_tag(e) == graph::EdgeTag::linear ||
         std::ranges::any_of(ends, [&](Index v) { return bool(graph.fixed[v]); }) ||
         std::ranges::none_of(ends, [&](Index v) { return graph.role(v) == graph::Role::pose; });
}

bool holds_gauge(const Problem& problem, const Values& values, std::span<const Index> vertices,
                 std::span<const Index> edges) {
  assert(problem.held < 0);
  const Frame whole = frame_of(problem, values, vertices);
  Gram all = Gram::Zero();
  for (Index v : vertices) {
    const Motions step = motions_of(problem, values, v, whole);
    all += step.transpose() * step;
  }
  std::vector<Index> anchors, anchored;
  for (Index e : edges) {
    const auto variables = problem.variables.pattern.rows[e];
    if (variables.empty() || !is_anchor(problem, e)) continue;
    anchors.push_back(e);
    for (Index j : variables) anchored.push_back(problem.variables.variable_vertex[j]);
  }
  const Frame frame = frame_of(problem, values, anchored);
  Gram gram = Gram::Zero();
  for (Index e : anchors) {
    Room<double, max_block> block(block_rows(problem, e) *
                                  block_columns(problem.variables.pattern, e));
    linearize_row(problem, values, {}, e, block.data());
    const Noticed rows = noticed(problem, values, frame, e, block.data());
    for (Eigen::Index i = 0; i < rows.length.size(); ++i) {
      const double size = rows.motions.row(i).norm();
      if (!(size > unnoticed * rows.length[i]) || !std::isfinite(size)) continue;
      if (rows.length[i] <= uninformed * rows.length.maxCoeff()) continue;
      gram += rows.motions.row(i).transpose() * rows.motions.row(i) / (size * size);
    }
  }
  return rank(gram) >= rank(all);
}

bool holds_gauge(const Problem& problem, const Values& values) {
  std::vector<Index> edges(problem.graph->edges());
  std::iota(edges.begin(), edges.end(), 0);
  return holds_gauge(problem, values, problem.variables.variable_vertex, edges);
}

bool holds_first_pose(const Problem& problem, const Values& values) {
  const Graph& graph = *problem.graph;
  const Index first = first_pose(graph);
  if (first >= graph.vertices() || graph.fixed[first]) return true;
  std::vector<Index> edges;
  for (Index e = 0; e < graph.edges(); ++e) {
    const auto variables = problem.variables.pattern.rows[e];
    if (variables.size() == 1 && problem.variables.variable_vertex[variables[0]] == first)
      edges.push_back(e);
  }
  return holds_gauge(problem, values, std::array{first}, edges);
}

void hold_first_pose(Problem& problem) {
  assert(problem.held < 0);
  if (problem.variables.variable_vertex.empty()) return;
  const auto is_pose = [&](Index v) { return problem.graph->role(v) == graph::Role::pose; };
  const auto pose = std::ranges::find_if(problem.variables.variable_vertex, is_pose);
  const bool none = pose == problem.variables.variable_vertex.end();
  problem.held = none ? 0 : static_cast<Index>(pose - problem.variables.variable_vertex.begin());
  problem.variables.pattern.rows.add(std::array{problem.held});
}

std::vector<bool> anchors(const Problem& problem, const std::vector<bool>& edge_left_out) {
  const Graph& graph = *problem.graph;
  const graph::Components parts = graph::components(graph, edge_left_out);
  std::vector<bool> stays = graph.fixed, anchored(parts.count, false);
  if (problem.held >= 0) stays[problem.variables.variable_vertex[problem.held]] = true;
  for (Index v = 0; v < graph.vertices(); ++v) {
    if (stays[v]) anchored[parts.of[v]] = true;
  }
  for (Index e = 0; e < graph.edges(); ++e) {
    if (!edge_left_out[e] && graph.edge(e).size() == 1) anchored[parts.of[graph.edge(e)[0]]] = true;
  }
  for (const bool any : {false, true}) {  // of a part's vertices a pose, if there is one
    for (Index v = 0; v < graph.vertices(); ++v) {
      if (!anchored[parts.of[v]] && (any || graph.role(v) == graph::Role::pose))
        stays[v] = anchored[parts.of[v]] = true;
    }
  }
  return stays;
}

std::vector<double> free_scaling(const Problem& problem, const Values& values,
                                 const LinearSystem& system) {
  const auto& vertex = problem.variables.variable_vertex;
  const Frame frame = frame_of(problem, values, vertex);
  // Of every row of every edge, as a share of the row.
  const auto for_rows = [&](auto&& work) {
    for (Index e = 0; e < problem.graph->edges(); ++e) {
      const Noticed rows = noticed(problem, values, frame, e, system.block(e));
      for (Eigen::Index i = 0; i < rows.length.size(); ++i) {
        if (rows.length[i] > 0) work((rows.motions.row(i) / rows.length[i]).eval());
      }
    }
    for (Index v = 0; v < problem.graph->vertices(); ++v) {  // what must not move counts, too
      const Index j = problem.variables.vertex_variable[v];
      if (j >= 0 && j != problem.held) continue;
      const Motions rows = motions_of(problem, values, v, frame);
      for (Eigen::Index i = 0; i < rows.rows(); ++i) work(rows.row(i).eval());
    }
  };
  Gram gram = Gram::Zero();
  for_rows([&](const auto& row) { gram += row.transpose() * row; });
  const Eigen::SelfAdjointEigenSolver<Gram> spectrum(gram);
  // The scale's projection onto what nothing notices, so far as squares tell; then row by row.
  Eigen::Matrix<double, motions, 1> scaling = Eigen::Matrix<double, motions, 1>::Zero();
  for (int k = 0; k < motions; ++k) {
    if (spectrum.eigenvalues()[k] > least_share * spectrum.eigenvalues()[motions - 1]) continue;
    scaling += spectrum.eigenvectors()(motions - 1, k) * spectrum.eigenvectors().col(k);
  }
  bool free = scaling.norm() > 1e-6;
  for_rows(
      [&](const auto& row) { free &= std::abs(row.dot(scaling)) <= unnoticed * scaling.norm(); });
  if (!free) return {};
  std::vector<double> step(problem.step_at.back());
  for (std::size_t j = 0; j < vertex.size(); ++j) {
    if (static_cast<Index>(j) == problem.held) continue;
    const Eigen::VectorXd part = motions_of(problem, values, vertex[j], frame) * scaling;
    std::copy(part.begin(), part.end(), step.begin() + problem.step_at[j]);
  }
  return step;
}

}  // namespace sg::factor
