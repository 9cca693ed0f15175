// The options of commands that show one elimination of one graph: as a table, or by --dot as a
// drawing.
#pragma once

#include <string>

#include "cmd/common/method.h"
#include "cmd/common/table.h"

namespace sg::cmd {

struct DrawingOptions {
  Input input;
  MethodOptions method;
  OutputOptions output;
  TableOptions table;
  bool dot = false;
};

// `drawn` is what --dot draws.
template <class Row>
void add_drawing(Command& command, DrawingOptions& options, const std::string& drawn,
                 const std::vector<Column<Row>>& columns) {
  add_input(command, options.input);
  add_method(command, options.method);
  command.app.add_flag("--dot", options.dot, "Draw the " + drawn + ", for Graphviz");
  add_output(command, options.output);
  add_table(command, options.table, columns);
}

inline void check_drawing(const Command& command, const DrawingOptions& options) {
  check_form(command.app);
  if (options.dot) refuse_table(command.app, "with --dot, which draws");
}

}  // namespace sg::cmd
