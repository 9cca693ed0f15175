// What the parts of a page about one graph share.
#pragma once

#include <string>
#include <vector>

#include "cmd/common/method.h"
#include "cmd/ec/columns.h"
#include "cmd/report/calls.h"
#include "cmd/report/time.h"
#include "lib/graph/pattern.h"

namespace sg::report {

struct Study {
  const cmd::Command& command;
  const Graph& graph;
  const formats::ReadOptions& reading;  // of the graph
  Source source;
  const cmd::MethodOptions& methods;  // named
  int threads;
  std::vector<std::string> notes = {};  // what is missing on the page, and why
  graph::GraphPattern variables = graph::graph_pattern(graph);
};

// The whole graph under a method, for the columns of sg-ec.
inline ec::Subject subject(const Study& study, const cmd::Method& method) {
  return {study.methods, study.graph.file, {},     study.graph.vertices(), study.graph.edges(),
          study.graph,   study.variables,  &method};
}

constexpr int timed_runs = 5;  // sg-solve --time 5

}  // namespace sg::report
