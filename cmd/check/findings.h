// The table of sg-check: what is wrong with a graph.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cmd/common/table.h"
#include "lib/graph/check.h"

namespace sg::check {

struct Message {
  std::string file;
  std::size_t line;  // 0: of the whole file
  graph::Severity severity;
  std::string cause;
};
std::string_view name(graph::Severity severity);
extern const std::vector<cmd::Column<Message>> columns;

// By line. `format`: what the graph was read from; `consumer`: --for, or empty.
std::vector<Message> findings(const Graph& graph, std::string_view format,
                              std::string_view consumer);

}  // namespace sg::check
