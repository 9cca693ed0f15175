#include "lib/factor/linear.h"

#include <algorithm>

#include "lib/factor/relative.h"
#include "lib/geometry/numbers.h"

namespace sg::factor {
namespace {

using graph::Space;

// Constants, taken apart.
struct Constants {
  const double* c;

  int dim() const { return static_cast<int>(c[0]); }
  int ends() const { return static_cast<int>(c[1]); }
  Space space(int k) const { return static_cast<Space>(static_cast<int>(c[2 + k])); }
  const double* points() const { return c + 2 + ends(); }
};

// What of the first vertex no other sees: nothing but a camera's own numbers.
int own_dim(Space first) {
  return graph::space_dim(first) - graph::moving_dim(first);
}

// Calls part(row, column, step, slope) for every block of rows of y and its slope in vertex k's columns, and of a
// relative one in the first's, too, with an empty step.
template <bool relative>
void for_parts(const double* const* x, const Constants& constants, const auto& part) {
  const Space first = constants.space(0);
  const double* x0 = constants.points();
  int row = 0, column = 0;
  for (int k = 0; k < constants.ends(); ++k) {
    const Space space = constants.space(k);
    const int dim = graph::space_dim(space);
    if (relative && k > 0) {
      const Seen seen = seen_from(first, x[0], space, x[k]);
      const Difference d = difference(space, x0, seen.z.data());
      part(row, column, d.step, Slope(d.slope * seen.of_x));
      part(row, 0, Step(), Slope(d.slope * seen.of_pose));
      row += dim;
    } else {
      const Difference d = difference(space, x0, x[k]);
      const int rows = relative ? own_dim(first) : dim;
      if (rows > 0) part(row, column, Step(d.step.tail(rows)), Slope(d.slope.bottomRows(rows)));
      row += rows;
    }
    column += dim;
    x0 += graph::space_size(space);
  }
}

const double* offsets(const Constants& constants) {
  const double* d = constants.points();
  for (int k = 0; k < constants.ends(); ++k) d += graph::space_size(constants.space(k));
  return d;
}

using Matrix = Eigen::Map<Eigen::MatrixXd>;
using ConstMatrix = Eigen::Map<const Eigen::MatrixXd>;

template <bool relative>
void whitened_error(const double* const* x, const double* c, const Whitening& whitening,
                    double* r) {
  const Constants constants{c};
  const int dim = constants.dim();
  const ConstMatrix U(whitening.U, dim, dim);
  Eigen::Map<Eigen::VectorXd> error(r, dim);
  error.noalias() = -U * Eigen::Map<const Eigen::VectorXd>(offsets(constants), dim);
  for_parts<relative>(x, constants, [&](int row, int, const Step& step, const Slope&) {
    if (step.size() > 0) error.noalias() += U.middleCols(row, step.size()) * step;
  });
}

template <bool relative>
void linearize(const double* const* x, const double* c, const Whitening& whitening, double* block) {
  const Constants constants{c};
  const int dim = constants.dim();
  int columns = 0;
  for (int k = 0; k < constants.ends(); ++k) columns += graph::space_dim(constants.space(k));
  const ConstMatrix U(whitening.U, dim, dim);
  Matrix out(block, dim, columns + 1);
  out.leftCols(columns).setZero();
  for_parts<relative>(x, constants, [&](int row, int column, const Step&, const Slope& slope) {
    out.middleCols(column, slope.cols()).noalias() += U.middleCols(row, slope.rows()) * slope;
  });
  whitened_error<relative>(x, c, whitening, out.col(columns).data());
  out.col(columns) *= -1;
}

// Where the factor alone would have vertex `end`: from the first, and the first from any other pose.
bool place(const double* const* x, const double* c, int end, double* out) {
  const Constants constants{c};
  const Space first = constants.space(0);
  const double* z0 = constants.points();
  const double* d = offsets(constants) + own_dim(first);
  for (int k = 0; k < constants.ends(); ++k) {
    const Space space = constants.space(k);
    const bool wanted = end == 0 ? k > 0 && space == first : k == end;
    if (wanted) {
      std::array<double, max_size> z{};
      std::copy_n(z0, graph::space_size(space), z.data());
      retract(space, d, z.data());
      if (end > 0) {
        place_seen(first, x[0], space, z.data(), out);
      } else {  // as the first is seen from vertex k
        std::array<double, max_size> origin{};
        set_origin(first, origin.data());
        const Seen back = seen_from(space, z.data(), first, origin.data());
        place_seen(space, x[k], first, back.z.data(), out);
      }
      return true;
    }
    if (k > 0) d += graph::space_dim(space);
    z0 += graph::space_size(space);
  }
  return false;
}

}  // namespace

std::string misfit(graph::EdgeTag type, std::span<const Space> ends) {
  if (type == graph::EdgeTag::linear) return "";
  for (std::size_t k = 1; k < ends.size(); ++k) {
    if (!sees(ends[0], ends[k]))
      return " wants a pose first, and then vertices that are seen from it, of its plane or space";
  }
  return ends.size() > 1 ? "" : " wants more than one vertex";
}

int linear_constants(const graph::LinearSize& size, std::span<const Space> ends) {
  return 2 + static_cast<int>(ends.size()) + size.measurement;
}

bool prepare_linear(graph::EdgeTag type, std::span<const Space> ends, const double* numbers,
                    double* constants) {
  const int dim = graph::linear_size(type, ends).dim;
  *constants++ = dim;
  *constants++ = static_cast<double>(ends.size());
  for (const Space space : ends) *constants++ = static_cast<double>(space);
  const double* const first = constants;
  std::array<double, max_size> x{};
  for (std::size_t k = 0; k < ends.size(); ++k) {
    if (!from_file(ends[k], numbers, x.data())) return false;
    if (graph::has_quaternion(ends[k])) set_se3(normalized(geometry::se3(x.data())), x.data());
    const bool seen = type == graph::EdgeTag::linear_relative && k > 0;
    if (seen) x = seen_from(ends[0], first, ends[k], x.data()).z;
    std::copy_n(x.data(), graph::space_size(ends[k]), constants);
    numbers += graph::space_size(ends[k]);
    constants += graph::space_size(ends[k]);
  }
  std::copy_n(numbers, dim, constants);
  return true;
}

int linear_dim(const double* constants) {
  return Constants{constants}.dim();
}

Model linear_model(graph::EdgeTag type) {
  Model model{};
  model.type = type;
  model.tag = graph::name(type);
  const bool relative = type == graph::EdgeTag::linear_relative;
  model.error = relative ? whitened_error<true> : whitened_error<false>;
  model.linearize = relative ? linearize<true> : linearize<false>;
  if (relative) model.place = place;
  return model;
}

}  // namespace sg::factor
