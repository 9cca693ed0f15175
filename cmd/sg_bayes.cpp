// sg-bayes: the Bayes tree of an elimination, as a table or as a drawing.
#include "cmd/bayes/tree.h"
#include "cmd/common/drawing.h"

using namespace sg;

namespace {

void print_dot(bayes::NamedTree& named, cmd::Output& output) {
  output.write("digraph bayes_tree {\n  node [shape=box, style=rounded];\n");
  for (Index c = 0; c < named.tree.cliques(); ++c) {
    const bayes::Row row{named, c};
    const std::string separator = cmd::text(row.separator());
    output.write("  c" + std::to_string(c) + " [label=\"" + cmd::text(row.frontal()) +
                 (separator.empty() ? "" : " : " + separator) + "\"];\n");
    if (row.parent())
      output.write("  c" + std::to_string(*row.parent()) + " -> c" + std::to_string(c) + ";\n");
  }
  output.write("}\n");
}

void show(const cmd::Command& command, const cmd::DrawingOptions& options) {
  cmd::check_drawing(command, options);
  cmd::Output output(options.output.path);
  std::optional<cmd::Table<bayes::Row>> table;
  if (!options.dot) table.emplace(options.table, bayes::columns, cmd::given(options), output);
  cmd::each_elimination(options, [&](const Graph& graph, const cmd::Method& method) {
    cmd::stage("eliminate");
    bayes::NamedTree named = bayes::named_tree(options.method, graph, method);
    if (options.dot) return print_dot(named, output);
    for (Index c = 0; c < named.tree.cliques(); ++c) table->row({named, c});
  });
  output.commit();
}

void add_options(cmd::Command& command, cmd::DrawingOptions& options) {
  cmd::add_drawing(command, options, "tree", bayes::columns);
}

}  // namespace

int main(int argc, char** argv) {
  return cmd::run(cmd::Command("sg-bayes", "Print the Bayes tree of a graph: its cliques."), argc,
                  argv, add_options, show);
}
