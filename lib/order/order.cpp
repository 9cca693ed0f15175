#include "lib/order/order.h"

#include <algorithm>
#include <cassert>
#include <string>

#include "lib/order/methods.h"
#include "lib/text/error.h"

namespace sg {
namespace {

constexpr Ordering table[] = {
    {"file", "as the file lists the vertices", ordering::file},
    {"id", "by ascending id", ordering::id},
    {"landmarks-first", "landmarks by id, then the rest by id (the paper's)",
     ordering::landmarks_first},
    {"colamd", "CCOLAMD without dense-row removal, on the factors", ordering::colamd},
    {"amd", "AMD, on the block graph", ordering::amd},
    {"wmf", "weighted minimum fill, on the block graph", ordering::wmf},
    {"metis", "nested dissection by METIS", ordering::metis},
    {"scotch", "nested dissection by Scotch", ordering::scotch},
    {"mmd", "multiple minimum degree (Boost.Graph)", ordering::mmd},
    {"rcm", "reverse Cuthill-McKee (Boost.Graph)", ordering::rcm},
    {"king", "King's profile reduction, reversed (Boost.Graph)", ordering::king},
    {"sloan", "Sloan's profile and wavefront reduction (Boost.Graph)", ordering::sloan},
    {"best", "the best of all, improved until --budget is used up", ordering::best},
    {"random", "at random, by --seed", ordering::random},
};

void move_to_end(Order& order, const std::vector<Index>& last) {
  std::vector<bool> is_last(order.size(), false);
  for (Index j : last) is_last.at(j) = true;
  std::stable_partition(order.begin(), order.end(), [&](Index j) { return !is_last[j]; });
}

}  // namespace

std::span<const Ordering> orderings() {
  return table;
}

const Ordering& find_ordering(std::string_view name) {
  std::string names;
  for (const Ordering& ordering : table) {
    if (ordering.name == name) return ordering;
    names += (names.empty() ? "" : ", ") + std::string(ordering.name);
  }
  throw usage_error("no ordering is called '" + std::string(name) + "'; there are " + names);
}

Order elimination_order(const Ordering& ordering, const Pattern& pattern,
                        const OrderOptions& options) {
  assert(options.file_order.empty() || is_permutation(options.file_order, pattern.variables()));
  assert(options.landmark.empty() || options.landmark.size() == pattern.dim.size());
  Order order = ordering.compute(pattern, options);
  assert(is_permutation(order, pattern.variables()));
  move_to_end(order, options.last);
  return order;
}

Order elimination_order(std::string_view name, const Pattern& pattern,
                        const OrderOptions& options) {
  return elimination_order(find_ordering(name), pattern, options);
}

OrderOptions order_options(const Graph& graph, const GraphPattern& pattern) {
  OrderOptions options;
  options.file_order.reserve(pattern.variable_vertex.size());
  for (Index v : file_order(graph)) {
    if (const Index j = pattern.vertex_variable[v]; j >= 0) options.file_order.push_back(j);
  }
  options.landmark.reserve(pattern.variable_vertex.size());
  for (Index v : pattern.variable_vertex) {
    options.landmark.push_back(graph.role(v) == Role::landmark);
  }
  return options;
}

}  // namespace sg
