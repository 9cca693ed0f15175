// The lazy sparse greedy against the textbook's: a dense inverse, every gain in every round.
#include "lib/prune/tgreedy.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "formats/formats.h"
#include "lib/prune/candidates.h"
#include "lib/trees/spanning_trees.h"
#include "tests/unit/common.h"

using namespace sg;
using namespace sg::test;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// The parts of a dense graph, and log t of each added up, from the eigenvalues of the Laplacian:
// the product of the nonzero ones is (number of nodes) t for each part.
struct DenseGraph {
  MatrixXd laplacian;
  explicit DenseGraph(int n) : laplacian(MatrixXd::Zero(n, n)) {}

  void add(int u, int v, double w) {
    laplacian(u, u) += w, laplacian(v, v) += w;
    laplacian(u, v) -= w, laplacian(v, u) -= w;
  }
  std::vector<int> part() const {
    const int n = static_cast<int>(laplacian.rows());
    std::vector<int> mark(n, -1);
    for (int start = 0; start < n; ++start) {
      if (mark[start] >= 0) continue;
      std::vector<int> open{start};
      while (!open.empty()) {
        const int u = open.back();
        open.pop_back();
        mark[u] = start;
        for (int v = 0; v < n; ++v) {
          if (v != u && laplacian(u, v) != 0 && mark[v] < 0) open.push_back(v);
        }
      }
    }
    return mark;
  }
  // The pseudo-inverse, by grounding: L + sum over parts of 1 1^T is regular, and differs from L
  // by what does not matter to differences within a part.
  MatrixXd inverse(const std::vector<int>& mark) const {
    MatrixXd regular = laplacian;
    for (int i = 0; i < regular.rows(); ++i) {
      for (int j = 0; j < regular.cols(); ++j) regular(i, j) += mark[i] == mark[j];
    }
    return regular.inverse();
  }
};

struct DenseLayer {
  double multiplicity;
  std::vector<double> weight;
  DenseGraph graph;
};

// The definition in lib/prune/tgreedy.h, round by round. `now` says which candidates may be taken.
struct Textbook {
  const Graph& graph;
  trees::TreeNodes nodes = trees::tree_nodes(graph);
  std::vector<DenseLayer> layers = {};

  Textbook(const Graph& graph_, trees::TreeWeights kind) : graph(graph_) {
    for (const trees::TreeLayer& layer : trees::tree_layers(graph, kind))
      layers.push_back({layer.multiplicity, layer.weight, DenseGraph(nodes.count)});
  }
  void add(Index e) {
    for (DenseLayer& layer : layers) {
      const auto ends = graph.edge(e);
      for (std::size_t k = 1; k < ends.size() && layer.weight[e] > 0; ++k) {
        if (nodes.node[ends[0]] != nodes.node[ends[k]])
          layer.graph.add(nodes.node[ends[0]], nodes.node[ends[k]], layer.weight[e]);
      }
    }
  }
  // The best of the candidates, by (joins, gain, file order); gains within 1e-8 are equal.
  Index best(const std::vector<Index>& candidates, const std::vector<bool>& taken) const {
    std::vector<std::vector<int>> part;
    std::vector<MatrixXd> inverse;
    for (const DenseLayer& layer : layers) {
      part.push_back(layer.graph.part());
      inverse.push_back(layer.graph.inverse(part.back()));
    }
    Index chosen = -1;
    int best_joins = -1;
    double best_gain = 0;
    for (Index e : candidates) {
      if (taken[e]) continue;
      const int u = nodes.node[graph.edge(e)[0]], v = nodes.node[graph.edge(e)[1]];
      int joins = 0;
      double gain = 0;
      for (std::size_t k = 0; k < layers.size(); ++k) {
        const double w = layers[k].weight[e];
        if (w <= 0) continue;
        const bool join = part[k][u] != part[k][v];
        joins += join;
        const MatrixXd& x = inverse[k];
        gain +=
            layers[k].multiplicity * std::log(join ? w : 1 + w * (x(u, u) + x(v, v) - 2 * x(u, v)));
      }
      const bool better =
          chosen < 0 || joins > best_joins ||
          (joins == best_joins && gain > best_gain + 1e-8 * std::max(1.0, std::abs(best_gain)));
      if (better) chosen = e, best_joins = joins, best_gain = gain;
    }
    return chosen;
  }
};

