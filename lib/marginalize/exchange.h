// Measurements come and go by what they are worth for their elimination complexity, in what is left of a graph.
#pragma once

#include <functional>
#include <limits>

#include "lib/marginalize/whole.h"

namespace sg::marginalize {

struct State {
  const std::vector<Offer>& offers;
  double ec;
  double lost;    // but for a constant, in nats
  double strain;  // half of the chi-square of errors that bring what is owed (errors.h)
};

// What an exchange is about. Every state is shown to `see`.
struct Terms {
  const Whole& whole;
  const Eigen::VectorXd& owed;  // by scalar of all vertices (errors.h)
  double rate;                  // nats that a unit of EC has to bring
  std::function<void(const State&)> see;
};

struct Move {
  Index offer;
  double gain;  // nats, EC for its price
};

struct Exchange {
  std::vector<Offer> offers;
  std::vector<Offer> best = {};                            // of all states
  double least = std::numeric_limits<double>::infinity();  // what that loses and costs
  std::vector<Move> moves = {};                            // from there
  double part = 1;                                         // of these that are made
  bool over = false;
  std::vector<double> strain = {};  // of what is taken
  graph::Order order = {};          // of what is left with it
};

// Starts from what is taken. In turns: informations are fitted (whole.h); each measurement has a worth, and a price in the
// order of what is left (prices.h), those that are there by descending worth, so that each pays for what it adds to
// those that are worth more. What is worth less than `rate` nats a unit of EC goes and what is worth more comes, those first that
// gain most, no two of them at one vertex, as a worth only holds beside the others. What holds together what is recovered stays.
//
// What carries a force is worth its strain, too: others would have to carry it, with larger errors, and a graph under
// strain has other valleys.
//
// A turn that ends with more lost than the best before it is taken back, and fewer moves made from there: those that gain
// most. It is over where nothing gains. all: of these offers, for any exchange of them.
void advance(const Terms& terms, int turns, Rest& all, Exchange& exchange);
// Its best state, fitted to the end, is what it has.
void settle(const Terms& terms, Exchange& exchange);

}  // namespace sg::marginalize
