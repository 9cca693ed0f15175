// Walks for the smoothers that let go, and batch elimination to compare them with.
#pragma once

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "lib/solve/eliminate.h"
#include "lib/solve/isam2_window.h"
#include "tests/unit/common.h"

namespace sg::test {

inline std::string text(double number) {
  return std::to_string(number) + " ";
}

// A wavering walk in the plane: odometry, closures up to `reach` steps back, landmarks seen from poses in a row.
inline std::string walk(Random& random, int poses, int reach) {
  std::string lines;
  const auto relate = [&](int i, int j) {
    lines += "EDGE_SE2 " + std::to_string(2 * i) + " " + std::to_string(2 * j) + " " +
             text(j - i + uniform(random, -0.1, 0.1)) + text(uniform(random, -0.1, 0.1)) +
             text(uniform(random, -0.05, 0.05)) + "100 3 0 90 5 400\n";
  };
  for (int k = 1; k < poses; ++k) {
    relate(k - 1, k);
    if (draw(random, 0, 2) == 0) relate(std::max(0, k - draw(random, 1, reach)), k);
  }
  for (int l = 0; l < poses; ++l) {
    const int from = draw(random, 0, poses - 1), seen = draw(random, 1, reach);
    for (int k = from; k < std::min(poses, from + seen); ++k) {
      lines += "EDGE_SE2_XY " + std::to_string(2 * k) + " " + std::to_string(2 * l + 1) + " " +
               text(from - k + 2 + uniform(random, -0.1, 0.1)) +
               text(3 + uniform(random, -0.1, 0.1)) + "50 0 60\n";
    }
  }
  return lines;
}

// The largest difference of a step from that of batch elimination of the rows that count, linearized where their
// variables are now. past: of variables that have left, too.
inline double difference(const sg::solve::Isam2& isam, bool past,
                         const std::function<bool(sg::Index)>& counts) {
  const sg::factor::Problem& problem = *isam.problem;
  const sg::graph::Pattern& whole = problem.variables.pattern;
  std::vector<sg::Index> number(whole.variables(), -1), variable;
  sg::graph::Pattern pattern;
  sg::factor::LinearSystem system;
  system.begin.assign(1, 0);
  for (sg::Index r = 0; r < whole.rows.size(); ++r) {
    if (!counts(r)) continue;
    for (const sg::Index j : whole.rows[r]) {
      if (number[j] < 0) {
        number[j] = pattern.variables();
        pattern.dim.push_back(whole.dim[j]);
        variable.push_back(j);
      }
      pattern.rows.items.push_back(number[j]);
    }
    pattern.rows.close();
    const int height = sg::factor::block_rows(problem, r);
    std::vector<double> block(height * sg::factor::block_columns(whole, r));
    sg::factor::linearize_row(problem, isam.linearized, {}, r, block.data());
    system.numbers.insert(system.numbers.end(), block.begin(), block.end());
    system.height.push_back(height);
    system.begin.push_back(static_cast<sg::Offset>(system.numbers.size()));
  }
  system.pattern = &pattern;
  auto elimination =
      sg::solve::plan_elimination(system, sg::order::elimination_order("colamd", pattern));
  REQUIRE(sg::solve::eliminate(elimination, system).empty());
  std::vector<double> step;
  sg::solve::back_substitute(elimination, step);
  double most = 0;
  for (std::size_t k = 0; k < variable.size(); ++k) {
    if (!past && isam.tree.variable_clique[variable[k]] < 0) continue;
    for (int i = 0; i < pattern.dim[k]; ++i)
      most = std::max(most, std::abs(isam.step[problem.step_at[variable[k]] + i] -
                                     step[elimination.step_at[k] + i]));
  }
  return most;
}

// Of all rows that have ever entered, or where nothing has left, that are there: rows may have been linearized and
// refused, or given back.
inline double difference(const sg::solve::Isam2& isam, bool past) {
  const bool nothing_left = std::ranges::none_of(isam.pinned, std::identity());
  return difference(isam, past, [&](sg::Index r) {
    return isam.row_update[r] >= 0 && !(nothing_left && isam.tree.row_clique[r] < 0);
  });
}

// Counts of what is there; EC_BT is the sum over the cliques.
inline void check_counts(const sg::solve::Isam2& isam) {
  sg::Index variables = 0, rows = 0, cliques = 0;
  sg::elim::Wide ec = 0;
  for (const sg::solve::Isam2Clique& c : isam.tree.cliques) {
    if (!is_there(c)) continue;
    variables += c.frontals;
    rows += c.rows;
    cliques += is_prior(c) ? 0 : c.merged;
    const auto whole = static_cast<sg::elim::Wide>(c.f) * (c.f + c.s) * (c.f + c.s);
    ec += static_cast<sg::elim::Wide>(c.ec);
    CHECK((c.merged > 1 ? c.ec < static_cast<std::int64_t>(whole)
                        : c.ec == static_cast<std::int64_t>(whole)));
    CHECK(c.parent >= -1);
    if (c.separators == 0) continue;
    const sg::solve::Isam2Clique& parent = isam.tree.cliques[c.parent];
    CHECK(is_there(parent));
    for (const sg::Index j : separators_of(isam.tree, c)) {
      const auto above = lists_of(const_cast<sg::solve::Isam2Tree&>(isam.tree), parent)
                             .first(parent.frontals + parent.separators);
      CHECK(std::ranges::count(above, j) == 1);
      if (is_prior(c)) CHECK(isam.pinned[j]);
    }
  }
  CHECK(variables == isam.variables);
  CHECK(rows == isam.rows);
  CHECK(cliques == isam.tree.count);
  CHECK(ec == isam.tree.ec_bt);
}

inline sg::solve::Isam2Options exact(int trial) {
  sg::solve::Isam2Options options;
  options.wildfire_threshold = 0;
  options.relinearize_skip = trial % 3;
  options.relinearize_threshold = 0.01;
  if (trial % 4 == 3) options.ordering = "amd";
  if (trial % 2 == 0) options.relaxed_from = 0;
  return options;
}

}  // namespace sg::test