std::vector<Index> textbook(const Graph& graph, const std::vector<Index>& candidates,
                            std::size_t count, trees::TreeWeights kind) {
  Textbook book(graph, kind);
  std::vector<bool> taken(graph.edges(), false), candidate(graph.edges(), false);
  for (Index e : candidates) candidate[e] = true;
  for (Index e = 0; e < graph.edges(); ++e) {
    if (!candidate[e]) book.add(e);
  }
  std::vector<Index> kept;
  while (kept.size() < std::min(count, candidates.size())) {
    kept.push_back(book.best(candidates, taken));
    taken[kept.back()] = true;
    book.add(kept.back());
  }
  return kept;
}

std::vector<Index> textbook_online(const Graph& graph, const graph::PoseIndex& poses,
                                   const std::vector<Index>& candidates, std::size_t count,
                                   trees::TreeWeights kind, Index batch) {
  Textbook book(graph, kind);
  const graph::Replay steps = graph::replay(graph, poses);
  std::vector<bool> taken(graph.edges(), false), candidate(graph.edges(), false);
  for (Index e : candidates) candidate[e] = true;
  count = std::min(count, candidates.size());
  std::vector<Index> kept, seen;
  for (Index first = 0; first < steps.steps; first += batch) {
    for (Index e = 0; e < graph.edges(); ++e) {
      if (steps.edge_step[e] < first || steps.edge_step[e] >= first + batch) continue;
      if (candidate[e]) {
        seen.push_back(e);
      } else {
        book.add(e);
      }
    }
    std::sort(seen.begin(), seen.end());
    const double share = static_cast<double>(count) * static_cast<double>(seen.size()) /
                         static_cast<double>(std::max<std::size_t>(1, candidates.size()));
    while (kept.size() < static_cast<std::size_t>(std::floor(share + 0.5))) {
      kept.push_back(book.best(seen, taken));
      taken[kept.back()] = true;
      book.add(kept.back());
    }
  }
  return kept;
}

std::vector<Index> edges_of(const std::vector<prune::Accepted>& accepted) {
  std::vector<Index> edges;
  for (const prune::Accepted& step : accepted) edges.push_back(step.edge);
  return edges;
}

std::string number(Random& random, bool wild) {
  const double exponent = uniform(random, -1, 1) * (wild ? 4 : 0.5);
  return " " + std::to_string(100 * std::pow(10, exponent));
}

// A pose graph in the plane, perhaps with landmarks, gaps in odometry, parallel edges, a fixed
// vertex or two. Information is diagonal.
std::string random_graph(Random& random, bool landmarks, bool wild) {
  const int poses = draw(random, 1, 14), points = landmarks ? draw(random, 1, 6) : 0;
  std::string text;
  for (int i = 0; i < poses; ++i) text += "VERTEX_SE2 " + std::to_string(i) + " 0 0 0\n";
  for (int j = 0; j < points; ++j) text += "VERTEX_XY " + std::to_string(50 + j) + " 0 0\n";
  for (int fixes = draw(random, 0, 2); fixes > 0; --fixes)
    text += "FIX " + std::to_string(draw(random, 0, poses - 1)) + "\n";
  const auto motion = [&](int i, int j) {
    const std::string t = number(random, wild), r = number(random, wild);
    text += "EDGE_SE2 " + std::to_string(i) + " " + std::to_string(j) + " 1 0 0" + t + " 0 0" + t +
            " 0" + r + "\n";
  };
  for (int i = 1; i < poses; ++i) {
    for (int copies = draw(random, 0, 9) / 2; copies > 0; copies /= 2) motion(i - 1, i);
  }
  for (int k = draw(random, 0, 25); k > 0; --k)
    motion(draw(random, 0, poses - 1), draw(random, 0, poses - 1));
  for (int k = points ? draw(random, 0, 30) : 0; k > 0; --k) {
    const std::string t = number(random, wild);
    text += "EDGE_SE2_XY " + std::to_string(draw(random, 0, poses - 1)) + " " +
            std::to_string(50 + draw(random, 0, points - 1)) + " 1 1" + t + " 0" + t + "\n";
  }
  return text;
}

}  // namespace

