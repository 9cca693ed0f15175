#include "lib/marginalize/measurement.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "lib/factor/relative.h"
#include "lib/factor/whitening.h"
#include "lib/geometry/triangle.h"
#include "lib/text/words.h"

namespace sg::marginalize {
namespace {

using graph::EdgeTag;
using graph::Space;

constexpr std::array<double, 7> no_offset{0, 0, 0, 0, 0, 0, 1};

// Of one vertex, Space::none for the second; of two of these spaces, in this order.
struct Row {
  Space first, second;
  EdgeTag type;
};
constexpr std::array table{
    Row{Space::se2, Space::se2, EdgeTag::se2},
    Row{Space::se2, Space::xy, EdgeTag::se2_xy},
    Row{Space::se3, Space::se3, EdgeTag::se3},
    Row{Space::se3, Space::xyz, EdgeTag::se3_trackxyz},
    Row{Space::expmap, Space::expmap, EdgeTag::expmap},
    Row{Space::xy, Space::xy, EdgeTag::pointxy},
    Row{Space::xyz, Space::xyz, EdgeTag::pointxyz},
    Row{Space::se2, Space::none, EdgeTag::prior_se2},
    Row{Space::xy, Space::none, EdgeTag::prior_xy},
    Row{Space::se3, Space::none, EdgeTag::se3_prior},
    Row{Space::xyz, Space::none, EdgeTag::pointxyz_prior},
};
std::optional<EdgeTag> type_for(Space first, Space second) {
  const auto row = std::ranges::find_if(
      table, [&](const Row& r) { return r.first == first && r.second == second; });
  return row == table.end() ? std::nullopt : std::optional(row->type);
}

std::vector<Index> ends(const Measurable& of) {
  return of.second < 0 ? std::vector{of.first} : std::vector{of.first, of.second};
}

std::vector<double> in_file(Space space, const double* x) {
  std::vector<double> numbers(graph::space_size(space));
  factor::to_file(space, x, numbers.data());
  return numbers;
}

// [J -e] of the edge with these numbers, whitened by this information.
Eigen::MatrixXd linearized(const At& at, const Measurable& of, const std::vector<double>& numbers,
                           const Eigen::MatrixXd& information) {
  const factor::Model& model = *factor::find_model(of.type);
  std::vector<double> constants(model.constants), U(model.dim * model.dim), triangle;
  const double* const params[] = {no_offset.data()};
  const bool sound = model.prepare(numbers.data(), params, constants.data());
  assert(sound);
  for (int i = 0; i < model.dim; ++i) {
    for (int j = i; j < model.dim; ++j) triangle.push_back(information(i, j));
  }
  factor::whitening(triangle, model.dim, U.data());
  const auto vertices = ends(of);
  std::vector<const double*> x;
  x.reserve(vertices.size());
  for (const Index v : vertices) x.push_back(at.x(v));
  Eigen::MatrixXd block(model.dim, total_dim(at, vertices) + 1);
  model.linearize(x.data(), constants.data(), {U.data(), false}, block.data());
  return sound ? block : Eigen::MatrixXd();
}

}  // namespace

std::optional<Measurable> between(const At& at, Index u, Index v) {
  const Graph& graph = *at.problem.graph;
  const bool pose_first = graph.role(u) == graph::Role::pose && graph.role(v) != graph::Role::pose;
  const bool pose_last = graph.role(v) == graph::Role::pose && graph.role(u) != graph::Role::pose;
  if (pose_last || (!pose_first && v < u)) std::swap(u, v);
  const auto type = type_for(at.space(u), at.space(v));
  return type ? std::optional(Measurable{*type, u, v}) : std::nullopt;
}

std::optional<Measurable> prior(const At& at, Index v) {
  const auto type = type_for(at.space(v), Space::none);
  return type ? std::optional(Measurable{*type, v}) : std::nullopt;
}

std::vector<double> measured(const At& at, const Measurable& of, const Eigen::VectorXd& first,
                             const Eigen::VectorXd& second) {
  const auto moved = [&](Index v, const Eigen::VectorXd& step) {
    std::vector<double> x(at.x(v), at.x(v) + graph::space_size(at.space(v)));
    factor::retract(at.space(v), step.data(), x.data());
    return x;
  };
  const Space space = at.space(of.first);
  const std::vector<double> x = moved(of.first, first);
  if (of.second < 0) return in_file(space, x.data());
  const Space other = at.space(of.second);
  std::vector<double> y = moved(of.second, second);
  if (factor::sees(space, other))
    return in_file(other, factor::seen_from(space, x.data(), other, y.data()).z.data());
  std::ranges::transform(y, x, y.begin(), std::minus());  // two landmarks
  return y;
}

std::vector<double> measured(const At& at, const Measurable& of) {
  const auto zero = [&](Index v) -> Eigen::VectorXd {
    return Eigen::VectorXd::Zero(v < 0 ? 0 : at.dim(v));
  };
  return measured(at, of, zero(of.first), zero(of.second));
}

Eigen::MatrixXd slope(const At& at, const Measurable& of) {
  return slope(at, of, measured(at, of));
}

Eigen::MatrixXd slope(const At& at, const Measurable& of, const std::vector<double>& numbers) {
  const int dim = factor::find_model(of.type)->dim;
  const Eigen::MatrixXd block = linearized(at, of, numbers, Eigen::MatrixXd::Identity(dim, dim));
  return block.leftCols(block.cols() - 1);
}

Eigen::VectorXd lack(const At& at, const Measurable& of, const std::vector<double>& numbers) {
  const int dim = factor::find_model(of.type)->dim;
  return linearized(at, of, numbers, Eigen::MatrixXd::Identity(dim, dim)).rightCols<1>();
}

Piece piece_of(const At& at, const Measurement& m) {
  const Eigen::MatrixXd block = linearized(at, m.of, m.numbers, m.information);
  Piece piece;
  piece.absolute = m.of.second < 0;
  piece.vertices = ends(m.of);
  const auto width = block.cols() - 1;
  Eigen::MatrixXd J = block.leftCols(width);
  if (m.of.second >= 0 && m.of.second < m.of.first) {
    const int dim = at.dim(m.of.first);
    J << block.middleCols(dim, width - dim), block.leftCols(dim);
    std::ranges::reverse(piece.vertices);
  }
  piece.information = J.transpose() * J;
  piece.gradient = J.transpose() * block.col(width);
  return piece;
}

std::optional<graph::ParamTag> parameter(EdgeTag type) {
  const graph::EdgeRow& row = graph::row(type);
  return row.params.size > 0 ? std::optional(row.params[0]) : std::nullopt;
}

std::string line(const Graph& graph, const Measurement& m, Id parameter_id) {
  std::string text(graph::name(m.of.type));
  for (const Index v : ends(m.of)) text += " " + std::to_string(graph.id[v]);
  if (parameter(m.of.type)) text += " " + std::to_string(parameter_id);
  text::append_numbers(text, m.numbers);
  std::vector<double> triangle;
  for (Eigen::Index i = 0; i < m.information.rows(); ++i) {
    for (Eigen::Index j = i; j < m.information.cols(); ++j) triangle.push_back(m.information(i, j));
  }
  text::append_numbers(text, triangle);
  return text + "\n";
}

}  // namespace sg::marginalize
