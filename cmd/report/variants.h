// Policies by rates by orderings: what is left of a graph, what that costs, and what it is worth.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cmd/report/orderings.h"
#include "cmd/report/policies.h"
#include "cmd/report/sheet.h"
#include "cmd/report/study.h"
#include "cmd/scoring/columns.h"

namespace sg::report {

struct Variant {
  std::string policy;
  std::optional<Index> rate;
  std::string order;
  Index vertices, edges;
  elim::Wide ec;
  double of_full;  // share of EC of the whole graph in the first ordering
  std::optional<double> median_s = {}, isam2_s = {};
  std::optional<double> sigma = {}, ate = {};
  std::string pipe;                     // that writes the graph in this order
  std::vector<std::string> calls = {};  // that print EC, then what else was measured
};

struct Choice {
  std::vector<const Policy*> policies;  // the first is that of the whole graph
  std::vector<Index> rates;
  Index min_obs;  // landmarks that keep fewer go
};

// The whole graph first. Every variant is measured under the first ordering and under that of least EC (which a policy's
// graph has anew). `reference`: what trajectories are compared with; empty: the whole graph, solved. A part of what is
// left of the time goes to each, so that there is something of all.
std::vector<Variant> variants(Study& study, const Choice& choice,
                              const std::vector<Ordered>& orderings,
                              const std::optional<scoring::Reference>& reference,
                              const std::string& reference_file, const Deadline& deadline);
Sheet sheet(const std::vector<Variant>& variants);

}  // namespace sg::report
