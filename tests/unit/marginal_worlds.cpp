#include "tests/unit/marginal_worlds.h"

#include <cmath>
#include <iomanip>
#include <sstream>

#include "formats/write.h"
#include "lib/factor/linearize.h"
#include "lib/factor/relative.h"

namespace sg::test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

std::string numbers(const std::vector<double>& values) {
  std::ostringstream text;
  text << std::setprecision(17);
  for (const double value : values) text << " " << value;
  return text.str();
}

std::vector<double> random_numbers(Random& random, int count, double size) {
  std::vector<double> values(count);
  for (double& value : values) value = uniform(random, -size, size);
  return values;
}

std::vector<double> random_triangle(Random& random, int dim) {
  const MatrixXd root = MatrixXd::NullaryExpr(dim, dim, [&] { return uniform(random, -1, 1); }) +
                        2 * MatrixXd::Identity(dim, dim);
  const MatrixXd W = root.transpose() * root;
  std::vector<double> triangle;
  for (int i = 0; i < dim; ++i) {
    for (int j = i; j < dim; ++j) triangle.push_back(W(i, j));
  }
  return triangle;
}

std::string random_text(Random& random, const World& world) {
  std::vector<std::vector<double>> estimates;
  std::string text = world.plane ? "" : "PARAMS_SE3OFFSET 3 0.1 0.2 0.1 0 0 0 1\n";
  const int dim = world.plane ? 3 : 6;
  const auto relative = [&](double ahead) {
    std::vector<double> z = random_numbers(random, dim, 0.2);
    z[0] += ahead;
    if (world.plane) return z;
    const double w = std::sqrt(1 - z[3] * z[3] - z[4] * z[4] - z[5] * z[5]);
    z.push_back(w);
    return z;
  };
  for (int k = 0; k < world.poses; ++k) {
    estimates.push_back(relative(k));
    text += (world.plane ? "VERTEX_SE2 " : "VERTEX_SE3:QUAT ") + std::to_string(k) +
            numbers(estimates.back()) + "\n";
  }
  for (int k = 0; k < world.landmarks; ++k)
    text += (world.plane ? "VERTEX_XY " : "VERTEX_TRACKXYZ ") + std::to_string(100 + k) +
            numbers(random_numbers(random, dim == 3 ? 2 : 3, 5)) + "\n";
  const auto seen = [&](int i, int j) {
    const auto space = world.plane ? graph::Space::se2 : graph::Space::se3;
    const auto z = factor::seen_from(space, estimates[i].data(), space, estimates[j].data()).z;
    return std::vector<double>(z.begin(), z.begin() + graph::space_size(space));
  };
  const auto edge = [&](int i, int j) {
    text += (world.plane ? "EDGE_SE2 " : "EDGE_SE3:QUAT ") + std::to_string(i) + " " +
            std::to_string(j) + numbers(world.consistent ? seen(i, j) : relative(j - i)) +
            numbers(random_triangle(random, dim)) + "\n";
  };
  for (int k = 1; k < world.poses; ++k) edge(k - 1, k);
  for (int k = 0; k < world.closures; ++k) {
    const int i = draw(random, 0, world.poses - 1), j = draw(random, 0, world.poses - 1);
    if (i != j) edge(i, j);
  }
  for (int k = 0; k < world.landmarks; ++k) {
    for (int sight = 0; sight < 4; ++sight) {
      const std::string ends =
          std::to_string(draw(random, 0, world.poses - 1)) + " " + std::to_string(100 + k);
      const int size = world.plane ? 2 : 3;
      text += (world.plane ? "EDGE_SE2_XY " + ends : "EDGE_SE3_TRACKXYZ " + ends + " 3") +
              numbers(random_numbers(random, size, 3)) + numbers(random_triangle(random, size)) +
              "\n";
    }
  }
  if (world.anchored && world.plane)
    text += "EDGE_PRIOR_SE2 " + std::to_string(draw(random, 0, world.poses - 1)) +
            numbers(random_numbers(random, 3, 1)) + numbers(random_triangle(random, 3)) + "\n";
  return text;
}

marginalize::Piece Subject::whole() const {
  std::vector<marginalize::Piece> pieces;
  std::vector<const marginalize::Piece*> all;
  pieces.reserve(graph.edges() + 1);
  marginalize::Piece& none = pieces.emplace_back();  // of every vertex
  for (Index v = 0; v < graph.vertices(); ++v) none.vertices.push_back(v);
  const int dim = marginalize::total_dim(at(), none.vertices);
  none.information = MatrixXd::Zero(dim, dim);
  none.gradient = VectorXd::Zero(dim);
  all.push_back(&none);
  for (Index e = 0; e < graph.edges(); ++e) {
    pieces.push_back(marginalize::piece_of_edge(at(), e));
    all.push_back(&pieces.back());
  }
  return marginalize::sum(at(), all);
}

Gaussian schur(const Subject& of, const std::vector<bool>& removed) {
  const marginalize::Piece all = of.whole();
  const std::vector<int> start = marginalize::starts(of.at(), all.vertices);
  std::vector<int> stay, go;
  for (std::size_t k = 0; k < all.vertices.size(); ++k) {
    for (int i = start[k]; i < start[k + 1]; ++i)
      (removed[all.vertices[k]] ? go : stay).push_back(i);
  }
  const MatrixXd W = all.information, solved = W(go, go).ldlt().solve(W(go, stay));
  return {W(stay, stay) - W(stay, go) * solved,
          all.gradient(stay) - solved.transpose() * all.gradient(go)};
}

std::string rewritten(const Subject& of, marginalize::Marginalization result) {
  formats::Changes changes = formats::unchanged(of.graph);
  changes.drop_vertex = std::move(result.vertex);
  changes.drop_edge = std::move(result.edge);
  changes.append = std::move(result.lines);
  StringSink sink;
  formats::write_changed(of.graph, std::move(changes), "", sink);
  return sink.text;
}

std::vector<bool> some_vertices(Random& random, const Graph& graph) {
  std::vector<bool> removed(graph.vertices(), false);
  for (Index v = 1; v < graph.vertices(); ++v) removed[v] = draw(random, 0, 2) > 0;
  removed[2] = true;
  return removed;
}

}  // namespace sg::test
