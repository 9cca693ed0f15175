// Which pairs of a Markov blanket measurements are recovered between.
#pragma once

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "lib/marginalize/measurement.h"

namespace sg::marginalize {

enum class Topology : std::uint8_t { dense, tree, subgraph, l1, seif, ec };
std::optional<Topology> topology(std::string_view name);
std::vector<std::string> topology_names();

struct Sparsity {
  Topology topology = Topology::tree;
  Index extra = -1;        // subgraph: pairs beyond the tree; -1: one for every two of the tree
  double penalty = 1;      // l1: of a pair, in units of what a tree's measurement costs
  double threshold = 0.1;  // seif: of a link's correlation
  double price = 1;        // ec: of EC, as a multiple of what a tree loses a unit of its own
  std::optional<double> ec = {};  // ec: the price is the least that leaves no more EC than this
};

// The Gaussian of a blanket in its steps, all but those of the vertex that is held (a piece that only moves with the
// whole says nothing of where it is).
struct Blanket {
  std::vector<Index> vertices;
  std::vector<int> start;       // where the step of each starts, -1 of the one that is held
  Eigen::MatrixXd information;  // regular: where nothing is known, next to nothing is
  Eigen::MatrixXd covariance;
};
Blanket blanket(const At& at, const Piece& piece);

// A pair that a measurement could be recovered between.
struct Pair {
  Measurable of;
  std::vector<int> scalars;    // of the blanket's steps, those of its vertices
  Eigen::MatrixXd slope;       // in them
  Eigen::MatrixXd covariance;  // slope S slope'
};
// Its slope in all steps of the blanket; those of the chosen ones.
Eigen::MatrixXd spread(const Blanket& blanket, const Pair& pair);
std::vector<Eigen::MatrixXd> slopes(const Blanket& blanket, const std::vector<Pair>& pairs,
                                    const std::vector<Index>& chosen);
// Every pair with a measurement of full rank, and where the piece is absolute a prior of every vertex. Landmarks pair
// with each other only where there is no pose and the piece is absolute: what poses have told of them turns with the whole.
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
// dearer: what a pair costs beside its divergence, in nats; may be empty.
Tree spanning_tree(const At& at, const Blanket& blanket, const std::vector<Pair>& pairs,
                   bool absolute, const std::function<double(const Pair&)>& dearer = {});
// The vertex that no tree of such measurements would reach among these, whatever is known of them; -1 where there is none.
Index out_of_reach(const At& at, std::span<const Index> vertices, bool absolute);

// The pairs between two vertices that are not the tree's.
std::vector<Index> others(const std::vector<Pair>& pairs, const Tree& tree);
// The covariance of what is recovered along the tree.
Eigen::MatrixXd tree_covariance(const Blanket& blanket, const std::vector<Pair>& pairs,
                                const Tree& tree);
// By how much a covariance of the blanket is wrong about a pair: the divergence of the pair's Gaussian from that which
// it has there.
double surprise(const Pair& pair, const Eigen::MatrixXd& covariance);

// The pairs of a topology but ec (prices.h), ascending; the tree among them.
std::vector<Index> chosen_pairs(const At& at, const Piece& piece, const Blanket& blanket,
                                const std::vector<Pair>& pairs, const Tree& tree,
                                const Sparsity& sparsity);

}  // namespace sg::marginalize
