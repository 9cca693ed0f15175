// Which pairs of a Markov blanket measurements are recovered between.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "lib/marginalize/measurement.h"

namespace sg::marginalize {

enum class Topology : std::uint8_t { dense, tree, subgraph, l1, seif };
std::optional<Topology> topology(std::string_view name);
std::vector<std::string> topology_names();

struct Sparsity {
  Topology topology = Topology::tree;
  Index extra = -1;        // subgraph: pairs beyond the tree; -1: one for every two of the tree
  double penalty = 1;      // l1: of a pair, in units of what a tree's measurement costs
  double threshold = 0.1;  // seif: of a link's correlation
};

// The Gaussian of a blanket in its steps, all but those of the vertex that is held (a piece that only moves with the
// whole says nothing of where it is).
struct Blanket {
  std::vector<Index> vertices;
  std::vector<int> start;       // where the step of each starts, -1 of the one that is held
  std::vector<int> scalars;     // of the piece's, those that are not
  Eigen::MatrixXd information;  // regular: where nothing is known, next to nothing is
  Eigen::VectorXd gradient;
  bool regular;  // whether it was so before
  Eigen::MatrixXd covariance;
};
Blanket blanket(const At& at, const Piece& piece);

// A pair that a measurement could be recovered between.
struct Pair {
  Measurable of;
  Eigen::MatrixXd slope;       // in the steps of the blanket
  Eigen::MatrixXd covariance;  // slope S slope'
};
// Every pair with a measurement of full rank, and where the piece is absolute a prior of every vertex. Landmarks pair
// with each other only where there is no pose.
std::vector<Pair> candidate_pairs(const At& at, const Piece& piece, const Blanket& blanket);

// The spanning tree of the least sum of log det covariance: of all trees of these measurements the one whose recovered
// Gaussian has the least divergence. (Between poses the slope of a tree has determinant one, whatever the tree, so that
// its divergence is half that sum and a constant: for relative measurements what mutual information is to Chow and Liu,
// Approximating discrete probability distributions with dependence trees, 1968.) Landmarks are leaves: a pose is not
// determined by what it sees of one. -1 in `missing` or a vertex that no pair reaches.
struct Tree {
  std::vector<Index> pairs;  // ascending
  Index missing = -1;
};
Tree spanning_tree(const At& at, const Blanket& blanket, const std::vector<Pair>& pairs,
                   bool absolute);

// The pairs of a topology, ascending; the tree among them.
std::vector<Index> chosen_pairs(const At& at, const Piece& piece, const Blanket& blanket,
                                const std::vector<Pair>& pairs, const Tree& tree,
                                const Sparsity& sparsity);

}  // namespace sg::marginalize
