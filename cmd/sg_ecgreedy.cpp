// sg-ecgreedy: keep the candidates that tell most of where the poses are for what they cost to eliminate.
#include <algorithm>
#include <limits>
#include <utility>

#include "cmd/common/interrupt.h"
#include "cmd/common/method.h"
#include "cmd/common/options.h"
#include "cmd/common/prune_options.h"
#include "cmd/common/table.h"
#include "cmd/ecgreedy/budget.h"
#include "lib/prune/ecgreedy.h"
#include "lib/prune/exchange.h"
#include "lib/prune/part.h"
#include "lib/score/covariance.h"

using namespace sg;

namespace {

struct Options {
  cmd::PruneOptions pruning;
  cmd::TableOptions table;
  cmd::MethodOptions method{{"wmf"}};
  cmd::Amount amount;
  std::optional<double> ec, ec_part, sigma, sigma_part;
  std::vector<double> at;
  std::string gain = "trace";
  bool exchange = false;
  bool no_free = false;
  bool trace = false;
};

// A move.
struct Row {
  const Graph& graph;
  bool positions;  // whether there are any
  std::size_t move;
  const prune::Move& made;

  std::optional<Id> end(std::size_t k) const {
    const bool one =
        made.kind == prune::Move::Kind::edge || made.kind == prune::Move::Kind::landmark;
    if (!one || graph.edge(made.edges.front()).size() <= k) return std::nullopt;
    return graph.id[graph.edge(made.edges.front())[k]];
  }
  std::optional<double> gain() const {
    return made.kind == prune::Move::Kind::start ? std::nullopt : std::optional(made.gain);
  }
  std::optional<double> sigma() const {
    return positions ? std::optional(made.sigma) : std::nullopt;
  }
};

const std::vector<cmd::Column<Row>> columns{
    {"move", "Its number; the start has 0", &Row::move},
    {"kind", "start, edge, landmark, drop or free", [](Row& row) { return name(row.made.kind); }},
    {"first", "Id of the first vertex of its edge, or first edge",
     [](Row& row) { return row.end(0); }},
    {"second", "Id of its second vertex", [](Row& row) { return row.end(1); }},
    {"added", "Candidates that come in by it, or go by a drop",
     [](Row& row) { return row.made.edges.size(); }},
    {"gain", "By how much it improves what is maximized", &Row::gain},
    {"increase", "Of EC, under the order as it was", [](Row& row) { return row.made.increase; }},
    {"ec", "After it, under that order", [](Row& row) { return row.made.ec; }},
    {"sigma", "Mean standard deviation of a pose's position", &Row::sigma},
    {"kept", "Candidates that are kept by then", [](Row& row) { return row.made.kept; }},
};

void add_options(cmd::Command& command, Options& options) {
  cmd::add_input(command, options.pruning.input);
  auto& app = command.app;
  app.add_option("--ec", options.ec, "Until EC is EC,")->type_name("EC")->check(cmd::above_zero());
  app.add_option("--ec-part", options.ec_part, "or this part of the whole graph's,")
      ->type_name("PART")
      ->check(cmd::above_zero());
  app.add_option("--sigma", options.sigma, "or the mean sigma of positions is SIGMA,")
      ->type_name("SIGMA")
      ->check(cmd::above_zero());
  app.add_option("--sigma-part", options.sigma_part, "or so many times the whole graph's (1.05),")
      ->type_name("TIMES")
      ->check(cmd::above_zero());
  app.add_option("--at", options.at, "or EC is each of these, %d in -o")
      ->type_name("EC,...")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(cmd::above_zero());
  cmd::add_amount(command, options.amount);
  app.add_option("--gain", options.gain, "What counts: trace (default), aligned, logdet, trees")
      ->option_text("KIND")
      ->check(cmd::one_of({"trace", "aligned", "logdet", "trees"}));
  app.add_flag("--exchange", options.exchange, "Then exchange what tells least (slower)");
  app.add_flag("--no-free", options.no_free, "Leave out what would cost no EC as well");
  app.add_option("-m,--method", options.method.names,
                 "The ordering that EC is counted in (default: wmf)")
      ->option_text("METHOD")
      ->expected(1);
  cmd::add_seed(app, options.method.seed, "Seed of estimates and the ordering");
  app.add_flag("--trace", options.trace, "Print a row a move, instead of the graph");
  cmd::add_pruning(command, options.pruning);
  cmd::add_table(command, options.table, columns);
}

std::string with_budget(std::string path, double budget) {
  if (const auto place = path.find("%d"); place != std::string::npos)
    path.replace(place, 2, elim::to_string(ecgreedy::rounded(budget)));
  return path;
}

void check_call(const cmd::Command& command, const Options& options) {
  cmd::exactly_one(command.app,
                   {{"--ec", "keeps what EC costs"},
                    {"--ec-part", "what this part of the whole graph's EC costs"},
                    {"--sigma", "what this accuracy wants"},
                    {"--sigma-part", "what so many times the whole graph's sigma wants"},
                    {"--at", "what each EC costs"},
                    {"-r", "one in R"},
                    {"-p", "this part of them"},
                    {"-k", "so many"},
                    {"--like", "as many as FILE has"}},
                   "how many candidates stay?");
  if (!options.ec && !options.ec_part && options.at.empty())
    cmd::refuse(command.app, {"--exchange"}, "without --ec, --ec-part or --at");
  cmd::check(options.method);
  cmd::check_form(command.app);
  if (options.gain == "trees")
    cmd::refuse(command.app, {"--sigma", "--sigma-part"}, "with --gain trees: that has no sigma");
  if (!options.trace) cmd::refuse_table(command.app, "without --trace");
  if (options.trace && options.pruning.output.path.empty())
    cmd::refuse(command.app, {"--no-trace-comment"}, "with --trace and no -o");
  const bool one_file = options.pruning.output.path.find("%d") == std::string::npos;
  if (options.at.size() > 1 && one_file && (!options.trace || !options.pruning.output.path.empty()))
    throw text::usage_error("several budgets want -o with %d in its name: -o run-%d.g2o");
}

// The graph about to be pruned, and what its edges tell.
struct Subject {
  cmd::Prunable from;
  prune::Choice choice;
  prune::Evidence evidence;

