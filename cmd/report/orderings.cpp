#include "cmd/report/orderings.h"

#include <algorithm>

#include "cmd/ec/columns.h"
#include "cmd/solving/timing.h"
#include "lib/solve/linear_solver.h"
#include "lib/solve/start.h"

namespace sg::report {
namespace {

// Made when they are first asked for: the tables they are taken from are other files' globals.
const std::vector<cmd::Column<ec::ScoreRow>>& score_columns() {
  static const auto columns =
      some(ec::score_columns, {"order", "ec", "nnz", "max_clique", "height"});
  return columns;
}

const std::vector<cmd::Column<solving::Timing>>& time_columns() {
  static const auto columns = some(solving::time_columns, {"plan_s", "median_s", "s_per_ec"});
  return columns;
}

const std::string& backend() {
  static const std::string name(solve::backends().front().name);
  return name;
}

// Typical of a processor; the first measurement tells of this one.
constexpr double guessed_s_per_ec = 1e-9;

}  // namespace

Timer::Timer(const Graph& graph)
    : problem(factor::make_problem(graph)),
      values(solve::find_start(solve::own_start(graph)).make(problem)),
      system(factor::linearized(problem, values)) {}

std::unique_ptr<Timer> timer(const Graph& graph, std::vector<std::string>& notes) {
  try {
    return std::make_unique<Timer>(graph);
  } catch (const text::Error& error) {
    const std::string note = "not timed and not solved: " + text::message(error);
    if (std::ranges::find(notes, note) == notes.end()) notes.push_back(note);
    return nullptr;
  }
}

std::optional<double> median_seconds(const Study& study, Timer& timer, const std::string& label,
                                     const graph::Order& order, elim::Wide ec,
                                     const Deadline& deadline, std::vector<std::string>* cells) {
  const double expected = timer.s_per_ec.value_or(guessed_s_per_ec) * elim::to_double(ec);
  if (deadline.left() <= expected) return std::nullopt;
  const int runs = deadline.left() > timed_runs * expected ? timed_runs : 1;
  static const factor::Loss none;
  solving::Timing timing = solving::timed({runs, study.threads, backend(), study.methods, none},
                                          timer.problem, timer.values, timer.system, label, order);
  if (ec > 0) timer.s_per_ec = timing.median_s / elim::to_double(ec);
  if (cells) *cells = report::cells(time_columns(), timing);
  return timing.median_s;
}

std::vector<Ordered> orderings(Study& study, const Deadline& deadline) {
  std::vector<cmd::Method> methods;
  if (!study.graph.order_method.empty()) methods.push_back({"file", &order::find_ordering("file")});
  for (cmd::Method& method : cmd::methods(study.methods, study.graph))
    methods.push_back(std::move(method));
  std::vector<Ordered> result;
  for (const cmd::Method& method : methods) {
    if (!result.empty() && deadline.passed()) {
      study.notes.push_back("no time for the ordering " + method.label);
      continue;
    }
    const auto begin = std::chrono::steady_clock::now();
    graph::Order order = cmd::order_by(method, study.methods, study.graph, study.variables);
    const double seconds = cmd::seconds_since(begin);
    const ec::Subject of = subject(study, method);
    ec::ScoreRow row{of, order};
    const elim::Score& score = row.score();
    result.push_back(
        {method, std::move(order), seconds, score.ec, score.nnz, cells(score_columns(), row), {}});
  }
  const std::unique_ptr<Timer> system = timer(study.graph, study.notes);
  for (Ordered& one : result) {
    if (!system) break;
    try {
      median_seconds(study, *system, one.method.label, one.order, one.ec, deadline, &one.timing);
    } catch (const text::Error& error) {
      study.notes.push_back("not timed: " + text::message(error));
      break;
    }
  }
  return result;
}

Sheet sheet(const Study& study, const std::vector<Ordered>& orderings) {
  Sheet result;
  std::string methods;
  for (const Ordered& one : orderings) methods += (methods.empty() ? "" : ",") + one.method.label;
  result.call = call(study.source, "sg-ec -m " + methods + " -f " + names(score_columns())) + "\n" +
                call(study.source, "sg-solve --time " + std::to_string(timed_runs) + " -m " +
                                       methods + " -f order," + names(time_columns()));
  result.columns = cmd::headings(score_columns());
  result.columns.push_back({"bytes", "That the entries of the factor take, 8 each", ""});
  result.columns.push_back({"order_s", "Seconds to find the order", ""});
  for (cmd::Heading& heading : cmd::headings(time_columns()))
    result.columns.push_back(std::move(heading));
  for (const Ordered& one : orderings) {
    std::vector<std::string> row = one.score;
    row.push_back(elim::to_string(8 * one.nnz));
    row.push_back(cmd::text(one.order_s));
    row.insert(row.end(), one.timing.begin(), one.timing.end());
    row.resize(result.columns.size());
    result.rows.push_back(std::move(row));
  }
  return result;
}

}  // namespace sg::report