TEST_CASE("the kept set is the textbook greedy's", "[tgreedy]") {
  Random random(1);
  int kept_in_all = 0;
  for (int trial = 0; trial < 600; ++trial) {
    const Graph graph = graph_of(random_graph(random, trial % 2 == 0, trial % 5 == 0));
    const graph::PoseIndex poses = graph::pose_index(graph);
    const trees::TreeWeights kind = static_cast<trees::TreeWeights>(trial % 4);
    const auto candidates = prune::candidate_edges(
        graph, poses, trial % 3 == 0 ? prune::Candidates::both : prune::natural_candidates(graph));
    if (kind == trees::TreeWeights::rotation && trial % 2 == 0)
      continue;  // points have no rotation
    const std::size_t count = draw(random, 0, static_cast<int>(candidates.size()) + 2);
    const auto kept = edges_of(prune::tgreedy(graph, candidates, count, kind));
    INFO("trial " << trial);
    CHECK(kept == textbook(graph, candidates, count, kind));
    kept_in_all += static_cast<int>(kept.size());
  }
  CHECK(kept_in_all > 1000);
}

TEST_CASE("the online choice is the textbook's, batch by batch", "[tgreedy]") {
  Random random(2);
  for (int trial = 0; trial < 300; ++trial) {
    const Graph graph = graph_of(random_graph(random, trial % 2 == 0, false));
    const graph::PoseIndex poses = graph::pose_index(graph);
    const auto candidates = prune::candidate_edges(graph, poses, prune::natural_candidates(graph));
    const std::size_t count = draw(random, 0, static_cast<int>(candidates.size()) + 2);
    const Index batch = draw(random, 1, 4);
    INFO("trial " << trial);
    CHECK(edges_of(prune::tgreedy_online(graph, poses, candidates, count, trees::TreeWeights::unit,
                                         batch)) ==
          textbook_online(graph, poses, candidates, count, trees::TreeWeights::unit, batch));
  }
}

TEST_CASE("gains add up to the criterion, and shrink", "[tgreedy]") {
  Random random(3);
  for (int trial = 0; trial < 100; ++trial) {
    const Graph graph = graph_of(random_graph(random, trial % 2 == 0, false));
    const auto candidates =
        prune::candidate_edges(graph, graph::pose_index(graph), prune::natural_candidates(graph));
    const auto accepted =
        prune::tgreedy(graph, candidates, candidates.size(), trees::TreeWeights::dopt);
    for (std::size_t k = 1; k < accepted.size(); ++k) {
      CHECK(accepted[k].criterion - accepted[k - 1].criterion ==
            Approx(accepted[k].gain).margin(1e-8));
      if (!accepted[k - 1].joins) CHECK(accepted[k].gain <= accepted[k - 1].gain + 1e-7);
      CHECK((accepted[k - 1].joins || !accepted[k].joins));
    }
  }
}

TEST_CASE("intel: the textbook's choice", "[tgreedy]") {
  const auto folder = public_graphs();
  if (!folder) return;
  const Graph graph = formats::read_graph(*folder + "/intel.g2o");
  const auto candidates =
      prune::candidate_edges(graph, graph::pose_index(graph), prune::Candidates::loops);
  const auto accepted =
      prune::tgreedy(graph, candidates, candidates.size() / 4, trees::TreeWeights::unit);

  // Dense, with the inverse updated instead of computed in every round (Sherman, Morrison).
  DenseGraph dense(graph.vertices());
  std::vector<bool> candidate(graph.edges(), false);
  for (Index e : candidates) candidate[e] = true;
  for (Index e = 0; e < graph.edges(); ++e) {
    if (!candidate[e]) dense.add(graph.edge(e)[0], graph.edge(e)[1], 1);
  }
  MatrixXd grounded = dense.laplacian;
  grounded(0, 0) += 1;
  MatrixXd x = grounded.llt().solve(MatrixXd::Identity(graph.vertices(), graph.vertices()));
  std::vector<bool> taken(graph.edges(), false);
  for (const prune::Accepted& step : accepted) {
    Index best = -1;
    double most = -1;
    for (Index e : candidates) {
      const Index u = graph.edge(e)[0], v = graph.edge(e)[1];
      const double r = x(u, u) + x(v, v) - 2 * x(u, v);
      if (taken[e] || r <= most * (1 + 1e-8)) continue;
      best = e, most = r;
    }
    REQUIRE(step.edge == best);
    CHECK(step.gain == Approx(std::log(1 + most)));
    taken[best] = true;
    const VectorXd z = x.col(graph.edge(best)[0]) - x.col(graph.edge(best)[1]);
    x.noalias() -= z * z.transpose() / (1 + most);
  }
}

