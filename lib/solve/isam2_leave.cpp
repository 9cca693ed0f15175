#include "lib/solve/isam2_leave.h"

#include <algorithm>
#include <numeric>

#include "lib/graph/components.h"

namespace sg::solve {
namespace {

bool holds(std::span<const Index> variables, Index j) {
  return std::ranges::find(variables, j) != variables.end();
}

auto leaves(const Isam2& isam) {
  return [&isam](Index j) { return bool(isam.leaving[j]); };
}

// Calls visit(d) for the children of clique c, priors apart, that have variable j in their separator.
void for_holders_below(const Isam2& isam, Index c, Index j, const auto& visit) {
  for (Index d = isam.tree.cliques[c].first_child; d >= 0; d = isam.tree.cliques[d].next) {
    const Isam2Clique& child = isam.tree.cliques[d];
    if (!is_prior(child) && holds(separators_of(isam.tree, child), j)) visit(d);
  }
}

// Whether a variable that stays was eliminated before variable j, of clique c.
bool is_below_staying(const Isam2& isam, Index c, Index j) {
  bool found = false;
  for_holders_below(isam, c, j, [&](Index d) {
    found = found ||
            !std::ranges::all_of(frontals_of(isam.tree, isam.tree.cliques[d]), leaves(isam)) ||
            is_below_staying(isam, d, j);
  });
  return found;
}

void mark_holders(Isam2& isam, Index c, Index j) {
  mark_to_root(isam, c);
  for_holders_below(isam, c, j, [&](Index d) { mark_holders(isam, d, j); });
}

elim::Wide cost(std::int64_t f, std::int64_t s) {
  return elim::elimination_cost(f, f + s);
}

// What a clique, which costs `ec`, does without those of its frontal variables that leave.
elim::Wide cost_without(const Isam2& isam, std::span<const Index> frontals, auto&& variable,
                        std::int64_t s, std::int64_t ec) {
  if (std::ranges::none_of(frontals, leaves(isam), variable)) return static_cast<elim::Wide>(ec);
  std::int64_t f = 0;
  for (Index j : frontals) f += isam.leaving[variable(j)] ? 0 : pattern_of(isam).dim[variable(j)];
  return cost(f, s);
}

// A clique in two.
struct Parts {
  std::vector<Index> leaving, staying;            // frontals
  std::vector<Index> leaving_rows, staying_rows;  // that reach one that leaves, and that do not
  std::vector<Index> priors;                      // children that reach one that leaves
  std::vector<Index> neighbours;                  // N, in elimination order
};

Parts parts_of(const Isam2& isam, const Isam2Clique& clique) {
  Parts parts;
  const auto frontals = frontals_of(isam.tree, clique);
  const auto separators = separators_of(isam.tree, clique);
  std::ranges::partition_copy(frontals, std::back_inserter(parts.leaving),
                              std::back_inserter(parts.staying), leaves(isam));
  std::vector<Index> touched;
  const auto reaches = [&](std::span<const Index> variables) {
    if (std::ranges::none_of(variables, [&](Index j) { return holds(parts.leaving, j); }))
      return false;
    touched.insert(touched.end(), variables.begin(), variables.end());
    return true;
  };
  std::ranges::partition_copy(rows_of(isam.tree, clique), std::back_inserter(parts.leaving_rows),
                              std::back_inserter(parts.staying_rows),
                              [&](Index r) { return reaches(pattern_of(isam).rows[r]); });
  for (Index d = clique.first_child; d >= 0; d = isam.tree.cliques[d].next) {
    const Isam2Clique& child = isam.tree.cliques[d];
    if (is_prior(child) && reaches(separators_of(isam.tree, child))) parts.priors.push_back(d);
  }
  std::ranges::sort(touched);
  const auto is_touched = [&](Index j) { return std::ranges::binary_search(touched, j); };
  std::ranges::copy_if(parts.staying, std::back_inserter(parts.neighbours), is_touched);
  std::ranges::copy_if(separators, std::back_inserter(parts.neighbours), is_touched);
  return parts;
}

// A clique of these lists, alone, with room for its numbers.
Index make_clique(Isam2& isam, std::span<const Index> frontals, std::span<const Index> separators,
                  std::span<const Index> rows) {
  const auto dim = [&](std::span<const Index> list) {
    return std::accumulate(list.begin(), list.end(), 0,
                           [&](int sum, Index j) { return sum + pattern_of(isam).dim[j]; });
  };
  Isam2Clique sizes;
  sizes.frontals = static_cast<Index>(frontals.size());
  sizes.separators = static_cast<Index>(separators.size());
  sizes.rows = static_cast<Index>(rows.size());
  sizes.f = dim(frontals);
  sizes.s = dim(separators);
  sizes.ec = static_cast<std::int64_t>(cost(sizes.f, sizes.s));
  sizes.made = isam.updates;
  const Index c = add_clique(isam.tree, sizes);
  grow_numbers(isam.tree);
  auto to = lists_of(isam.tree, isam.tree.cliques[c]).begin();
  for (const auto& list : {frontals, separators, rows}) to = std::ranges::copy(list, to).out;
  return c;
}

void eliminate(Isam2& isam, Index c, Isam2Report& report) {
  report.ec += static_cast<elim::Wide>(isam.tree.cliques[c].ec);
  eliminate_clique(isam, c, report.undetermined);
}

void move_below(Isam2& isam, Index c, Index parent) {
  unlink(isam.tree, c);
  link(isam.tree, c, parent);
}

// Steps 1 and 2. Returns the prior, -1 where it would say nothing of anything.
Index eliminate_leaving(Isam2& isam, const Parts& parts, bool keep, Isam2Report& report) {
  Isam2Tree& tree = isam.tree;
  const Index q = make_clique(isam, parts.leaving, parts.neighbours, parts.leaving_rows);
  for (Index p : parts.priors) move_below(isam, p, q);
  eliminate(isam, q, report);
  Index prior = -1;
  if (!parts.neighbours.empty()) {
    prior = make_clique(isam, {}, parts.neighbours, {});
    const Front from = front_of(tree, tree.cliques[q]);
    std::copy_n(from.u, from.size_u(), front_of(tree, tree.cliques[prior]).u);
  }
  for (Index p : parts.priors) {
    unlink(tree, p);
    remove_clique(tree, p);
  }
  if (keep) {
    shelve_clique(tree, q);
    isam.past.push_back(q);
  } else {
    remove_clique(tree, q);
  }
  for (Index j : parts.neighbours) isam.pinned[j] = true;
  for (Index j : parts.leaving) tree.variable_clique[j] = -1;
  for (Index r : parts.leaving_rows) let_row_go(isam, r);
  isam.variables -= static_cast<Index>(parts.leaving.size());
  return prior;
}

void leave_clique(Isam2& isam, Index c, bool keep, Isam2Report& report) {
  Isam2Tree& tree = isam.tree;
  const auto child_with_leaving = [&] {
    Index d = tree.cliques[c].first_child;
    while (d >= 0 && std::ranges::none_of(frontals_of(tree, tree.cliques[d]), leaves(isam)))
      d = tree.cliques[d].next;
    return d;
  };
  for (Index d = child_with_leaving(); d >= 0; d = child_with_leaving())
    leave_clique(isam, d, keep, report);

  const Isam2Clique clique = tree.cliques[c];
  const Parts parts = parts_of(isam, clique);
  const Index prior = eliminate_leaving(isam, parts, keep, report);
  Index above = clique.parent;
  if (!parts.staying.empty()) {
    const std::vector<Index> separators(separators_of(tree, clique).begin(),
                                        separators_of(tree, clique).end());
    const Index rest = make_clique(isam, parts.staying, separators, parts.staying_rows);
    link(tree, rest, clique.parent);
    above = rest;
    for (Index j : parts.staying) tree.variable_clique[j] = rest;
    for (Index r : parts.staying_rows) tree.row_clique[r] = rest;
  }
  while (tree.cliques[c].first_child >= 0) move_below(isam, tree.cliques[c].first_child, above);
  if (prior >= 0) link(tree, prior, above);
  if (!parts.staying.empty()) eliminate(isam, above, report);
  unlink(tree, c);
  remove_clique(tree, c);
}

}  // namespace

graph::Order order_after(const Isam2Options& isam_options, const graph::Pattern& pattern,
                         std::span<const Index> first, std::span<const Index> last) {
  const Index n = pattern.variables();
  std::vector<Index> number(n, 0);
  for (Index j : first) number[j] = -1;
  graph::Pattern rest;
  graph::Order of_rest;
  for (Index j = 0; j < n; ++j) {
    if (number[j] < 0) continue;
    number[j] = rest.variables();
    rest.dim.push_back(pattern.dim[j]);
    of_rest.push_back(j);
  }
  // Eliminated together, `first` join those that rows join to them.
  graph::DisjointSets sets(n);
  std::vector<Index> reaching;
  for (Index r = 0; r < pattern.rows.size(); ++r) {
    Index one = -1;
    for (Index j : pattern.rows[r]) {
      if (number[j] >= 0) {
        rest.rows.items.push_back(number[j]);
      } else if (one < 0) {
        one = j;
      } else {
        graph::join(sets, one, j);
      }
    }
    if (one < 0) {
      rest.rows.close();
    } else {
      rest.rows.items.resize(rest.rows.begin.back());
      reaching.push_back(r);
    }
  }
  const graph::Lists<> joined = graph::counting_sort(n, [&](const auto& put) {
    for (Index r : reaching) {
      const auto row = pattern.rows[r];
      const Index one = *std::ranges::find_if(row, [&](Index j) { return number[j] < 0; });
      for (Index j : row) {
        if (number[j] >= 0) put(graph::find(sets, one), number[j]);
      }
    }
  });
  for (Index k = 0; k < n; ++k) {
    std::vector<Index> row(joined[k].begin(), joined[k].end());
    if (row.empty()) continue;
    std::ranges::sort(row);
    row.erase(std::unique(row.begin(), row.end()), row.end());
    rest.rows.add(row);
  }

  const std::string& method = isam_options.ordering;
  order::OrderOptions options;
  options.budget = isam_options.order_budget;
  options.last = of_rest;
  graph::Order order = order::elimination_order(method, pattern, options);
  order.resize(first.size());
  options.last.clear();
  for (Index j : last) options.last.push_back(number[j]);
  for (Index k : order::elimination_order(method, rest, options)) order.push_back(of_rest[k]);
  return order;
}

void leave_cliques_apart(Isam2& isam) {
  if (isam.options.relaxed_from == never) return;
  isam.options.relaxed_from = never;
  for (Index c = 0; c < static_cast<Index>(isam.tree.cliques.size()); ++c) {
    if (is_there(isam.tree.cliques[c]) && isam.tree.cliques[c].merged > 1) mark_to_root(isam, c);
  }
}

void mark_leaving(Isam2& isam, std::span<const Index> leaving) {
  if (!leaving.empty()) leave_cliques_apart(isam);
  for (Index j : leaving) {
    const Index c = isam.tree.variable_clique[j];
    if (c >= 0 && is_below_staying(isam, c, j)) mark_holders(isam, c, j);
  }
}

elim::Wide ec_after(const Isam2& isam, const CliqueTree& plan, std::span<const Index> leaving) {
  const Isam2Tree& tree = isam.tree;
  elim::Wide ec = tree.ec_bt;
  for (Index c : isam.work.marked) ec -= static_cast<elim::Wide>(tree.cliques[c].ec);
  const auto of_top = [&](Index k) { return isam.work.variables[k]; };
  for (Index k = 0; k < plan.cliques(); ++k)
    ec += cost_without(isam, plan.frontals[k], of_top, plan.separator_dim[k], plan.ec[k]);
  std::vector<Index> beyond;  // cliques
  for (Index j : leaving) {
    const Index c = tree.variable_clique[j];
    if (c >= 0 && tree.cliques[c].marked != isam.updates) beyond.push_back(c);
  }
  std::ranges::sort(beyond);
  beyond.erase(std::unique(beyond.begin(), beyond.end()), beyond.end());
  for (Index c : beyond) {
    const Isam2Clique& clique = tree.cliques[c];
    ec -= static_cast<elim::Wide>(clique.ec);
    ec += cost_without(isam, frontals_of(tree, clique), std::identity(), clique.s, clique.ec);
  }
  return ec;
}

void take_leave(Isam2& isam, std::span<const Index> leaving, bool keep, Isam2Report& report) {
  for (Index j : leaving) {
    const Index c = isam.tree.variable_clique[j];
    if (c >= 0) leave_clique(isam, c, keep, report);
  }
  for (Index j : leaving) isam.leaving[j] = false;
}

}  // namespace sg::solve
