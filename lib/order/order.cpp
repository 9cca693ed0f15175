#include "lib/order/order.h"

#include <algorithm>
#include <cassert>
#include <string>

#include "lib/order/constraint.h"
#include "lib/order/methods.h"
#include "lib/text/error.h"
#include "lib/text/nearest.h"

namespace sg::order {
namespace {

constexpr Ordering table[] = {
    {"file", "as the file lists the vertices", methods::file},
    {"id", "by ascending id", methods::id},
    {"landmarks-first", "landmarks by id, then the rest by id (the paper's)",
     methods::landmarks_first},
    {"colamd", "CCOLAMD without dense-row removal, on the factors", methods::colamd},
    {"amd", "AMD, on the block graph", methods::amd},
    {"wmf", "weighted minimum fill, on the block graph", methods::wmf},
    {"quick", "colamd, or wmf where that takes less time in total", methods::quick},
    {"metis", "nested dissection by METIS", methods::metis},
    {"scotch", "nested dissection by Scotch", methods::scotch},
    {"mmd", "multiple minimum degree (Boost.Graph)", methods::mmd},
    {"rcm", "reverse Cuthill-McKee (Boost.Graph)", methods::rcm},
    {"king", "King's profile reduction, reversed (Boost.Graph)", methods::king},
    {"sloan", "Sloan's profile and wavefront reduction (Boost.Graph)", methods::sloan},
    {"best", "the best of all, improved until --budget is used up", methods::best},
    {"random", "at random, by --seed", methods::random},
};

}  // namespace

std::span<const Ordering> orderings() {
  return table;
}

const Ordering& find_ordering(std::string_view name) {
  for (const Ordering& ordering : table) {
    if (ordering.name == name) return ordering;
  }
  throw text::usage_error(text::no_such("ordering", name, text::names_of(table)));
}

graph::Order elimination_order(const Ordering& ordering, const graph::Pattern& pattern,
                               const OrderOptions& options) {
  assert(options.file_order.empty() ||
         graph::is_permutation(options.file_order, pattern.variables()));
  assert(options.landmark.empty() || options.landmark.size() == pattern.dim.size());
  graph::Order order = ordering.compute(pattern, options);
  assert(graph::is_permutation(order, pattern.variables()));
  move_to_end(order, options.last);
  return order;
}

graph::Order elimination_order(std::string_view name, const graph::Pattern& pattern,
                               const OrderOptions& options) {
  return elimination_order(find_ordering(name), pattern, options);
}

OrderOptions order_options(const Graph& graph, const graph::GraphPattern& pattern) {
  OrderOptions options;
  options.file_order.reserve(pattern.variable_vertex.size());
  for (Index v : graph::file_order(graph)) {
    if (const Index j = pattern.vertex_variable[v]; j >= 0) options.file_order.push_back(j);
  }
  options.landmark.reserve(pattern.variable_vertex.size());
  for (Index v : pattern.variable_vertex) {
    options.landmark.push_back(graph.role(v) == graph::Role::landmark);
  }
  return options;
}

}  // namespace sg::order
