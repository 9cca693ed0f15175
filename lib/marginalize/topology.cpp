#include "lib/marginalize/topology.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "lib/graph/components.h"
#include "lib/marginalize/recover.h"

namespace sg::marginalize {
namespace {

using Eigen::LLT;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::array<std::string_view, 6> names{"dense", "tree", "subgraph", "l1", "seif", "ec"};

constexpr double least_share = 1e-3;  // l1: of what a tree's measurement has, for a pair to count

// What is added to the information of a direction that nothing is known of, as a part of its diagonal.
constexpr double next_to_nothing = 1e-9;

// The number of a vertex in the blanket.
std::ptrdiff_t place(const Blanket& blanket, Index v) {
  return std::ranges::lower_bound(blanket.vertices, v) - blanket.vertices.begin();
}

bool is_pose(const At& at, Index v) {
  return at.problem.graph->role(v) == graph::Role::pose;
}

// A pair without its covariance.
Pair pair_of(const At& at, const Measurable& of, const Blanket& blanket) {
  const MatrixXd own = slope(at, of);
  std::vector<int> columns;  // of own
  Pair pair{of, {}, {}, {}};
  int column = 0;
  for (const Index v : {of.first, of.second}) {
    if (v < 0) continue;
    const int start = blanket.start[place(blanket, v)];
    for (int i = 0; i < at.dim(v); ++i, ++column) {
      if (start < 0) continue;
      pair.scalars.push_back(start + i);
      columns.push_back(column);
    }
  }
  pair.slope = own(Eigen::all, columns);
  return pair;
}

MatrixXd covariance_of(const Pair& pair, const MatrixXd& covariance) {
  return pair.slope * covariance(pair.scalars, pair.scalars) * pair.slope.transpose();
}

// Calls pair(u, v) for every two vertices that could be measured together, and pair(v, -1) for every one that could be
// alone. Landmarks pair with each other only where there is no pose, and where the piece tells which way the world turns: the
// vector between them would.
void for_pairs(const At& at, std::span<const Index> vertices, bool absolute, const auto& pair) {
  const bool poses = std::ranges::any_of(vertices, [&](Index v) { return is_pose(at, v); });
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (absolute) {
      if (const auto of = prior(at, vertices[i])) pair(*of);
    }
    for (std::size_t j = i + 1; j < vertices.size(); ++j) {
      const Index u = vertices[i], v = vertices[j];
      if (!is_pose(at, u) && !is_pose(at, v) && (poses || !absolute)) continue;
      if (const auto of = between(at, u, v)) pair(*of);
    }
  }
}

// The further pairs that a tree is most wrong about.
std::vector<Index> most_informative(const Blanket& blanket, const std::vector<Pair>& pairs,
                                    const Tree& tree, Index count) {
  std::vector<Index> further = others(pairs, tree);
  count = std::min<Index>(count, static_cast<Index>(further.size()));
  const MatrixXd covariance = tree_covariance(blanket, pairs, tree);
  std::vector<double> of(pairs.size(), 0);
  for (const Index k : further) of[k] = surprise(pairs[k], covariance);
  std::ranges::stable_sort(further, std::greater(), [&](Index k) { return of[k]; });
  further.resize(count);
  return further;
}

// How many pairs come beside a tree's where nobody says it: half as many. With more, vertices that go in their turn would
// have ever more neighbours.
std::size_t half(const Tree& tree) {
  return (tree.pairs.size() + 1) / 2;
}

// The greatest of these.
std::vector<Index> first_few(std::vector<Index> further, const Tree& tree,
                             const std::vector<double>& of) {
  std::ranges::stable_sort(further, std::greater(), [&](Index k) { return of[k]; });
  further.resize(std::min(further.size(), half(tree)));
  return further;
}

// Huang, Kaess, Leonard, Consistent sparsification for graph optimization (2013): the pairs that a penalty on all of
// them leaves, here on the trace of their information, a multiple each of what a tree's has, and never with more
// information than there was. Those that the tree is hardly wrong about are left out before.
std::vector<Index> penalized(const Blanket& blanket, const std::vector<Pair>& pairs,
                             const Tree& tree, double penalty) {
  std::vector<Index> offered =
      most_informative(blanket, pairs, tree, 2 * static_cast<Index>(tree.pairs.size()));
  offered.insert(offered.begin(), tree.pairs.begin(), tree.pairs.end());
  const Recovery recovered = recover(
      slopes(blanket, pairs, offered), blanket.covariance,
      {.conservative = true, .penalty = penalty, .multiples = true, .barrier = 1e-3 * least_share});
  std::vector<double> share(pairs.size(), 0);
  for (std::size_t i = 0; i < offered.size(); ++i) {
    const MatrixXd& A = pairs[offered[i]].covariance;
    share[offered[i]] = (recovered.information[i] * A).trace() / static_cast<double>(A.rows());
  }
  std::vector<Index> result = others(pairs, tree);
  std::erase_if(result, [&](Index k) { return share[k] < least_share; });
  return first_few(std::move(result), tree, share);
}

// What is left of a link of the information matrix beside what its two ends know: its largest correlation.
double link(const At& at, const Piece& piece, Index u, Index v) {
  const std::vector<int> start = starts(at, piece.vertices);
  const auto block = [&](Index a, Index b) -> MatrixXd {
    const auto place = [&](Index x) {
      return start[std::ranges::find(piece.vertices, x) - piece.vertices.begin()];
    };
    return piece.information.block(place(a), place(b), at.dim(a), at.dim(b));
  };
  const auto root = [&](Index a) {
    MatrixXd own = block(a, a);
    own.diagonal() *= 1 + next_to_nothing;
    return LLT<MatrixXd>(own);
  };
  const MatrixXd half = root(u).matrixL().solve(block(u, v));
  const MatrixXd whole = root(v).matrixL().solve(half.transpose());
  return std::sqrt(
      Eigen::SelfAdjointEigenSolver<MatrixXd>(whole * whole.transpose()).eigenvalues().maxCoeff());
}

// Thrun, Liu, Koller, Ng, Ghahramani, Durrant-Whyte, Simultaneous localization and mapping with sparse extended
// information filters (2004): weak links of the information matrix go.
std::vector<Index> strong_links(const At& at, const Piece& piece, const std::vector<Pair>& pairs,
                                const Tree& tree, double threshold) {
  std::vector<double> strength(pairs.size(), 0);
  std::vector<Index> result = others(pairs, tree);
  for (const Index k : result) strength[k] = link(at, piece, pairs[k].of.first, pairs[k].of.second);
  std::erase_if(result, [&](Index k) { return strength[k] < threshold; });
  return first_few(std::move(result), tree, strength);
}

}  // namespace

