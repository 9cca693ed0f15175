#include "cmd/common/prune_options.h"
#include "cmd/common/table.h"
#include "lib/prune/tgreedy.h"
#include "lib/text/words.h"

namespace {

struct Options {
  sg::Input input;
  sg::OutputOptions output;
  sg::TableOptions table;
  sg::Amount amount;
  std::string candidates;
  std::string weights = "unit";
  std::optional<sg::Index> online;
  bool trace = false;
  sg::Index min_obs = 1;
};

const std::vector<std::string_view> columns{"kept",  "first", "second",
                                            "joins", "gain",  "log_trees"};

void add_options(sg::Command& command, Options& options) {
  sg::add_input(command, options.input);
  sg::add_amount(command, options.amount);
  command.app
      .add_option("--weights", options.weights,
                  "Of edges: unit (default), translation, rotation,\nor dopt, both as D-optimality")
      ->type_name("KIND")
      ->check(CLI::IsMember({"unit", "translation", "rotation", "dopt"}).description(""));
  command.app
      .add_option("--online", options.online, "Choose after every N steps (1), of what is seen")
      ->type_name("[N]")
      ->check(sg::at_least_one());
  command.app.add_flag("--trace", options.trace, "Print a row an edge kept, instead of the graph");
  sg::add_candidates(command, options.candidates);
  sg::add_min_obs(command, options.min_obs);
  sg::add_filter_output(command, options.output);
  sg::add_table(command, options.table, columns);
}

void print_trace(const Options& options, const sg::Graph& graph,
                 const std::vector<sg::Accepted>& accepted) {
  sg::Output out("");
  sg::Table table(options.table, columns, out);
  std::int64_t kept = 0;
  for (const auto& [edge, joins, gain, criterion] : accepted) {
    const auto ends = graph.edge(edge);
    table.row({++kept, graph.id[ends[0]], graph.id[ends[1]], std::int64_t{joins}, gain, criterion});
  }
  out.commit();
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
  const sg::Graph graph = sg::read(options.input);
  const sg::PoseIndex poses = sg::pose_index(graph);
  const sg::Candidates kind = sg::candidates_named(options.candidates, graph);
  const auto candidates = sg::candidate_edges(graph, poses, kind);
  const auto count = sg::kept_count(options.amount, candidates.size(), kind, options.input.options);
  const sg::TreeWeights weights = sg::tree_weights(options.weights).value();
  const auto accepted =
      options.online ? sg::tgreedy_online(graph, poses, candidates, count, weights, *options.online)
                     : sg::tgreedy(graph, candidates, count, weights);
  sg::Removal removal = sg::nothing_removed(graph);
  for (sg::Index e : candidates) removal.edge[e] = true;
  for (const sg::Accepted& step : accepted) removal.edge[step.edge] = false;
  warn_of_parts(command, graph, poses, removal);
  if (options.trace) print_trace(options, graph, accepted);
  if (options.trace && options.output.path.empty()) return;
  sg::write_filtered(command, options.output, graph,
                     sg::pruned(command, graph, poses, options.min_obs, std::move(removal)));
}

// N may be left out, and a file name may follow: an N that is not there is put in.
std::vector<char*> with_default_batch(int argc, char** argv) {
  static char one[] = "1";
  std::vector<char*> words;
  for (int k = 0; k < argc; ++k) {
    words.push_back(argv[k]);
    const bool number = k + 1 < argc && sg::parse<double>(argv[k + 1]).has_value();
    if (std::string_view(argv[k]) == "--online" && !number) words.push_back(one);
  }
  return words;
}

}  // namespace

int main(int argc, char** argv) {
  sg::Command command("sg-tgreedy",
                      "Keep the edges that add most to the number of spanning trees.");
  Options options;
  add_options(command, options);
  std::vector<char*> words = with_default_batch(argc, argv);
  return sg::run(command, static_cast<int>(words.size()), words.data(),
                 [&] { prune(command, options); });
}
