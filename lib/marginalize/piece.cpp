#include "lib/marginalize/piece.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <numeric>

#include "lib/factor/linear.h"
#include "lib/factor/linearize.h"
#include "lib/factor/relative.h"
#include "lib/text/words.h"

namespace sg::marginalize {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Of an eigenvalue, beside the largest: what is below it is rounding.
constexpr double no_information = 1e-12;

// Adds the blocks of `from`'s vertices to their places in `to`, which has all of them.
void add(const At& at, const Piece& from, Piece& to) {
  const std::vector<int> own = starts(at, from.vertices), all = starts(at, to.vertices);
  std::vector<int> place;
  for (const Index v : from.vertices) {
    const auto found = std::ranges::lower_bound(to.vertices, v);
    place.push_back(all[found - to.vertices.begin()]);
  }
  for (std::size_t i = 0; i < from.vertices.size(); ++i) {
    const int rows = own[i + 1] - own[i];
    to.gradient.segment(place[i], rows) += from.gradient.segment(own[i], rows);
    for (std::size_t j = 0; j < from.vertices.size(); ++j) {
      const int columns = own[j + 1] - own[j];
      to.information.block(place[i], place[j], rows, columns) +=
          from.information.block(own[i], own[j], rows, columns);
    }
  }
}

// W^+ b of a positive semidefinite W, whatever the units of its rows.
MatrixXd solve_semidefinite(const MatrixXd& W, const MatrixXd& b) {
  VectorXd scale = W.diagonal();
  for (double& s : scale) s = s > 0 ? 1 / std::sqrt(s) : 0;
  const MatrixXd scaled = scale.asDiagonal() * W * scale.asDiagonal();
  const Eigen::LLT<MatrixXd> cholesky(scaled);
  if (cholesky.info() == Eigen::Success && cholesky.rcond() > no_information)
    return scale.asDiagonal() * cholesky.solve(scale.asDiagonal() * b);
  const Eigen::SelfAdjointEigenSolver<MatrixXd> spectrum(scaled);
  VectorXd inverse = spectrum.eigenvalues();
  const double least = no_information * std::max(0.0, inverse[inverse.size() - 1]);
  for (double& value : inverse) value = value > least ? 1 / value : 0;
  const auto& V = spectrum.eigenvectors();
  return scale.asDiagonal() *
         (V * (inverse.asDiagonal() * (V.transpose() * (scale.asDiagonal() * b))));
}

// The vertices with that first from which all others are seen, if there is one; else in their own order.
std::vector<Index> root_first(const At& at, const Piece& piece) {
  std::vector<Index> order = piece.vertices;
  const auto sees_all = [&](Index root) {
    return std::ranges::all_of(order,
                               [&](Index v) { return factor::sees(at.space(root), at.space(v)); });
  };
  const auto root = std::ranges::find_if(order, sees_all);
  if (root != order.end()) std::rotate(order.begin(), root, root + 1);
  return order;
}

// The places of the scalars of these vertices, in this order, in the step of a piece.
std::vector<int> places(const At& at, const Piece& piece, std::span<const Index> order) {
  const std::vector<int> start = starts(at, piece.vertices);
  std::vector<int> result;
  for (const Index v : order) {
    const auto place = std::ranges::lower_bound(piece.vertices, v) - piece.vertices.begin();
    for (int k = start[place]; k < start[place + 1]; ++k) result.push_back(k);
  }
  return result;
}

// The slope of a linear factor's y (lib/graph/linear.h) at its linearization point, in the steps of these vertices.
MatrixXd slope_of(const At& at, graph::EdgeTag type, std::span<const Index> vertices) {
  std::vector<graph::Space> spaces;
  std::vector<double> numbers;
  std::vector<const double*> x;
  for (const Index v : vertices) {
    spaces.push_back(at.space(v));
    x.push_back(at.x(v));
    const auto own = factor::estimate_numbers(at.problem, at.values, v);
    numbers.insert(numbers.end(), own.begin(), own.end());
  }
  const graph::LinearSize size = graph::linear_size(type, spaces);
  numbers.resize(size.measurement, 0.0);
  std::vector<double> constants(factor::linear_constants(size, spaces));
  factor::prepare_linear(type, spaces, numbers.data(), constants.data());
  const MatrixXd identity = MatrixXd::Identity(size.dim, size.dim);
  MatrixXd block(size.dim, total_dim(at, vertices) + 1);
  factor::find_model(type)->linearize(x.data(), constants.data(), {identity.data(), true},
                                      block.data());
  return block.leftCols(block.cols() - 1);
}

}  // namespace

int total_dim(const At& at, std::span<const Index> vertices) {
  return starts(at, vertices).back();
}

std::vector<int> starts(const At& at, std::span<const Index> vertices) {
  std::vector<int> result{0};
  for (const Index v : vertices) result.push_back(result.back() + at.dim(v));
  return result;
}

std::vector<int> starts_of_all(const At& at) {
  std::vector<Index> all(at.problem.graph->vertices());
  std::iota(all.begin(), all.end(), 0);
  return starts(at, all);
}

bool is_absolute(const At& at, Index e) {
  const Graph& graph = *at.problem.graph;
  const auto ends = graph.edge(e);
  const auto is_pose = [&](Index v) { return graph.role(v) == graph::Role::pose; };
  return std::ranges::all_of(ends, [&](Index v) { return v == ends[0]; }) ||
         std::ranges::none_of(ends, is_pose) || graph.edge_tag(e) == graph::EdgeTag::linear;
}

