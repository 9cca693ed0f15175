#include "cmd/common/command.h"
#include "cmd/common/table.h"
#include "lib/elim/score.h"

int main(int argc, char** argv) {
  sg::Command command("sg-ec", "Score the elimination complexity of a graph.");
  sg::Input input;
  sg::TableOptions table_options;
  const std::vector<std::string_view> names{"order", "vertices", "ec"};
  sg::add_input(command, input);
  sg::add_table(command, table_options, names);
  return sg::run(command, argc, argv, [&] {
    const sg::Graph graph = sg::read(input);
    const sg::GraphPattern pattern = sg::graph_pattern(graph);
    sg::Order order;
    for (const sg::Index v : sg::file_order(graph)) {
      if (pattern.vertex_variable[v] >= 0) order.push_back(pattern.vertex_variable[v]);
    }
    sg::Output output("");
    sg::Table table(table_options, names, output);
    table.row({std::string("file"), std::int64_t{graph.vertices()},
               sg::elimination_complexity(pattern.pattern, order)});
    output.commit();
  });
}
