#include <algorithm>

#include "lib/factor/edge_expmap.h"
#include "lib/factor/edge_point.h"
#include "lib/factor/edge_se2.h"
#include "lib/factor/edge_se2_point.h"
#include "lib/factor/edge_se3.h"
#include "lib/factor/edge_se3_point.h"
#include "lib/factor/model.h"

namespace sg {
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
  for (Space space : Type::ends) sum += space_dim(space);
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
    at += dim * space_dim(Type::ends[k]);
  }
  Type::evaluate(x, c, at, J.data());
  unwhitened.col(columns) *= -1;
  whiten<dim, columns + 1>(U, unwhitened, block);
}

template <class Type>
Model model() {
  Model row{};
  row.tag = Type::tag;
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

const std::array table{
    model<EdgeSe2>(),           model<EdgeSe2Offset>(),
    model<EdgePriorSe2>(),      model<EdgePriorSe2Xy>(),
    model<EdgeSe2Xy>(),         model<EdgeBearingSe2Xy>(),
    model<EdgePriorXy>(),       model<EdgePointXy>(),
    model<EdgeSe3Quat>(),       model<EdgeSe3Offset>(),
    model<EdgeSe3Prior>(),      model<EdgeSe3XyzPrior>(),
    model<EdgeSe3TrackXyz>(),   model<EdgeProjectDisparity>(),
    model<EdgeProjectDepth>(),  model<EdgePointXyz>(),
    model<EdgePointXyzPrior>(), model<EdgeSe3Expmap>(),
    model<EdgeProjectXyz2Uv>(), model<EdgeProjectXyz2Uvu>(),
    model<EdgeSe3ProjectXyz>(), model<EdgeStereoSe3ProjectXyz>(),
};

}  // namespace

std::span<const Model> models() {
  return table;
}

const Model* find_model(std::string_view edge_tag) {
  const auto row =
      std::find_if(table.begin(), table.end(), [&](const Model& m) { return m.tag == edge_tag; });
  return row == table.end() ? nullptr : &*row;
}

std::string_view name(ParamKind kind) {
  return std::array<std::string_view, 4>{"PARAMS_SE2OFFSET", "PARAMS_SE3OFFSET",
                                         "PARAMS_CAMERACALIB",
                                         "PARAMS_CAMERAPARAMETERS"}[static_cast<int>(kind)];
}

bool serves_as(ParamKind kind, std::string_view param_tag) {
  if (param_tag == name(kind)) return true;
  const bool stereo = param_tag == "PARAMS_STEREOCAMERACALIB";
  const bool camera = stereo || param_tag == name(ParamKind::camera_calibration);
  return (kind == ParamKind::camera_calibration && stereo) ||
         (kind == ParamKind::se3_offset && camera);
}

}  // namespace sg
