// Orderings, elimination complexity and the Bayes tree.
#include <algorithm>

#include "lib/elim/bayes_tree.h"
#include "lib/elim/score.h"
#include "lib/graph/replay.h"
#include "lib/order/order.h"
#include "python/bind.h"

namespace sg::python {
namespace {

struct Eliminated {
  graph::GraphPattern variables;
  graph::Order order;
};
Eliminated eliminated(const Graph& graph, const OrderArgument& order, std::uint64_t seed) {
  graph::GraphPattern variables = graph::graph_pattern(graph);
  graph::Order chosen = chosen_order(order, seed, graph, variables);
  return {std::move(variables), std::move(chosen)};
}

py::array_t<Id> ids_in_order(const Graph& graph, const Eliminated& of, std::span<const Index> at) {
  std::vector<Index> vertices;
  for (const Index position : at)
    vertices.push_back(of.variables.variable_vertex[of.order[position]]);
  return ids_of(graph, vertices);
}

py::array_t<Id> order(const Graph& graph, const std::string& method, std::uint64_t seed,
                      const std::vector<Id>& last) {
  std::vector<Index> vertices;
  unlocked([&] {
    const graph::GraphPattern variables = graph::graph_pattern(graph);
    order::OrderOptions options = order::order_options(graph, variables);
    options.seed = order::draw_of(seed);
    for (const Id id : last) {
      const auto v = graph::find_vertex(graph, id);
      if (!v || variables.vertex_variable[*v] < 0)
        throw text::usage_error("last: " + std::to_string(id) + " is no variable of the graph");
      options.last.push_back(variables.vertex_variable[*v]);
    }
    for (const Index j : order::elimination_order(method, variables.pattern, options))
      vertices.push_back(variables.variable_vertex[j]);
  });
  return ids_of(graph, vertices);
}

py::object ec(const Graph& graph, const py::object& order, std::uint64_t seed) {
  const OrderArgument argument = order_argument(order);
  return whole(unlocked([&] {
    const Eliminated of = eliminated(graph, argument, seed);
    return elim::elimination_complexity(of.variables.pattern, of.order);
  }));
}

py::dict elimination(const Graph& graph, const py::object& order, std::uint64_t seed) {
  const OrderArgument argument = order_argument(order);
  elim::Wide system = 0;
  const elim::Score score = unlocked([&] {
    const Eliminated of = eliminated(graph, argument, seed);
    system = elim::system_nnz(of.variables.pattern);
    return elim::score(elim::symbolic(of.variables.pattern, of.order));
  });
  using namespace py::literals;
  return py::dict("ec"_a = whole(score.ec), "ec_bt"_a = whole(score.ec_bt),
                  "nnz"_a = whole(score.nnz), "fill"_a = whole(score.nnz - system),
                  "flops"_a = whole(score.flops), "rose"_a = whole(score.rose),
                  "max_clique"_a = score.max_clique, "height"_a = score.height,
                  "cliques"_a = score.cliques);
}

py::dict bayes_tree(const Graph& graph, const py::object& order, std::uint64_t seed) {
  const OrderArgument argument = order_argument(order);
  struct Tree {
    Eliminated of;
    elim::BayesTree tree;
    graph::Lists<> frontals, separators;
  };
  const Tree all = unlocked([&] {
    Tree result;
    result.of = eliminated(graph, argument, seed);
    result.tree = elim::bayes_tree(elim::symbolic(result.of.variables.pattern, result.of.order));
    result.frontals = elim::clique_frontals(result.tree);
    result.separators = elim::clique_separators(
        elim::ordered(result.of.variables.pattern, result.of.order), result.tree);
    return result;
  });
  py::list frontals, separators;
  for (Index c = 0; c < all.tree.cliques(); ++c) {
    frontals.append(ids_in_order(graph, all.of, all.frontals[c]));
    separators.append(ids_in_order(graph, all.of, all.separators[c]));
  }
  using namespace py::literals;
  return py::dict("parent"_a = array(all.tree.parent), "frontals"_a = frontals,
                  "separators"_a = separators, "frontal_dim"_a = array(all.tree.frontal_dim),
                  "total_dim"_a = array(all.tree.total_dim));
}

py::dict growth(const Graph& graph, const std::string& method, Index every, int min_obs,
                std::uint64_t seed) {
  if (every < 1) throw text::usage_error("every: 1 or more");
  std::vector<Index> steps, edges;
  std::vector<double> ec;
  unlocked([&] {
    const graph::Replay replay = graph::replay(graph, graph::pose_index(graph), min_obs);
    graph::grow(graph, replay, [&](const graph::Grown& grown) {
      if (grown.step % every != 0 && grown.step + 1 != replay.steps) return true;
      const auto variables = graph::graph_pattern(graph, grown.vertex_in, grown.edge_in);
      steps.push_back(grown.step);
      edges.push_back(grown.edges);
      ec.push_back(elim::to_double(elim::elimination_complexity(
          variables.pattern, chosen_order({method, {}}, seed, graph, variables))));
      return true;
    });
  });
  using namespace py::literals;
  return py::dict("step"_a = array(steps), "edges"_a = array(edges), "ec"_a = array(ec));
}

}  // namespace

OrderArgument order_argument(const py::object& order) {
  if (py::isinstance<py::str>(order)) return {py::cast<std::string>(order), {}};
  const auto ids = Ids::ensure(order);
  if (!ids) throw py::error_already_set();
  return {"", {ids.data(), ids.data() + ids.size()}};
}

graph::Order chosen_order(const OrderArgument& order, std::uint64_t seed, const Graph& graph,
                          const graph::GraphPattern& variables) {
  if (!order.method.empty()) {
    order::OrderOptions options = order::order_options(graph, variables);
    options.seed = order::draw_of(seed);
    return order::elimination_order(order.method, variables.pattern, options);
  }
  graph::Order result;
  for (const Id id : order.ids) {
    const auto v = graph::find_vertex(graph, id);
    result.push_back(v ? variables.vertex_variable[*v] : -1);
    if (result.back() < 0)
      throw text::usage_error("order: " + std::to_string(id) + " is no variable of the graph");
  }
  if (!graph::is_permutation(result, variables.pattern.variables()))
    throw text::usage_error("order: every one of the " +
                            std::to_string(variables.pattern.variables()) +
                            " variables stands in it once");
  return result;
}

void bind_elimination(py::module_& module) {
  using namespace py::literals;
  module.def(
      "orderings",
      [] {
        py::dict all;
        for (const auto& row : order::orderings()) all[py::str(row.name)] = row.description;
        return all;
      },
      "Names of the orderings, and what each is.");
  module.def("order", &order, "graph"_a, "method"_a = "wmf", py::kw_only(), "seed"_a = 1,
             "last"_a = std::vector<Id>(),
             "ids of the variables in an elimination order, the first to be eliminated first.\n"
             "last: ids that are to be eliminated after all others.");
  module.def("ec", &ec, "graph"_a, "order"_a = std::string(order::default_ordering), py::kw_only(),
             "seed"_a = 1,
             "Elimination complexity, exactly. order: a method's name, or ids as `order` gives.");
  module.def("elimination", &elimination, "graph"_a,
             "order"_a = std::string(order::default_ordering), py::kw_only(), "seed"_a = 1,
             "What an elimination costs, by the names of the columns of sg-ec(1).");
  module.def("growth", &growth, "graph"_a, "order"_a = std::string(order::default_ordering),
             py::kw_only(), "every"_a = 1, "min_obs"_a = 1, "seed"_a = 1,
             "The graph as it grows, as sg-ec --trace prints it: step, edges and ec (rounded to a "
             "double).");
  module.def("bayes_tree", &bayes_tree, "graph"_a, "order"_a = std::string(order::default_ordering),
             py::kw_only(), "seed"_a = 1,
             "The Bayes tree, a clique an index, parents before children: parent (-1 at a root), "
             "frontals and\nseparators (ids), frontal_dim and total_dim.");
}

}  // namespace sg::python