Piece piece_of_edge(const At& at, Index e) {
  const Graph& graph = *at.problem.graph;
  const auto ends = graph.edge(e);
  Piece piece;
  piece.vertices.assign(ends.begin(), ends.end());
  std::ranges::sort(piece.vertices);
  piece.vertices.erase(std::unique(piece.vertices.begin(), piece.vertices.end()),
                       piece.vertices.end());
  piece.absolute = is_absolute(at, e);

  const int height = factor::dim_of(at.problem, e), width = total_dim(at, ends) + 1;
  MatrixXd block(height, width);
  at.problem.model[e]->linearize(factor::ends_of(at.problem, at.values, e).data(),
                                 factor::constants_of(at.problem, e),
                                 factor::whitening_of(at.problem, e), block.data());
  factor::check_row(at.problem, e, {block.data(), static_cast<std::size_t>(block.size())});
  const std::vector<int> from = starts(at, ends), to = starts(at, piece.vertices);
  MatrixXd J = MatrixXd::Zero(height, to.back());
  for (std::size_t k = 0; k < ends.size(); ++k) {
    const auto place = std::ranges::lower_bound(piece.vertices, ends[k]) - piece.vertices.begin();
    J.middleCols(to[place], at.dim(ends[k])) += block.middleCols(from[k], at.dim(ends[k]));
  }
  piece.information = J.transpose() * J;
  piece.gradient = J.transpose() * block.col(width - 1);
  return piece;
}

Piece sum(const At& at, std::span<const Piece* const> pieces) {
  Piece result;
  for (const Piece* piece : pieces) {
    result.vertices.insert(result.vertices.end(), piece->vertices.begin(), piece->vertices.end());
    result.absolute |= piece->absolute;
  }
  std::ranges::sort(result.vertices);
  result.vertices.erase(std::unique(result.vertices.begin(), result.vertices.end()),
                        result.vertices.end());
  const int dim = total_dim(at, result.vertices);
  result.information = MatrixXd::Zero(dim, dim);
  result.gradient = VectorXd::Zero(dim);
  for (const Piece* piece : pieces) add(at, *piece, result);
  return result;
}

Piece eliminated(const At& at, const Piece& piece, Index v) {
  const std::vector<int> start = starts(at, piece.vertices);
  const auto place = std::ranges::lower_bound(piece.vertices, v) - piece.vertices.begin();
  const int first = start[place], dim = at.dim(v), after = start.back() - first - dim;
  const MatrixXd& W = piece.information;
  Piece result{piece.vertices, MatrixXd(first + after, first + after), VectorXd(first + after),
               piece.absolute};
  result.vertices.erase(result.vertices.begin() + place);
  MatrixXd side(dim, first + after + 1);  // [W_v,rest g_v]
  side << W.block(first, 0, dim, first), W.block(first, first + dim, dim, after),
      piece.gradient.segment(first, dim);
  const MatrixXd gain = solve_semidefinite(W.block(first, first, dim, dim), side);
  result.information << W.topLeftCorner(first, first), W.topRightCorner(first, after),
      W.bottomLeftCorner(after, first), W.bottomRightCorner(after, after);
  result.gradient << piece.gradient.head(first), piece.gradient.tail(after);
  const auto rest = side.leftCols(first + after);
  result.information.noalias() -= rest.transpose() * gain.leftCols(first + after);
  result.gradient.noalias() -= rest.transpose() * gain.rightCols<1>();
  result.information = (result.information + result.information.transpose().eval()) / 2;
  return result;
}

std::string linear_line(const At& at, const Piece& piece) {
  const Graph& graph = *at.problem.graph;
  if (piece.information.isZero(0)) return "";
  std::vector<Index> order = piece.vertices;
  if (!piece.absolute && order.size() > 1) order = root_first(at, piece);
  const bool relative =
      !piece.absolute && order.size() > 1 && std::ranges::all_of(order, [&](Index v) {
        return factor::sees(at.space(order[0]), at.space(v));
      });
  const auto type = relative ? graph::EdgeTag::linear_relative : graph::EdgeTag::linear;
  std::string line(graph::name(type));
  line += " " + std::to_string(graph.id[order[0]]) + " " + std::to_string(order.size() - 1);
  for (std::size_t k = 1; k < order.size(); ++k) line += " " + std::to_string(graph.id[order[k]]);
  for (const Index v : order) line += " " + factor::estimate_text(at.problem, at.values, v);

  // y needs no columns of the first one's motion; the rest of its slope is square.
  const MatrixXd J = slope_of(at, type, order);
  const auto dim = J.rows();
  const std::vector<int> place = places(at, piece, order);
  const std::vector<int> rest(place.end() - dim, place.end());
  const Eigen::PartialPivLU<MatrixXd> back(J.rightCols(dim).transpose());
  MatrixXd W = back.solve(piece.information(rest, rest));
  W = back.solve(W.transpose().eval());
  W = (W + W.transpose().eval()) / 2;
  const VectorXd d = solve_semidefinite(W, back.solve(piece.gradient(rest)));
  std::vector<double> numbers(d.begin(), d.end());
  for (Eigen::Index i = 0; i < dim; ++i) {
    for (Eigen::Index k = i; k < dim; ++k) numbers.push_back(W(i, k));
  }
  text::append_numbers(line, numbers);
  return line + "\n";
}

}  // namespace sg::marginalize
