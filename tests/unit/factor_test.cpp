#include <Eigen/Core>
#include <catch2/catch.hpp>
#include <random>

#include "formats/formats.h"
#include "lib/factor/initialize.h"
#include "lib/factor/linearize.h"

using namespace sg;

namespace {

std::mt19937 random_bits(11);
double uniform(double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random_bits);
}

// A random estimate; a pose far enough from landmarks at `ahead` that they are in front of its
// camera.
std::vector<double> random_estimate(Space space) {
  std::vector<double> x(space_size(space));
  set_origin(space, x.data());
  std::vector<double> step(space_dim(space));
  for (double& number : step) number = uniform(-0.6, 0.6);
  retract(space, step.data(), x.data());
  if (space == Space::xyz) x[2] += 5;
  return x;
}

struct Instance {
  const Model& model;
  std::vector<std::vector<double>> x;
  std::vector<double> constants;
  std::vector<double> U;

  std::array<const double*, max_ends> ends() const {
    std::array<const double*, max_ends> pointers{};
    for (std::size_t k = 0; k < x.size(); ++k) pointers[k] = x[k].data();
    return pointers;
  }
};

// A random measurement, camera and offset near to what random estimates would see.
Instance random_instance(const Model& model) {
  Instance instance{model, {}, std::vector<double>(model.constants), {}};
  for (int k = 0; k < model.arity; ++k) instance.x.push_back(random_estimate(model.ends[k]));
  std::vector<double> z(model.measurement + model.extra);
  for (double& number : z) number = uniform(0.5, 1.5);
  if (model.measurement == 7) Eigen::Map<Eigen::Vector4d>(z.data() + 3).normalize();
  std::vector<std::vector<double>> params;
  std::vector<const double*> pointers;
  for (ParamKind kind : model.params) {
    std::vector<double> param(param_size(kind));
    for (double& number : param) number = uniform(0.1, 0.9);
    if (param.size() >= 7) Eigen::Map<Eigen::Vector4d>(param.data() + 3).normalize();
    params.push_back(param);
  }
  for (const auto& param : params) pointers.push_back(param.data());
  REQUIRE(model.prepare(z.data(), pointers.data(), instance.constants.data()));
  const auto U = Eigen::MatrixXd::Random(model.dim, model.dim).eval();
  instance.U.assign(U.data(), U.data() + U.size());
  return instance;
}

Eigen::VectorXd error(const Instance& instance) {
  Eigen::VectorXd r(instance.model.dim);
  instance.model.error(instance.ends().data(), instance.constants.data(), instance.U.data(),
                       r.data());
  return r;
}

Eigen::VectorXd error_after(Instance instance, int end, int axis, double length) {
  std::vector<double> step(space_dim(instance.model.ends[end]), 0.0);
  step[axis] = length;
  retract(instance.model.ends[end], step.data(), instance.x[end].data());
  return error(instance);
}

void check_jacobian(const Instance& instance) {
  const Model& model = instance.model;
  std::vector<double> block(max_block);
  model.linearize(instance.ends().data(), instance.constants.data(), instance.U.data(),
                  block.data());
  Eigen::Map<Eigen::MatrixXd> columns(block.data(), model.dim, max_block / model.dim);
  int column = 0;
  const double h = 1e-6;
  for (int end = 0; end < model.arity; ++end) {
    for (int axis = 0; axis < space_dim(model.ends[end]); ++axis, ++column) {
      const Eigen::VectorXd slope =
          (error_after(instance, end, axis, h) - error_after(instance, end, axis, -h)) / (2 * h);
      INFO(model.tag << " end " << end << " axis " << axis);
      CHECK((columns.col(column) - slope).norm() < 1e-7 * (1 + slope.norm()));
    }
  }
  CHECK((columns.col(column) + error(instance)).norm() < 1e-12 * (1 + error(instance).norm()));
}

}  // namespace

TEST_CASE("every model's Jacobian is its numerical one", "[factor]") {
  for (const Model& model : models()) {
    for (int trial = 0; trial < 20; ++trial) check_jacobian(random_instance(model));
  }
}
