// The ordinary edges that carry what is recovered: relative measurements of g2o's between two vertices, and priors.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/marginalize/piece.h"

namespace sg::marginalize {

// What could be measured between two vertices, or of one (second -1), with full rank. Of a pose and a landmark the pose
// is the first; else the lower one.
struct Measurable {
  graph::EdgeTag type;
  Index first, second = -1;
};
// Of two landmarks the vector between them in the world's frame, which only tells where no pose turns with them.
std::optional<Measurable> between(const At& at, Index u, Index v);
std::optional<Measurable> prior(const At& at, Index v);

// An edge: the numbers that its line measures, and their information.
struct Measurement {
  Measurable of;
  std::vector<double> numbers;
  Eigen::MatrixXd information;
};
// What would be measured at the estimates after these vertices have moved by these steps.
std::vector<double> measured(const At& at, const Measurable& of, const Eigen::VectorXd& first,
                             const Eigen::VectorXd& second);
// The same where they have not moved.
std::vector<double> measured(const At& at, const Measurable& of);
// The slope of its error in the steps of its vertices, the first's before the second's, of the measurement that has no
// error at the estimates; and of one of these numbers.
Eigen::MatrixXd slope(const At& at, const Measurable& of);
Eigen::MatrixXd slope(const At& at, const Measurable& of, const std::vector<double>& numbers);

// Minus the error of these numbers.
Eigen::VectorXd lack(const At& at, const Measurable& of, const std::vector<double>& numbers);

Piece piece_of(const At& at, const Measurement& measurement);

// The parameter line that its type refers to, if any: a sensor where the pose is.
std::optional<graph::ParamTag> parameter(graph::EdgeTag type);
// "TAG id id [parameter] numbers information\n".
std::string line(const Graph& graph, const Measurement& measurement, Id parameter);

}  // namespace sg::marginalize
