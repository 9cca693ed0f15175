// sg-tgreedy: keep the candidates that add most to the weighted number of spanning trees.
#include <utility>

#include "cmd/common/options.h"
#include "cmd/common/prune_options.h"
#include "cmd/common/table.h"
#include "lib/prune/tgreedy.h"
#include "lib/text/words.h"

namespace {

struct Options {
  sg::PruneOptions pruning;
  sg::TableOptions table;
  sg::Amount amount;
  std::string weights = "unit";
  std::optional<std::string> online;
  bool trace = false;
};

// A candidate that is kept.
struct Row {
  const sg::Graph& graph;
  std::int64_t kept;
  const sg::Accepted& accepted;

  sg::Id end(int k) const { return graph.id[graph.edge(accepted.edge)[k]]; }
};

const std::vector<sg::Column<Row>> columns{
    {"kept", "How many are kept by then", &Row::kept},
    {"first", "Id of the edge's first vertex", [](Row& row) { return row.end(0); }},
    {"second", "Id of its second vertex", [](Row& row) { return row.end(1); }},
    {"joins", "1 where it joins two parts, else 0", [](Row& row) { return row.accepted.joins; }},
    {"gain", "By how much it raises the criterion", [](Row& row) { return row.accepted.gain; }},
    {"log_trees", "The criterion after it: log t(G), or that of dopt",
     [](Row& row) { return row.accepted.criterion; }},
};

void add_options(sg::Command& command, Options& options) {
  sg::add_input(command, options.pruning.input);
  sg::add_amount(command, options.amount);
  sg::add_weights(command.app, options.weights, "Of edges");
  command.app
      .add_option("--online", options.online, "Choose after every N steps (1), of what is seen")
      ->expected(0, 1)
      ->option_text("[N]");
  command.app.add_flag("--trace", options.trace, "Print a row an edge kept, instead of the graph");
  sg::add_pruning(command, options.pruning);
  sg::add_table(command, options.table, columns);
}

// N may be left out, and FILE may follow: a word that is no number is FILE.
std::optional<sg::Index> online_steps(const Options& options, std::string& path) {
  if (!options.online) return std::nullopt;
  std::string word = *options.online;
  if (!word.empty() && !sg::parse<double>(word) && path == "-") path = std::exchange(word, "");
  if (word.empty()) return 1;
  if (const std::string cause = sg::at_least_one()(word); !cause.empty())
    throw sg::usage_error("--online: " + cause);
  return sg::parse<sg::Index>(word);
}

void print_trace(const Options& options, const sg::Graph& graph,
                 const std::vector<sg::Accepted>& accepted) {
  sg::Output output("");
  sg::Table table(options.table, columns, {}, output);
  std::int64_t kept = 0;
  for (const sg::Accepted& edge : accepted) table.row({graph, ++kept, edge});
  output.commit();
}

void warn_of_parts(const sg::Command& command, const sg::Graph& graph, const sg::PoseIndex& poses,
                   const sg::Removal& removal) {
  const sg::Index parts = sg::pose_parts(graph, poses, removal.edge);
  const std::vector<bool> all(graph.edges(), false);
  if (parts > sg::pose_parts(graph, poses, all)) {
    sg::warn(command, "the trajectory falls into " + std::to_string(parts) +
                          " parts: too few candidates are kept to join them");
  }
}

void prune(const sg::Command& command, const Options& options) {
  sg::PruneOptions pruning = options.pruning;
  const std::optional<sg::Index> online = online_steps(options, pruning.input.path);
  const sg::Prunable from = sg::read_prunable(pruning);
  const auto& [graph, poses, kind, candidates] = from;
  const auto count = sg::kept_count(options.amount, from, options.pruning.input.options);
  const sg::TreeWeights weights = sg::tree_weights(options.weights).value();
  const auto accepted = online
                            ? sg::tgreedy_online(graph, poses, candidates, count, weights, *online)
                            : sg::tgreedy(graph, candidates, count, weights);
  sg::Removal removal = sg::nothing_removed(graph);
  for (const sg::Index e : candidates) removal.edge[e] = true;
  for (const sg::Accepted& step : accepted) removal.edge[step.edge] = false;
  warn_of_parts(command, graph, poses, removal);
  if (options.trace) print_trace(options, graph, accepted);
  if (options.trace && options.pruning.output.path.empty()) return;
  sg::write_pruned(command, options.pruning, from, std::move(removal));
}

}  // namespace

int main(int argc, char** argv) {
  return sg::run(
      sg::Command("sg-tgreedy", "Keep the edges that add most to the number of spanning trees."),
      argc, argv, add_options, prune);
}