TEST_CASE("parts that candidates join come first, and nothing is lost", "[tgreedy]") {
  const std::string tail = " 1 0 0 1 0 0 1 0 1\n";
  const Graph graph = graph_of(
      "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 0 0 0\nVERTEX_SE2 2 0 0 0\n"
      "VERTEX_SE2 3 0 0 0\nVERTEX_SE2 4 0 0 0\nVERTEX_SE2 5 0 0 0\n"
      "EDGE_SE2 0 1" +
      tail + "EDGE_SE2 1 2" + tail + "EDGE_SE2 3 4" + tail + "EDGE_SE2 4 5" + tail +
      "EDGE_SE2 0 2" + tail + "EDGE_SE2 0 5" + tail + "EDGE_SE2 2 4" + tail);
  const graph::PoseIndex poses = graph::pose_index(graph);
  const auto candidates = prune::candidate_edges(graph, poses, prune::Candidates::loops);
  const auto one = prune::tgreedy(graph, candidates, 1, trees::TreeWeights::unit);
  REQUIRE(one.size() == 1);
  CHECK(graph.edge(one[0].edge)[1] == 5);
  CHECK(one[0].joins);
  std::vector<bool> removed(graph.edges(), false);
  CHECK(prune::pose_parts(graph, poses, removed) == 1);
  for (Index e : candidates) removed[e] = true;
  CHECK(prune::pose_parts(graph, poses, removed) == 2);
  CHECK(prune::tgreedy(graph, candidates, 99, trees::TreeWeights::unit).size() == 3);
  CHECK(prune::tgreedy(graph, {}, 5, trees::TreeWeights::unit).empty());
}

TEST_CASE("spanning trees: formulas that everybody knows", "[tgreedy]") {
  for (int n = 1; n <= 12; ++n) {
    std::vector<trees::TreeEdge> links;
    for (int i = 0; i < n; ++i) {
      for (int j = i + 1; j < n; ++j) links.push_back({i, j});
    }
    const std::vector<double> unit(links.size(), 1), none(links.size(), 0);
    CHECK(trees::spanning_trees(n, links, unit).log_trees ==
          Approx((n - 2) * std::log(n)).margin(1e-9));  // Cayley
    trees::SpanningTrees grown = trees::spanning_trees(n, links, none);
    for (const trees::TreeEdge& link : links) trees::add_link(grown, link, 1);
    CHECK(grown.log_trees == Approx((n - 2) * std::log(n)).margin(1e-9));
  }
  CHECK(trees::spanning_trees(0, {}, {}).log_trees == 0);
}

TEST_CASE("spanning trees of weights that differ wildly", "[tgreedy]") {
  Random random(4);
  for (int trial = 0; trial < 100; ++trial) {
    const int n = draw(random, 2, 9);
    std::vector<trees::TreeEdge> links;
    std::vector<double> weight;
    DenseGraph dense(n);
    const auto add = [&](int u, int v) {
      const double w = std::pow(10, uniform(random, -6, 6));
      links.push_back({u, v});
      weight.push_back(w);
      dense.add(u, v, w);
    };
    for (int v = 1; v < n; ++v) add(draw(random, 0, v - 1), v);
    for (int k = draw(random, 0, 10); k > 0; --k) {
      const int u = draw(random, 0, n - 2);
      add(u, draw(random, u + 1, n - 1));
    }
    trees::SpanningTrees trees = trees::spanning_trees(n, links, weight);
    const double expected =
        std::log(dense.laplacian.bottomRightCorner(n - 1, n - 1).fullPivLu().determinant());
    CHECK(trees.log_trees == Approx(expected).epsilon(1e-6).margin(1e-5));
    const MatrixXd x = dense.laplacian.bottomRightCorner(n - 1, n - 1).inverse();
    for (std::size_t k = 0; k < links.size(); ++k) {
      const auto at = [&](int i, int j) { return i == 0 || j == 0 ? 0 : x(i - 1, j - 1); };
      const auto [u, v] = links[k];
      const double r = at(u, u) + at(v, v) - 2 * at(u, v);
      if (r > 1e-6 * (at(u, u) + at(v, v)))
        CHECK(trees::resistance(trees, links[k]) == Approx(r).epsilon(1e-4));
    }
  }
}
