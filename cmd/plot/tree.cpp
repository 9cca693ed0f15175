#include <algorithm>
#include <cmath>

#include "cmd/plot/picture.h"
#include "cmd/plot/scenes.h"
#include "lib/elim/bayes_tree.h"
#include "lib/graph/lists.h"

namespace sg::plot {
namespace {

constexpr double margin = 24;

// Where cliques stand: `across` counts leaves from the left, `down` the levels.
struct Layout {
  std::vector<double> across;
  std::vector<int> down;
  double leaves = 0;
  int levels = 0;
};

// Leaves side by side in the order of a walk through the tree, every other clique above the middle
// of its children.
Layout layout(const elim::BayesTree& tree) {
  const graph::Lists<> children = graph::grouped(tree.parent, tree.cliques());
  Layout result;
  result.across.assign(tree.cliques(), 0);
  result.down.assign(tree.cliques(), 0);
  std::vector<Index> waiting;
  for (Index c = tree.cliques() - 1; c >= 0; --c) {
    if (tree.parent[c] < 0) waiting.push_back(c);
  }
  while (!waiting.empty()) {
    const Index c = waiting.back();
    waiting.pop_back();
    if (children[c].empty()) result.across[c] = result.leaves++;
    waiting.insert(waiting.end(), children[c].rbegin(), children[c].rend());
  }
  for (Index c = 0; c < tree.cliques(); ++c) {
    if (tree.parent[c] >= 0) result.down[c] = result.down[tree.parent[c]] + 1;
    result.levels = std::max(result.levels, result.down[c] + 1);
  }
  for (Index c = tree.cliques() - 1; c >= 0; --c) {  // children come after their parents
    if (children[c].empty()) continue;
    result.across[c] = (result.across[children[c].front()] + result.across[children[c].back()]) / 2;
  }
  return result;
}

struct Place {
  double x, y;
};

struct Places {
  std::vector<Place> at;  // of every clique
  double largest_radius;  // circles of neighbouring levels just touch, as long as they can be seen
};

Places places(const Layout& layout, const PageSize& size) {
  const double column = (size.width - 2 * margin) / std::max(1.0, layout.leaves);
  const double row = (size.height - 2 * margin) / std::max(1, layout.levels - 1);
  Places result{{}, std::clamp(row / 2, 1.5, margin)};
  for (std::size_t c = 0; c < layout.across.size(); ++c) {
    result.at.push_back(
        {margin + column * (layout.across[c] + 0.5), margin + row * layout.down[c]});
  }
  return result;
}

void draw_branches(cairo_t* page, const elim::BayesTree& tree, const std::vector<Place>& at) {
  set_color(page, faint_color);
  cairo_set_line_width(page, 0.5);
  for (Index c = 0; c < tree.cliques(); ++c) {
    if (tree.parent[c] < 0) continue;
    cairo_move_to(page, at[tree.parent[c]].x, at[tree.parent[c]].y);
    cairo_line_to(page, at[c].x, at[c].y);
  }
  cairo_stroke(page);
}

}  // namespace

void draw_tree(cairo_t* page, const PageSize& size, const elim::Symbolic& symbolic) {
  const elim::BayesTree tree = elim::bayes_tree(symbolic);
  if (tree.cliques() == 0) return;
  const Places place = places(layout(tree), size);
  draw_branches(page, tree, place.at);
  const auto largest =
      static_cast<double>(*std::max_element(tree.total_dim.begin(), tree.total_dim.end()));
  set_color(page, path_color, 0.8);
  for (Index c = 0; c < tree.cliques(); ++c) {
    const double share = static_cast<double>(tree.total_dim[c]) / largest;
    cairo_arc(page, place.at[c].x, place.at[c].y, place.largest_radius * std::sqrt(share), 0,
              2 * M_PI);
    cairo_fill(page);  // one by one: Cairo takes long over a path of many circles
  }
}

}  // namespace sg::plot
