// The table of sg-bayes: the cliques of an elimination.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cmd/common/method.h"
#include "cmd/common/table.h"
#include "lib/elim/bayes_tree.h"

namespace sg::bayes {

// A Bayes tree with the ids of its variables, which take the space of all cliques together.
struct NamedTree {
  const Graph& graph;
  std::string label;  // of the order
  graph::GraphPattern variables;
  graph::Order order;
  elim::BayesTree tree;
  std::vector<Index> depth;
  std::optional<graph::Lists<>> frontals_ = {};
  std::optional<graph::Lists<>> separators_ = {};

  const graph::Lists<>& frontals() {
    return cmd::once(frontals_, [&] { return elim::clique_frontals(tree); });
  }
  const graph::Lists<>& separators() {
    return cmd::once(separators_, [&] {
      return elim::clique_separators(elim::ordered(variables.pattern, order), tree);
    });
  }
};
NamedTree named_tree(const cmd::MethodOptions& options, const Graph& graph,
                     const cmd::Method& method);

struct Row {
  NamedTree& named;
  Index clique;

  const NamedTree& subject() const { return named; }
  cmd::IdList frontal() const;  // in elimination order
  cmd::IdList separator() const;
  std::int64_t frontal_dim() const { return named.tree.frontal_dim[clique]; }
  std::int64_t total_dim() const { return named.tree.total_dim[clique]; }
  std::optional<Index> parent() const {
    const Index above = named.tree.parent[clique];
    return above < 0 ? std::nullopt : std::optional(above);
  }
};
extern const std::vector<cmd::Column<Row>> columns;

}  // namespace sg::bayes
