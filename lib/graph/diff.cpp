#include "lib/graph/diff.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <limits>
#include <numeric>
#include <tuple>

namespace sg::graph {
namespace {

using Numbers = std::vector<double>;

// The measure of diff.h; infinity where the counts differ.
double distance(const Numbers& a, const Numbers& b) {
  if (a.size() != b.size()) return std::numeric_limits<double>::infinity();
  double most = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (a[k] == b[k] || (std::isnan(a[k]) && std::isnan(b[k]))) continue;
    const double d = std::abs(a[k] - b[k]) / std::max({1.0, std::abs(a[k]), std::abs(b[k])});
    most = std::isnan(d) ? std::numeric_limits<double>::infinity() : std::max(most, d);
  }
  return most;
}

// Appends what differs between the two lines, if anything does.
void compare(Index i, Index j, const Numbers& a, const Numbers& b, double tolerance,
             std::vector<Difference>& out) {
  const double by = distance(a, b);
  if (by > tolerance) out.push_back({i, j, std::isfinite(by) ? std::optional(by) : std::nullopt});
}

// Walks two ascending sequences side by side: both(i, j) for equal keys, only(i, -1) and only(-1, j) for the rest.
void align(Index count_a, Index count_b, const auto& order, const auto& both, const auto& only) {
  Index i = 0, j = 0;
  while (i < count_a || j < count_b) {
    const auto c = i == count_a   ? std::strong_ordering::greater
                   : j == count_b ? std::strong_ordering::less
                                  : order(i, j);
    if (std::is_lt(c)) {
      only(i++, Index{-1});
    } else if (std::is_gt(c)) {
      only(Index{-1}, j++);
    } else {
      both(i++, j++);
    }
  }
}

std::vector<Difference> diff_vertices(const Graph& a, const Graph& b, double tolerance) {
  std::vector<Difference> out;
  Numbers x, y;
  const auto listed = [](const Graph& graph, Index v) { return graph.vertex_line[v] != implied; };
  align(
      a.vertices(), b.vertices(), [&](Index i, Index j) { return a.id[i] <=> b.id[j]; },
      [&](Index i, Index j) {
        if (a.vertex_type[i] != b.vertex_type[j] || a.fixed[i] != b.fixed[j] ||
            listed(a, i) != listed(b, j)) {
          out.push_back({i, j});
        } else if (listed(a, i)) {
          vertex_numbers(a, i, x);
          vertex_numbers(b, j, y);
          compare(i, j, x, y, tolerance, out);
        }
      },
      [&](Index i, Index j) {
        out.push_back({i, j});
      });
  return out;
}

// Edges by type and ids; those of one key by their place in the file.
struct Sorted {
  const Graph& graph;
  std::vector<Index> edge;

