#include <algorithm>
#include <cmath>

#include "cmd/plot/heat.h"
#include "cmd/plot/picture.h"
#include "cmd/plot/scenes.h"
#include "cmd/plot/words.h"
#include "lib/elim/bayes_tree.h"
#include "lib/graph/lists.h"

namespace sg::plot {
namespace {

constexpr double narrowest = 0.15;  // points: less is not seen

struct CliqueCosts {
  std::vector<double> own;    // of every clique: d_f (d_f + d_s)^2
  std::vector<double> below;  // with all that hangs on it
};

CliqueCosts costs_of(const elim::BayesTree& tree) {
  CliqueCosts costs;
  for (Index c = 0; c < tree.cliques(); ++c)
    costs.own.push_back(
        elim::to_double(elim::elimination_cost(tree.frontal_dim[c], tree.total_dim[c])));
  costs.below = costs.own;
  for (Index c = tree.cliques() - 1; c >= 0; --c) {  // children come after their parents
    if (tree.parent[c] >= 0) costs.below[tree.parent[c]] += costs.below[c];
  }
  return costs;
}

std::vector<int> depths(const elim::BayesTree& tree) {
  std::vector<int> depth(tree.cliques(), 0);
  for (Index c = 0; c < tree.cliques(); ++c) {
    if (tree.parent[c] >= 0) depth[c] = depth[tree.parent[c]] + 1;
  }
  return depth;
}

// Where the cells of a clique's children begin, or those of all roots: side by side, in the order of their numbers.
std::vector<double> lefts(const elim::BayesTree& tree, const CliqueCosts& costs, double scale) {
  std::vector<double> left(tree.cliques()), next(tree.cliques());
  double roots = margin;
  for (Index c = 0; c < tree.cliques(); ++c) {
    double& place = tree.parent[c] < 0 ? roots : next[tree.parent[c]];
    left[c] = next[c] = place;
    place += scale * costs.below[c];
  }
  return left;
}

}  // namespace

void draw_tree(cairo_t* page, const PageSize& size, const elim::Symbolic& symbolic,
               Heading heading) {
  const elim::BayesTree tree = elim::bayes_tree(symbolic);
  if (tree.cliques() == 0) return draw_heading(page, size, heading);
  const CliqueCosts costs = costs_of(tree);
  const std::vector<int> depth = depths(tree);
  double total = 0;
  for (Index c = 0; c < tree.cliques(); ++c) total += costs.own[c];
  const double scale = (size.width - 2 * margin) / total;
  const std::vector<double> left = lefts(tree, costs, scale);
  const int levels = 1 + *std::max_element(depth.begin(), depth.end());
  const auto is_seen = [&](Index c) { return scale * costs.below[c] >= narrowest; };
  int rows = 1;
  for (Index c = 0; c < tree.cliques(); ++c) {
    if (is_seen(c)) rows = std::max(rows, 1 + depth[c]);
  }
  const double row = std::min(margin, (size.height - 2 * margin) / rows);
  const double largest = *std::max_element(costs.own.begin(), costs.own.end());
  const double gap = std::min(0.5, row / 5);
  Index shown = 0;
  for (Index c = 0; c < tree.cliques(); ++c) {
    if (!is_seen(c)) continue;
    const double width = scale * costs.below[c];
    ++shown;
    set_color(page, heat(std::sqrt(costs.own[c] / largest)));
    cairo_rectangle(page, left[c], margin + row * depth[c],
                    std::max(narrowest, width - std::min(gap, width / 4)), row - gap);
    cairo_fill(page);
  }
  heading.below =
      counted(tree.cliques(), "clique", "cliques") +
      (shown < tree.cliques() ? ", " + std::to_string(shown) + " wide enough to see" : "") + ", " +
      counted(levels, "level", "levels") + "; as wide as a clique costs with all below it";
  draw_heading(page, size, heading);
  draw_heat_legend(page, size, "a clique's own share of EC", largest, total);
}

}  // namespace sg::plot
