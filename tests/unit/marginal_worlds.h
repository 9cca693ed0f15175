// Small worlds with all that marginalization meets, and dense matrices of them.
#pragma once

#include <Eigen/Dense>

#include "lib/factor/problem.h"
#include "lib/marginalize/marginalize.h"
#include "tests/unit/common.h"

namespace sg::test {

// A line's numbers, each with a blank before it.
std::string numbers(const std::vector<double>& values);
std::vector<double> random_numbers(Random& random, int count, double size);
// The upper triangle of a random positive definite matrix.
std::vector<double> random_triangle(Random& random, int dim);

// Poses in a row with closures and landmarks, of the plane or of space; every number is drawn, so that nothing is at
// its optimum.
struct World {
  bool plane = true;
  int poses = 8, closures = 5, landmarks = 3;
  bool anchored = false;    // a prior
  bool consistent = false;  // but for landmarks and priors: measurements say what estimates do
};

std::string random_text(Random& random, const World& world);

// A graph with what is taken of it.
struct Subject {
  Graph graph;
  factor::Problem problem;
  factor::Values values;

  explicit Subject(const std::string& text)
      : graph(graph_of(text)),
        problem(factor::make_problem(graph)),
        values(factor::file_values(problem)) {}
  Subject(const Subject&) = delete;
  marginalize::At at() const { return {problem, values}; }

  // All edges in the steps of all vertices: by the pieces that other tests compare with the linearized system.
  marginalize::Piece whole() const;
};

// The Schur complement of the removed vertices' scalars, by a dense inverse of their part.
struct Gaussian {
  Eigen::MatrixXd information;
  Eigen::VectorXd gradient;
};
Gaussian schur(const Subject& of, const std::vector<bool>& removed);

// The graph's text after it.
std::string rewritten(const Subject& of, marginalize::Marginalization result);

// Among them the vertex 2, and never the first.
std::vector<bool> some_vertices(Random& random, const Graph& graph);

}  // namespace sg::test
