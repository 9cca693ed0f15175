// sg-tgreedy: keep the candidates that add most to the weighted number of spanning trees.
#include <utility>

#include "cmd/common/options.h"
#include "cmd/common/prune_options.h"
#include "cmd/common/table.h"
#include "lib/prune/tgreedy.h"
#include "lib/text/words.h"

using namespace sg;

namespace {

struct Options {
  cmd::PruneOptions pruning;
  cmd::TableOptions table;
  cmd::Amount amount;
  std::string weights = "unit";
  std::optional<std::string> online;
  bool trace = false;
};

// A candidate that is kept.
struct Row {
  const Graph& graph;
  std::int64_t kept;
  const prune::Accepted& accepted;

  Id end(int k) const { return graph.id[graph.edge(accepted.edge)[k]]; }
};

const std::vector<cmd::Column<Row>> columns{
    {"kept", "How many are kept by then", &Row::kept},
    {"first", "Id of the edge's first vertex", [](Row& row) { return row.end(0); }},
    {"second", "Id of its second vertex", [](Row& row) { return row.end(1); }},
    {"joins", "yes where it joins two parts, else no", [](Row& row) { return row.accepted.joins; }},
    {"gain", "By how much it raises the criterion", [](Row& row) { return row.accepted.gain; }},
    {"log_trees", "The criterion after it: log t(G), or that of dopt",
     [](Row& row) { return row.accepted.criterion; }},
};

void add_options(cmd::Command& command, Options& options) {
  cmd::add_input(command, options.pruning.input);
  cmd::add_amount(command, options.amount);
  cmd::add_weights(command.app, options.weights, "Of edges");
  command.app
      .add_option("--online", options.online, "Choose after every N steps (1), of what is seen")
      ->expected(0, 1)
      ->option_text("[N]");
  command.app.add_flag("--trace", options.trace, "Print a row an edge kept, instead of the graph");
  cmd::add_unused_seed(command.app);
  cmd::add_pruning(command, options.pruning);
  cmd::add_table(command, options.table, columns);
}

// N may be left out, and FILE may follow: a word that is no number is FILE.
std::optional<Index> online_steps(const Options& options, std::string& path) {
  if (!options.online) return std::nullopt;
  std::string word = *options.online;
  if (!word.empty() && !text::parse<double>(word) && path == "-") path = std::exchange(word, "");
  if (word.empty()) return 1;
  if (const std::string cause = cmd::whole(1)(word); !cause.empty())
    throw text::usage_error("--online " + cause);
  return text::parse<Index>(word);
}

void print_trace(const Options& options, const Graph& graph,
                 const std::vector<prune::Accepted>& accepted) {
  cmd::Output output("");
  cmd::Table table(options.table, columns, {}, output);
  std::int64_t kept = 0;
  for (const prune::Accepted& edge : accepted) table.row({graph, ++kept, edge});
  output.commit();
}

std::vector<prune::Accepted> chosen(const cmd::Prunable& from, std::size_t count,
                                    trees::Weights weights, std::optional<Index> online) {
  const prune::GoOn go_on = [](std::size_t kept) {
    cmd::progress(static_cast<std::int64_t>(kept));
    return kept == 0 || !cmd::interrupted();
  };
  cmd::finish_first();
  cmd::stage("prune", static_cast<std::int64_t>(count));
  return online ? prune::tgreedy_online(from.graph, from.poses, from.candidates, count, weights,
                                        *online, go_on)
                : prune::tgreedy(from.graph, from.candidates, count, weights, go_on);
}

void warn_of_parts(const cmd::Command& command, const Graph& graph, const graph::PoseIndex& poses,
                   const prune::Removal& removal) {
  const Index parts = prune::pose_parts(graph, poses, removal.edge);
  const std::vector<bool> all(graph.edges(), false);
  if (parts > prune::pose_parts(graph, poses, all)) {
    cmd::warn(command, "the trajectory falls into " + std::to_string(parts) +
                           " parts: too few candidates are kept to join them");
  }
}

void run(const cmd::Command& command, const Options& options) {
  cmd::check_amount(command);
  cmd::check_form(command.app);
  if (!options.trace) cmd::refuse_table(command.app, "without --trace");
  if (options.trace && options.pruning.output.path.empty())
    cmd::refuse(command.app, {"--no-trace-comment", "--min-obs"}, "with --trace and no -o");
  cmd::PruneOptions pruning = options.pruning;
  const std::optional<Index> online = online_steps(options, pruning.input.path);
  const cmd::Prunable from = cmd::read_prunable(pruning);
  const auto& [graph, poses, kind, candidates] = from;
  const auto count = cmd::kept_count(options.amount, from, options.pruning.input.options);
  const auto accepted = chosen(from, count, trees::tree_weights(options.weights).value(), online);
  const std::vector<bool> stays = prune::kept_by(candidates, accepted);
  prune::Removal removal = prune::removal_of_rest(graph, candidates, stays);
  warn_of_parts(command, graph, poses, removal);
  cmd::warn_if_nothing_goes(command, from, stays, cmd::asks_to_prune(options.amount));
  if (options.trace) print_trace(options, graph, accepted);
  if (options.trace && options.pruning.output.path.empty()) return;
  cmd::write_pruned(command, options.pruning, from, std::move(removal));
}

}  // namespace

int main(int argc, char** argv) {
  return cmd::run(
      cmd::Command("sg-tgreedy", "Keep the edges that add most to the number of spanning trees."),
      argc, argv, add_options, run);
}