  Subject(cmd::Prunable prunable, const Options& options)
      : from(std::move(prunable)),
        choice{from.graph, from.poses, from.candidates, options.pruning.min_obs} {}
};

// The budget that the call gives, in the library's terms.
void set_budget(const Options& options, const Subject& subject, prune::EcGreedyOptions& greedy) {
  if (options.ec) greedy.ec = ecgreedy::rounded(*options.ec);
  if (options.sigma) greedy.sigma = options.sigma;
  if (options.ec_part)
    greedy.ec = ecgreedy::part_of_ec(subject.from.graph, *options.ec_part, greedy);
  if (options.sigma_part) {
    const auto whole = prune::whole_sigma(subject.choice, subject.evidence, greedy);
    if (whole) greedy.sigma = *options.sigma_part * *whole;
  }
  if (!options.at.empty()) greedy.ec = ecgreedy::rounded(std::ranges::max(options.at));
  greedy.start_ec =
      options.at.empty() ? greedy.ec : ecgreedy::rounded(std::ranges::min(options.at));
  if (!greedy.ec && !greedy.sigma)
    greedy.kept = static_cast<Index>(
        cmd::kept_count(options.amount, subject.from, options.pruning.input.options));
}

// The moves; the Error of a singular system where the whole graph is.
std::vector<prune::Move> moves_of(const Options& options, Subject& subject,
                                  prune::EcGreedyOptions& greedy) {
  const Graph& graph = subject.from.graph;
  if (options.gain == "trees") {
    subject.evidence = prune::tree_evidence(graph);
    set_budget(options, subject, greedy);
    std::vector<prune::Move> moves = prune::ecgreedy(subject.choice, subject.evidence, greedy);
    if (moves.empty())
      throw text::computation_error(graph.file + ": too badly scaled for spanning trees");
    return moves;
  }
  ecgreedy::Linearized whole = ecgreedy::linearized(graph);
  subject.evidence = std::move(whole.evidence);
  set_budget(options, subject, greedy);
  std::vector<prune::Move> moves = prune::ecgreedy(subject.choice, subject.evidence, greedy);
  if (!moves.empty()) return moves;
  throw score::singular_error(whole.problem, whole.values);
}

void print_trace(const Options& options, const Graph& graph, std::span<const prune::Move> moves) {
  cmd::Output output("");
  cmd::Table table(options.table, columns, {}, output);
  const bool positions = options.gain != "trees";
  for (std::size_t k = 0; k < moves.size(); ++k) table.row({graph, positions, k, moves[k]});
  output.commit();
}

// As many of the moves as a budget of EC allows; a warning where not even the start is within.
std::span<const prune::Move> within(const cmd::Command& command, const Subject& subject,
                                    std::span<const prune::Move> moves,
                                    const prune::EcGreedyOptions& greedy) {
  const auto made = moves.first(prune::moves_within(subject.choice, moves, *greedy.ec, greedy));
  if (made.size() > 1) return made;
  const elim::Wide least = prune::ec_after(subject.choice, made, greedy);
  if (least > *greedy.ec)
    cmd::warn(command, "an EC of " + elim::to_string(*greedy.ec) +
                           " is less than that of the sparsest start, " + elim::to_string(least));
  return made;
}

// The moves of one budget, with what is free at its end.
std::vector<prune::Move> moves_at(const cmd::Command& command, const Options& options,
                                  const Subject& subject, std::span<const prune::Move> moves,
                                  const prune::EcGreedyOptions& greedy) {
  if (greedy.ec) moves = within(command, subject, moves, greedy);
  std::vector<prune::Move> made(moves.begin(), moves.end());
  if (options.exchange)
    made = prune::exchanged(subject.choice, subject.evidence, greedy, std::move(made));
  if (options.no_free || cmd::interrupted()) return made;
  return ecgreedy::with_free(subject.choice, subject.evidence, made, greedy);
}

void write(const cmd::Command& command, const cmd::PruneOptions& pruning, bool asked,
           const Subject& subject, std::span<const prune::Move> made) {
  const std::vector<bool> kept = prune::kept_by(subject.from.candidates, made);
  cmd::warn_if_nothing_goes(command, subject.from, kept, asked);
  cmd::write_pruned(command, pruning, subject.from,
                    prune::removal_of_rest(subject.from.graph, subject.from.candidates, kept));
}

void run(const cmd::Command& command, const Options& options) {
  check_call(command, options);
  Subject subject(cmd::read_prunable(options.pruning), options);
  const Graph& graph = subject.from.graph;
  prune::EcGreedyOptions greedy;
  greedy.gain = options.gain == "trace"     ? prune::GainKind::trace
                : options.gain == "aligned" ? prune::GainKind::aligned
                                            : prune::GainKind::log_det;
  greedy.seed = order::draw_of(options.method.seed);
  greedy.told = options.trace;
  const cmd::Method method = cmd::methods(options.method, graph).front();
  greedy.order = [&](const graph::GraphPattern& variables) {
    return cmd::order_by(method, options.method, graph, variables);
  };
  greedy.go_on = [](Index kept) {
    cmd::progress(kept);
    return !cmd::interrupted();
  };
  cmd::finish_first();
  cmd::stage("prune", static_cast<std::int64_t>(subject.from.candidates.size()));
  const std::vector<prune::Move> moves = moves_of(options, subject, greedy);
  const bool asked = cmd::asks_to_prune(options.amount);
  const bool writes = !options.trace || !options.pruning.output.path.empty();
  if (options.at.empty() || options.trace) {
    const auto made = moves_at(command, options, subject, moves, greedy);
    if (options.trace) print_trace(options, graph, made);
    if (options.at.empty() && writes) write(command, options.pruning, asked, subject, made);
  }
  for (const double budget : options.at) {
    if (!writes) return;
    cmd::PruneOptions pruning = options.pruning;
    pruning.output.path = with_budget(options.pruning.output.path, budget);
    greedy.ec = ecgreedy::rounded(budget);
    write(command, pruning, asked, subject, moves_at(command, options, subject, moves, greedy));
  }
}

}  // namespace

int main(int argc, char** argv) {
  return cmd::run(
      cmd::Command("sg-ecgreedy", "Keep the edges that add most accuracy for their EC."), argc,
      argv, add_options, run);
}