  explicit Sorted(const Graph& graph_) : graph(graph_), edge(graph_.edges()) {
    std::iota(edge.begin(), edge.end(), 0);
    std::sort(edge.begin(), edge.end(), [&](Index e, Index f) {
      const auto c = order(graph, e, graph, f);
      return std::is_lt(c) || (std::is_eq(c) && e < f);
    });
  }
  static std::strong_ordering order(const Graph& a, Index e, const Graph& b, Index f) {
    if (a.edge_type[e] != b.edge_type[f]) return a.edge_type[e] <=> b.edge_type[f];
    const auto x = a.edge(e), y = b.edge(f);
    return std::lexicographical_compare_three_way(
        x.begin(), x.end(), y.begin(), y.end(),
        [&](Index v, Index w) { return a.id[v] <=> b.id[w]; });
  }
  // The end of the run of equal keys that begins at place k.
  Index run_end(Index k) const {
    Index end = k + 1;
    while (end < static_cast<Index>(edge.size()) &&
           std::is_eq(order(graph, edge[k], graph, edge[end])))
      ++end;
    return end;
  }
};

// What the line says behind the vertices: parameters and numbers.
Numbers said(const Graph& graph, Index e) {
  Numbers numbers, result;
  edge_numbers(graph, e, numbers);
  for (const Id id : edge_params(graph, e)) result.push_back(static_cast<double>(id));
  result.insert(result.end(), numbers.begin(), numbers.end());
  return result;
}

struct Said {
  Index e;
  Numbers numbers;
};
std::vector<Said> said_of(const Sorted& edges, Index begin, Index end) {
  std::vector<Said> all;
  for (Index k = begin; k < end; ++k)
    all.push_back({edges.edge[k], said(edges.graph, edges.edge[k])});
  return all;
}

// Takes the pairs that agree to the last digit out of both.
void drop_equal(std::vector<Said>& a, std::vector<Said>& b) {
  const auto less = [](const Said& x, const Said& y) { return x.numbers < y.numbers; };
  std::ranges::stable_sort(a, less);
  std::ranges::stable_sort(b, less);
  std::vector<Said> rest_a, rest_b;
  align(
      static_cast<Index>(a.size()), static_cast<Index>(b.size()),
      [&](Index i, Index j) {
        return a[i].numbers < b[j].numbers   ? std::strong_ordering::less
               : b[j].numbers < a[i].numbers ? std::strong_ordering::greater
                                             : std::strong_ordering::equal;
      },
      [](Index, Index) {},
      [&](Index i, Index j) {
        i >= 0 ? rest_a.push_back(std::move(a[i])) : rest_b.push_back(std::move(b[j]));
      });
  a = std::move(rest_a);
  b = std::move(rest_b);
  std::ranges::sort(a, {}, &Said::e);
  std::ranges::sort(b, {}, &Said::e);
}

std::vector<Difference> diff_edges(const Graph& a, const Graph& b, double tolerance) {
  std::vector<Difference> out;
  const Sorted x(a), y(b);
  Index i = 0, j = 0;
  const auto only = [&](const Sorted& edges, Index begin, Index end) {
    for (Index k = begin; k < end; ++k) {
      &edges == &x ? out.push_back({x.edge[k], -1}) : out.push_back({-1, y.edge[k]});
    }
    return end;
  };
  while (i < a.edges() && j < b.edges()) {
    const auto c = Sorted::order(a, x.edge[i], b, y.edge[j]);
    if (std::is_lt(c)) {
      i = only(x, i, x.run_end(i));
    } else if (std::is_gt(c)) {
      j = only(y, j, y.run_end(j));
    } else {
      const Index end_i = x.run_end(i), end_j = y.run_end(j);
      auto ours = said_of(x, i, end_i), theirs = said_of(y, j, end_j);
      drop_equal(ours, theirs);
      const std::size_t pairs = std::min(ours.size(), theirs.size());
      for (std::size_t k = 0; k < pairs; ++k)
        compare(ours[k].e, theirs[k].e, ours[k].numbers, theirs[k].numbers, tolerance, out);
      for (std::size_t k = pairs; k < ours.size(); ++k) out.push_back({ours[k].e, -1});
      for (std::size_t k = pairs; k < theirs.size(); ++k) out.push_back({-1, theirs[k].e});
      i = end_i;
      j = end_j;
    }
  }
  only(x, i, a.edges());
  only(y, j, b.edges());
  std::ranges::sort(out, {}, [](const Difference& d) { return std::tuple(d.a < 0, d.a, d.b); });
  return out;
}

// The first of each type and id, which holds, by type and id.
std::vector<Index> first_params(const Graph& graph) {
  const auto key = [&](Index k) { return std::tuple(graph.params[k].type, graph.params[k].id); };
  std::vector<Index> places(graph.params.size());
  std::iota(places.begin(), places.end(), 0);
  std::ranges::stable_sort(places, {}, key);
  const auto same = [&](Index a, Index b) { return key(a) == key(b); };
  places.erase(std::unique(places.begin(), places.end(), same), places.end());
  return places;
}

std::vector<Difference> diff_params(const Graph& a, const Graph& b, double tolerance) {
  std::vector<Difference> out;
  const std::vector<Index> x = first_params(a), y = first_params(b);
  Numbers numbers_a, numbers_b;
  align(
      static_cast<Index>(x.size()), static_cast<Index>(y.size()),
      [&](Index i, Index j) {
        const Param &p = a.params[x[i]], &q = b.params[y[j]];
        return p.type != q.type ? p.type <=> q.type : p.id <=> q.id;
      },
      [&](Index i, Index j) {
        param_numbers(a, a.params[x[i]], numbers_a);
        param_numbers(b, b.params[y[j]], numbers_b);
        compare(x[i], y[j], numbers_a, numbers_b, tolerance, out);
      },
      [&](Index i, Index j) {
        out.push_back({i < 0 ? -1 : x[i], j < 0 ? -1 : y[j]});
      });
  return out;
}

}  // namespace

Diff diff(const Graph& a, const Graph& b, double tolerance) {
  return {diff_vertices(a, b, tolerance), diff_edges(a, b, tolerance),
          diff_params(a, b, tolerance)};
}

}  // namespace sg::graph
