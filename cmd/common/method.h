// -m METHOD,... and --seed of the commands that eliminate: which order of a graph they look at.
#pragma once

#include <string>
#include <vector>

#include "cmd/common/command.h"
#include "lib/order/order.h"

namespace sg::cmd {

// How long best may look, and for what.
struct BestOptions {
  std::string budget = {};       // empty: the default
  std::string minimize = "ec";   // or a column of sg-ec that lib/solve/forecast.h foretells
  const bool* report = nullptr;  // whether each improvement is a line on standard error: -v
};

struct MethodOptions {
  std::vector<std::string> names;  // empty: the file's order if sg-order left one, else the default
  std::uint64_t seed = 1;
  BestOptions best = {};
};
void add_methods(Command& command, MethodOptions& options);  // -m NAME,...
void add_method(Command& command, MethodOptions& options);   // -m NAME

// --budget and --minimize, which are nothing without -m best.
void add_best(Command& command, BestOptions& options);
// `asked`: the call has -m best. Throws usage Errors: for either option where not, for values that are none, and for
// seconds where nobody calibrated.
void check_best(const Command& command, bool asked, const BestOptions& options);
void set_best(const BestOptions& options, order::OrderOptions& order_options);
bool asks_for_best(const MethodOptions& options);

// Throws a usage Error for a name that no ordering has: worth knowing before a graph is read.
void check(const MethodOptions& options);

// An anytime ordering ends with the best so far at an interruption (interrupt.h).
void stop_when_interrupted(const order::Ordering& ordering, order::OrderOptions& options);

struct Method {
  std::string label;  // its name; "file:NAME" where sg-order's comment made the choice
  const order::Ordering* ordering;
};
std::vector<Method> methods(const MethodOptions& options, const Graph& graph);

// The order of a graph's variables, or of those of a part of the graph.
graph::Order order_by(const Method& method, const MethodOptions& options, const Graph& graph,
                      const graph::GraphPattern& variables);

// The same for a command that looks at one order.
struct NamedOrder {
  std::string label;
  graph::Order order;
};
NamedOrder named_order(const MethodOptions& options, const Graph& graph,
                       const graph::GraphPattern& variables);

}  // namespace sg::cmd
