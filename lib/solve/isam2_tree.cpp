#include "lib/solve/isam2_tree.h"

#include <cassert>

namespace sg::solve {
namespace {

Offset list_size(const Isam2Clique& c) {
  return Offset{c.frontals} + c.separators + c.rows;
}
Offset number_size(const Isam2Clique& c) {
  const Front front{nullptr, nullptr, c.f, c.f + c.s + 1};
  return front.size_l() + (c.factor ? 0 : front.size_u());
}

Index free_place(Isam2Tree& tree) {
  if (tree.free.empty()) {
    tree.cliques.emplace_back();
    return static_cast<Index>(tree.cliques.size()) - 1;
  }
  const Index c = tree.free.back();
  tree.free.pop_back();
  return c;
}

}  // namespace

Front front_of(Isam2Tree& tree, const Isam2Clique& c) {
  Front front{tree.numbers.at(c.numbers), nullptr, c.f, c.f + c.s + 1};
  if (!c.factor) front.u = front.l + front.size_l();
  return front;
}

Index add_clique(Isam2Tree& tree, const Isam2Clique& sizes) {
  assert(sizes.made >= 0 && sizes.f >= sizes.frontals && sizes.s >= sizes.separators);
  const Index c = free_place(tree);
  Isam2Clique& clique = tree.cliques[c];
  clique = sizes;
  clique.lists = tree.list_pool.take(list_size(clique));
  if (tree.list_pool.end() > static_cast<Offset>(tree.lists.size()))
    tree.lists.resize(2 * tree.list_pool.end());
  clique.numbers = tree.number_pool.take(number_size(clique));
  tree.ec_bt += static_cast<elim::Wide>(clique.ec);
  if (!is_prior(clique)) tree.count += clique.merged;
  return c;
}

void grow_numbers(Isam2Tree& tree) {
  tree.numbers.grow(tree.number_pool.end());
}

void shelve_clique(Isam2Tree& tree, Index c) {
  Isam2Clique& clique = tree.cliques[c];
  tree.ec_bt -= static_cast<elim::Wide>(clique.ec);
  if (!is_prior(clique)) tree.count -= clique.merged;
  clique.made = -1;
}

void remove_clique(Isam2Tree& tree, Index c) {
  shelve_clique(tree, c);
  const Isam2Clique& clique = tree.cliques[c];
  tree.list_pool.give(clique.lists, list_size(clique));
  tree.number_pool.give(clique.numbers, number_size(clique));
  tree.free.push_back(c);
}

void link(Isam2Tree& tree, Index c, Index parent) {
  Isam2Clique& clique = tree.cliques[c];
  assert(clique.parent < 0 && c != parent);
  clique.parent = parent;
  clique.next = clique.previous = -1;
  if (parent < 0) return;
  clique.next = tree.cliques[parent].first_child;
  if (clique.next >= 0) tree.cliques[clique.next].previous = c;
  tree.cliques[parent].first_child = c;
}

void unlink(Isam2Tree& tree, Index c) {
  Isam2Clique& clique = tree.cliques[c];
  if (clique.previous >= 0) {
    tree.cliques[clique.previous].next = clique.next;
  } else if (clique.parent >= 0) {
    tree.cliques[clique.parent].first_child = clique.next;
  }
  if (clique.next >= 0) tree.cliques[clique.next].previous = clique.previous;
  clique.parent = clique.next = clique.previous = -1;
}

}  // namespace sg::solve
