// A part of the graph under way: what is in, in an elimination order of its own, what that costs and what it knows.
#pragma once

#include "lib/elim/filled_graph.h"
#include "lib/prune/information_gain.h"
#include "lib/prune/move.h"

namespace sg::prune {

struct Part {
  const Choice& choice;
  const Evidence& evidence;
  const EcGreedyOptions& options;
  Knowledge knowledge;
  Selection in = {};
  graph::Order order = {};           // of all variables, those that are not in first
  std::vector<Index> position = {};  // in it
  elim::FilledGraph filled = {};     // variables called by their position
  elim::Wide fresh_ec = 0;           // when the order was made
  // Another for the factor, by dissection; empty before the first factor in the order. Its tree is low where that of a
  // cheap order of a path is a chain from end to end, and what a measurement's root holds is its way to the top.
  graph::Order low = {};
};

// Nothing is in yet.
Part make_part(const Choice& choice, const Evidence& evidence, const EcGreedyOptions& options);

// Takes in what these candidates leave (selection.h), in a new order.
void select(Part& part, const std::vector<bool>& kept);
// A new order of what is in.
void place_order(Part& part);
// Factors what is in, in the low order. Returns what is undetermined (information_gain.h).
std::vector<Index> refactor(Part& part);

// Positions of the variables of these rows, ascending: what they would join.
std::vector<Index> factor_of(const Part& part, std::span<const Index> rows);
// Whether all vertices of an edge are in.
bool all_in(const Part& part, Index e);

// What is maximized, of what is factored, whose variances are taken.
double achieved(Part& part);
// Of the gains, the one that is maximized.
double chosen(const Part& part, const Gain& gain);

// The mean sigma of the whole graph; nothing where that leaves something undetermined.
std::optional<double> whole_sigma(const Choice& choice, const Evidence& evidence,
                                  const EcGreedyOptions& options);

}  // namespace sg::prune
