#include "lib/marginalize/prices.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <queue>

namespace sg::marginalize {
namespace {

using Eigen::MatrixXd;

constexpr double factor_cost = 100;  // of any, beside elimination
constexpr std::size_t most_for_a_tree =
    2;  // pairs for each of the tree's, as recovery takes the cube of their number

// Its ends by position, ascending, without those that have none.
std::vector<Index> row(const Prices& prices, const Measurable& of) {
  std::vector<Index> row;
  for (const Index v : {of.first, of.second}) {
    if (v >= 0 && prices.position[v] >= 0) row.push_back(prices.position[v]);
  }
  std::ranges::sort(row);
  return row;
}

// The covariance once a measurement of the pair has brought its own down to what it is, where it was larger.
MatrixXd informed(const MatrixXd& covariance, const Pair& pair) {
  const MatrixXd SJ = covariance(Eigen::all, pair.scalars) * pair.slope.transpose();
  const MatrixXd B = pair.slope * SJ(pair.scalars, Eigen::all);
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> ratio(pair.covariance, B);
  const MatrixXd scaled = SJ * ratio.eigenvectors();  // V' B V = I
  const Eigen::VectorXd less = (1 - ratio.eigenvalues().array()).max(0.0);
  return covariance - scaled * less.asDiagonal() * scaled.transpose();
}

}  // namespace

Prices prices(const graph::GraphPattern& left, const graph::Order& order,
              const std::vector<bool>& removed, double rate) {
  Prices result{elim::filled_graph(elim::ordered(left.pattern, order)),
                std::vector<Index>(left.vertex_variable.size(), -1), rate, 0};
  result.average =
      result.filled.ec / static_cast<elim::Wide>(std::max<Index>(left.pattern.rows.size(), 1));
  for (Index k = 0; k < std::ssize(order); ++k) result.position[left.variable_vertex[order[k]]] = k;
  for (std::size_t v = 0; v < removed.size(); ++v) {
    if (removed[v]) result.position[v] = going;
  }
  return result;
}

elim::Wide price(Prices& prices, const Measurable& of) {
  for (const Index v : {of.first, of.second}) {
    if (v >= 0 && prices.position[v] == going) return prices.average;
  }
  return elim::increase(prices.filled, row(prices, of));
}

void pay(Prices& prices, const Measurable& of) {
  elim::add_factor(prices.filled, row(prices, of));
}

std::vector<Index> worth_their_price(const Blanket& blanket, const std::vector<Pair>& pairs,
                                     const Tree& tree, Prices& prices) {
  MatrixXd covariance = tree_covariance(blanket, pairs, tree);
  for (const Index k : tree.pairs) pay(prices, pairs[k].of);
  struct Waiting {
    double value;  // nats a unit of cost, as it was last
    Index pair;
    std::size_t known;  // pairs taken by then
    bool operator<(const Waiting& other) const {
      return value != other.value ? value < other.value : pair > other.pair;
    }
  };
  std::vector<Index> taken;
  const auto wait = [&](Index k) -> Waiting {
    const double cost = elim::to_double(price(prices, pairs[k].of)) + factor_cost;
    return {surprise(pairs[k], covariance) / cost, k, taken.size()};
  };
  std::priority_queue<Waiting> queue;
  for (const Index k : others(pairs, tree)) queue.push(wait(k));
  const std::size_t most = (most_for_a_tree - 1) * tree.pairs.size();
  while (!queue.empty() && taken.size() < most) {
    const Waiting best = queue.top();
    queue.pop();
    if (best.known < taken.size()) {
      queue.push(wait(best.pair));
      continue;
    }
    if (!(best.value > prices.rate)) break;
    pay(prices, pairs[best.pair].of);
    covariance = informed(covariance, pairs[best.pair]);
    taken.push_back(best.pair);
  }
  return taken;
}

}  // namespace sg::marginalize
