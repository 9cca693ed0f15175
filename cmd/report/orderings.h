// What elimination costs under each ordering: exactly, and in seconds.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "cmd/report/sheet.h"
#include "cmd/report/study.h"
#include "lib/factor/linearize.h"

namespace sg::report {

struct Ordered {
  cmd::Method method;
  graph::Order order;
  double order_s;
  elim::Wide ec, nnz;
  std::vector<std::string> score;   // cells of sg-ec
  std::vector<std::string> timing;  // cells of sg-solve --time; of what was not timed, none
};

// The file's own ordering, if sg-order left one, and those of the call. Timed while the deadline allows.
std::vector<Ordered> orderings(Study& study, const Deadline& deadline);
Sheet sheet(const Study& study, const std::vector<Ordered>& orderings);

// A graph's elimination, to be timed under several orders.
struct Timer {
  explicit Timer(const Graph& graph);
  Timer(const Timer&) = delete;  // the system points to the problem's pattern

  factor::Problem problem;
  factor::Values values;
  factor::LinearSystem system;
  std::optional<double> s_per_ec = {};  // as last measured
};
// Nothing, and a note, where the graph cannot be linearized.
std::unique_ptr<Timer> timer(const Graph& graph, std::vector<std::string>& notes);
// The median of a few eliminations; of one where they would take too long, of none where that would.
std::optional<double> median_seconds(const Study& study, Timer& timer, const std::string& label,
                                     const graph::Order& order, elim::Wide ec,
                                     const Deadline& deadline,
                                     std::vector<std::string>* cells = {});

}  // namespace sg::report