std::optional<Topology> topology(std::string_view name) {
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) return std::nullopt;
  return static_cast<Topology>(found - names.begin());
}

std::vector<std::string> topology_names() {
  return {names.begin(), names.end()};
}

Blanket blanket(const At& at, const Piece& piece) {
  Blanket result;
  result.vertices = piece.vertices;
  const std::vector<int> start = starts(at, piece.vertices);
  // The first pose, or the first of all where there is none.
  const auto pose = std::ranges::find_if(piece.vertices, [&](Index v) { return is_pose(at, v); });
  const auto held = piece.absolute                 ? std::ssize(piece.vertices)
                    : pose == piece.vertices.end() ? 0
                                                   : pose - piece.vertices.begin();
  std::vector<int> rest;  // scalars of those that are not held
  for (Index k = 0; k < std::ssize(piece.vertices); ++k) {
    result.start.push_back(k == held ? -1 : static_cast<int>(rest.size()));
    for (int i = start[k]; k != held && i < start[k + 1]; ++i) rest.push_back(i);
  }
  result.information = piece.information(rest, rest);
  VectorXd scale = result.information.diagonal();
  const double most = scale.size() > 0 ? scale.maxCoeff() : 0;
  for (double& s : scale) s = 1 / std::sqrt(std::max(s, 1e-12 * most));
  const MatrixXd scaled = scale.asDiagonal() * result.information * scale.asDiagonal();
  const LLT<MatrixXd> cholesky(scaled);
  if (cholesky.info() != Eigen::Success || !(cholesky.rcond() > next_to_nothing))
    result.information.diagonal() += next_to_nothing * scale.cwiseAbs2().cwiseInverse();
  const auto m = result.information.rows();
  const MatrixXd again = scale.asDiagonal() * result.information * scale.asDiagonal();
  result.covariance = scale.asDiagonal() * LLT<MatrixXd>(again).solve(MatrixXd::Identity(m, m)) *
                      scale.asDiagonal();
  result.covariance = (result.covariance + result.covariance.transpose().eval()) / 2;
  return result;
}

std::vector<Pair> candidate_pairs(const At& at, const Piece& piece, const Blanket& blanket) {
  std::vector<Pair> pairs;
  for_pairs(at, piece.vertices, piece.absolute, [&](const Measurable& of) {
    pairs.push_back(pair_of(at, of, blanket));
    pairs.back().covariance = covariance_of(pairs.back(), blanket.covariance);
  });
  return pairs;
}

MatrixXd spread(const Blanket& blanket, const Pair& pair) {
  MatrixXd all = MatrixXd::Zero(pair.slope.rows(), blanket.information.rows());
  all(Eigen::all, pair.scalars) = pair.slope;
  return all;
}

std::vector<MatrixXd> slopes(const Blanket& blanket, const std::vector<Pair>& pairs,
                             const std::vector<Index>& chosen) {
  std::vector<MatrixXd> result;
  result.reserve(chosen.size());
  for (const Index k : chosen) result.push_back(spread(blanket, pairs[k]));
  return result;
}

