// Measurements come and go by what they are worth for their elimination complexity, in what is left of a graph.
#pragma once

#include <functional>

#include "lib/marginalize/whole.h"

namespace sg::marginalize {

struct State {
  const std::vector<Offer>& offers;
  double ec;
  double lost;    // but for a constant, in nats
  double strain;  // half of the chi-square of errors that bring what is owed (errors.h)
};

// Starts from what is taken. In turns: informations are fitted (whole.h); each measurement has a worth, and a price in the
// order of what is left (prices.h), those that are there by descending worth, so that each pays for what it adds to
// those that are worth more. What is worth less than `rate` nats a unit of EC goes and what is worth more comes, those first that
// gain most, no two of them at one vertex, as a worth only holds beside the others. What holds together what is recovered stays.
//
// What carries a force is worth its strain, too: others would have to carry it, with larger errors, and a graph under
// strain has other valleys.
//
// Every state is shown to `see`, the last fitted to the end. It ends where nothing gains.
void exchange(const Whole& whole, const Eigen::VectorXd& owed, double rate,
              std::vector<Offer>& offers, const std::function<void(const State&)>& see);

}  // namespace sg::marginalize
