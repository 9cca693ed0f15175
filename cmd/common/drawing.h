// The options of commands that show eliminations of graphs: as a table, or by --dot, one of one graph, as a drawing.
#pragma once

#include <string>

#include "cmd/common/method.h"
#include "cmd/common/table.h"

namespace sg::cmd {

struct DrawingOptions {
  Inputs inputs;
  MethodOptions method;
  OutputOptions output;
  TableOptions table;
  bool dot = false;
};

// `drawn` is what --dot draws.
template <class Row>
void add_drawing(Command& command, DrawingOptions& options, const std::string& drawn,
                 const std::vector<Column<Row>>& columns) {
  add_inputs(command, options.inputs);
  add_methods(command, options.method);
  command.app.add_flag("--dot", options.dot, "Draw the " + drawn + ", for Graphviz");
  add_output(command, options.output);
  add_table(command, options.table, columns);
}

inline void check_drawing(const Command& command, const DrawingOptions& options) {
  check_form(command.app);
  check(options.method);
  if (!options.dot) return;
  refuse_table(command.app, "with --dot, which draws");
  if (options.inputs.paths.size() > 1 || options.method.names.size() > 1)
    throw text::usage_error("--dot draws one elimination: give it one FILE and one ordering");
}

// Calls show(graph, method) for every file and, of each, every ordering.
inline void each_elimination(const DrawingOptions& options, const auto& show) {
  for (const auto& path : options.inputs.paths) {
    const Graph graph = read(options.inputs, path);
    for (const Method& method : methods(options.method, graph)) show(graph, method);
  }
}

// The first columns, and what of their needs a call has. `subject` gives of a row what it is of: a graph and an order's
// label.
template <class Row>
std::vector<Column<Row>> with_subject(std::vector<Column<Row>> columns) {
  columns.insert(
      columns.begin(),
      {{"file", "The file", [](Row& row) { return row.subject().graph.file; }, "several files"},
       {"order", "The ordering", [](Row& row) { return row.subject().label; },
        "several orderings"}});
  return columns;
}
inline Given given(const DrawingOptions& options) {
  return {{"several files", options.inputs.paths.size() > 1},
          {"several orderings", options.method.names.size() > 1}};
}

}  // namespace sg::cmd
