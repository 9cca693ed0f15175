#include <algorithm>
#include <utility>
#include <vector>

#include "lib/factor/edge_bal.h"
#include "lib/factor/edge_expmap.h"
#include "lib/factor/edge_point.h"
#include "lib/factor/edge_se2.h"
#include "lib/factor/edge_se2_point.h"
#include "lib/factor/edge_se3.h"
#include "lib/factor/edge_se3_point.h"
#include "lib/factor/linear.h"
#include "lib/factor/model.h"

namespace sg::factor {
namespace {

template <int rows, int cols>
using Block = Eigen::Matrix<double, rows, cols>;

// to := U from. Most information matrices are diagonal, and the product is most of the time.
template <int dim, int columns>
void whiten(const Whitening& whitening, const Block<dim, columns>& from, double* to) {
  const Eigen::Map<const Block<dim, dim>> U(whitening.U);
  Eigen::Map<Block<dim, columns>> result(to);
  if (whitening.diagonal) {
    result.noalias() = U.diagonal().asDiagonal() * from;
  } else {
    result.noalias() = U * from;
  }
}

template <class Type>
void whitened_error(const double* const* x, const double* c, const Whitening& U, double* r) {
  Block<Type::dim, 1> e;
  Type::evaluate(x, c, e.data(), nullptr);
  whiten<Type::dim, 1>(U, e, r);
}

template <class Type>
constexpr int columns_of() {
  int sum = 0;
  for (graph::Space space : Type::ends) sum += graph::space_dim(space);
  return sum;
}

template <class Type>
void linearize(const double* const* x, const double* c, const Whitening& U, double* block) {
  constexpr int dim = Type::dim, columns = columns_of<Type>();
  Block<dim, columns + 1> unwhitened;
  std::array<double*, max_ends> J{};
  double* at = unwhitened.data();
  for (std::size_t k = 0; k < Type::ends.size(); ++k) {
    J[k] = at;
    at += dim * graph::space_dim(Type::ends[k]);
  }
  Type::evaluate(x, c, at, J.data());
  unwhitened.col(columns) *= -1;
  whiten<dim, columns + 1>(U, unwhitened, block);
}

template <class Type>
Model model() {
  Model row{};
  row.type = Type::edge.type;
  row.tag = Type::edge.tag;
  row.dim = Type::dim;
  row.measurement = Type::measurement;
  row.extra = Type::extra;
  row.constants = Type::constants;
  row.arity = static_cast<int>(Type::ends.size());
  std::copy(Type::ends.begin(), Type::ends.end(), row.ends.begin());
  row.params = Type::params;
  row.prepare = Type::prepare;
  row.error = whitened_error<Type>;
  row.linearize = linearize<Type>;
  if constexpr (requires { Type::place; }) row.place = Type::place;
  if constexpr (requires { Type::rays; }) row.rays = Type::rays;
  return row;
}

template <graph::EdgeTag type>
void add_model(std::vector<Model>& table) {
  if constexpr (requires { EdgeModel<type>::evaluate; }) table.push_back(model<EdgeModel<type>>());
  if constexpr (graph::is_linear(type)) table.push_back(linear_model(type));
}

template <std::size_t... type>
std::vector<Model> all_models(std::index_sequence<type...>) {
  std::vector<Model> table;
  (add_model<static_cast<graph::EdgeTag>(type)>(table), ...);
  return table;
}

// By type; null for those without a model.
std::array<const Model*, graph::edge_rows.size()> by_type() {
  std::array<const Model*, graph::edge_rows.size()> result{};
  for (const Model& m : models()) result[static_cast<std::size_t>(m.type)] = &m;
  return result;
}

}  // namespace

std::span<const Model> models() {
  static const auto table = all_models(std::make_index_sequence<graph::edge_rows.size()>());
  return table;
}

const Model* find_model(graph::EdgeTag type) {
  static const auto table = by_type();
  const auto index = static_cast<std::size_t>(type);
  return index < table.size() ? table[index] : nullptr;
}

}  // namespace sg::factor
