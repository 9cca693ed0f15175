// The table of sg-info: what is in a graph.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "cmd/common/table.h"
#include "lib/graph/summary.h"

namespace sg::info {

struct Row {
  const Graph& graph;
  std::string_view format;
  graph::Summary summary;
  std::map<std::string, std::int64_t> tags;  // lines of each
};

// The facts of every graph. Those of a file's tags follow them.
extern const std::vector<cmd::Column<Row>> facts;

}  // namespace sg::info