double surprise(const Pair& pair, const MatrixXd& covariance) {
  const MatrixXd B = covariance_of(pair, covariance);
  const MatrixXd ratio = LLT<MatrixXd>(B).solve(pair.covariance);
  return (ratio.trace() - log_det(pair.covariance) + log_det(B) - static_cast<double>(B.rows())) /
         2;
}

std::vector<Index> others(const std::vector<Pair>& pairs, const Tree& tree) {
  std::vector<Index> result;
  for (Index k = 0; k < std::ssize(pairs); ++k) {
    if (pairs[k].of.second >= 0 && !std::ranges::binary_search(tree.pairs, k)) result.push_back(k);
  }
  return result;
}

MatrixXd tree_covariance(const Blanket& blanket, const std::vector<Pair>& pairs, const Tree& tree) {
  const auto m = blanket.covariance.rows();
  MatrixXd Q = MatrixXd::Zero(m, m);
  for (const Index k : tree.pairs)
    Q(pairs[k].scalars, pairs[k].scalars) +=
        pairs[k].slope.transpose() * LLT<MatrixXd>(pairs[k].covariance).solve(pairs[k].slope);
  return LLT<MatrixXd>(Q).solve(MatrixXd::Identity(m, m));
}

Index out_of_reach(const At& at, std::span<const Index> vertices, bool absolute) {
  const auto n = static_cast<Index>(vertices.size());
  const auto number = [&](Index v) {
    return v < 0 ? n : static_cast<Index>(std::ranges::lower_bound(vertices, v) - vertices.begin());
  };
  graph::DisjointSets parts(n + 1);
  for_pairs(at, vertices, absolute,
            [&](const Measurable& of) { join(parts, number(of.first), number(of.second)); });
  for (Index k = n - 1; k >= 0; --k) {
    if (find(parts, k) != find(parts, absolute ? n : 0)) return vertices[k];
  }
  return -1;
}

Tree spanning_tree(const At& at, const Blanket& blanket, const std::vector<Pair>& pairs,
                   bool absolute, const std::function<double(const Pair&)>& dearer) {
  const auto number = [&](Index v) {
    return v < 0 ? static_cast<Index>(blanket.vertices.size())
                 : static_cast<Index>(place(blanket, v));
  };
  const bool poses = std::ranges::any_of(blanket.vertices, [&](Index v) { return is_pose(at, v); });
  const auto is_leaf = [&](Index v) { return poses && v >= 0 && !is_pose(at, v); };
  std::vector<Index> order(pairs.size());
  std::iota(order.begin(), order.end(), 0);
  std::vector<double> cost;
  cost.reserve(pairs.size());
  for (const Pair& pair : pairs)
    cost.push_back(log_det(pair.covariance) / 2 + (dearer ? dearer(pair) : 0));
  std::ranges::stable_sort(order, {}, [&](Index k) { return cost[k]; });

  Tree tree;
  graph::DisjointSets parts(static_cast<Index>(blanket.vertices.size()) +
                            1);  // the last: the world
  std::vector<bool> leaf(blanket.vertices.size() + 1, false);
  // What can be passed through first, then the leaves.
  for (const bool leaves : {false, true}) {
    for (const Index k : order) {
      const auto [type, u, v] = pairs[k].of;
      const Index end = is_leaf(u) ? u : is_leaf(v) ? v : -1;
      if ((end >= 0) != leaves || (leaves && leaf[number(end)])) continue;
      if (!join(parts, number(u), number(v))) continue;
      if (leaves) leaf[number(end)] = true;
      tree.pairs.push_back(k);
    }
  }
  const Index root = absolute ? number(-1) : 0;
  for (Index k = 0; k < std::ssize(blanket.vertices); ++k) {
    if (find(parts, k) != find(parts, root)) tree.missing = blanket.vertices[k];
  }
  std::ranges::sort(tree.pairs);
  return tree;
}

std::vector<Index> chosen_pairs(const At& at, const Piece& piece, const Blanket& blanket,
                                const std::vector<Pair>& pairs, const Tree& tree,
                                const Sparsity& sparsity) {
  std::vector<Index> further;
  const auto usual = static_cast<Index>(half(tree));
  switch (sparsity.topology) {
    case Topology::tree:
    case Topology::ec:
      break;
    case Topology::dense:
      further = others(pairs, tree);
      break;
    case Topology::subgraph:
      further = most_informative(blanket, pairs, tree, sparsity.extra < 0 ? usual : sparsity.extra);
      break;
    case Topology::l1:
      further = penalized(blanket, pairs, tree, sparsity.penalty);
      break;
    case Topology::seif:
      further = strong_links(at, piece, pairs, tree, sparsity.threshold);
      break;
  }
  std::vector<Index> chosen = tree.pairs;
  chosen.insert(chosen.end(), further.begin(), further.end());
  std::ranges::sort(chosen);
  return chosen;
}

}  // namespace sg::marginalize
