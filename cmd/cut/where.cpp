#include "cmd/cut/where.h"

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <variant>

#include "lib/factor/initialize.h"
#include "lib/factor/residuals.h"
#include "lib/graph/replay.h"
#include "lib/text/nearest.h"
#include "lib/text/words.h"

namespace sg::cut {
namespace {

// What columns are asked about, each made when one first wants it.
struct Subject {
  const Graph& graph;
  std::optional<std::vector<graph::EdgeRole>> roles = {};
  std::optional<std::vector<factor::Residual>> residuals = {};
};

const factor::Residual& residual(Subject& subject, Index e) {
  if (!subject.residuals) {
    const factor::Problem problem = factor::make_problem(subject.graph);
    subject.residuals = factor::residuals(problem, factor::start_values(problem));
  }
  return (*subject.residuals)[e];
}

constexpr std::array role_names{"odometry", "loop", "observation", "other"};

std::string role(Subject& subject, Index e) {
  if (!subject.roles)
    subject.roles = graph::edge_roles(subject.graph, graph::pose_index(subject.graph));
  return role_names[static_cast<std::size_t>((*subject.roles)[e])];
}

using Value = std::variant<double, std::string>;
struct Column {
  std::string name;
  bool number;
  std::function<Value(Subject&, Index)> value;
};
const std::vector<Column> columns{
    {"chi2", true, [](Subject& s, Index e) { return residual(s, e).chi2; }},
    {"dof", true, [](Subject& s, Index e) { return 1.0 * residual(s, e).degrees; }},
    {"quantile", true, [](Subject& s, Index e) { return residual(s, e).quantile; }},
    {"role", false, role},
    {"type", false, [](Subject& s, Index e) { return s.graph.type_of_edge(e).tag; }},
};

text::Error wrong(const std::string& cause) {
  return text::usage_error("--where: " + cause);
}

bool is_operator(char c) {
  return c == '<' || c == '>' || c == '=' || c == '!';
}

// Words and operators, between which there may be blanks.
std::vector<std::string> tokens(const std::string& text) {
  std::vector<std::string> result;
  bool joined = false;
  for (const char c : text) {
    if (c == ' ' || c == '\t') {
      joined = false;
      continue;
    }
    if (joined && is_operator(c) == is_operator(result.back().back())) {
      result.back() += c;
    } else {
      result.emplace_back(1, c);
    }
    joined = true;
  }
  return result;
}

Comparison comparison(const std::string& name, const std::string& op, const std::string& value) {
  const std::vector<std::string> names = text::names_of(columns);
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) throw wrong(text::no_such("column", name, names));
  const auto column = static_cast<std::size_t>(found - names.begin());
  const bool number = columns[column].number;
  const std::vector<std::string> ops =
      number ? std::vector<std::string>{"<", "<=", ">", ">=", "=", "!="}
             : std::vector<std::string>{"=", "!="};
  if (std::ranges::find(ops, op) == ops.end())
    throw wrong("'" + op + "' does not compare a " + name + "; there are " + text::listed(ops));
  if (number && !text::parse<double>(value)) throw wrong("'" + value + "' is not a number");
  if (name == "role" && std::ranges::find(role_names, value) == role_names.end())
    throw wrong(text::no_such("role", value, {role_names.begin(), role_names.end()}));
  return {column, op, value};
}

bool compare(const auto& a, const std::string& op, const auto& b) {
  if (op == "=") return a == b;
  if (op == "!=") return a != b;
  if (op == "<") return a < b;
  if (op == "<=") return a <= b;
  return op == ">" ? a > b : a >= b;
}

bool holds(const Comparison& c, Subject& subject, Index e) {
  const Value value = columns[c.column].value(subject, e);
  if (const auto* number = std::get_if<double>(&value))
    return compare(*number, c.op, *text::parse<double>(c.value));
  return compare(std::get<std::string>(value), c.op, c.value);
}

}  // namespace

Condition parse_condition(const std::string& text) {
  const std::vector<std::string> words = tokens(text);
  Condition condition(1);
  for (std::size_t k = 0;; k += 4) {
    if (words.size() < k + 3)
      throw wrong("'" + text + "' is no condition, as 'chi2 < 9 or role = odometry' is one");
    condition.back().push_back(comparison(words[k], words[k + 1], words[k + 2]));
    if (words.size() == k + 3) return condition;
    if (words[k + 3] == "or")
      condition.emplace_back();
    else if (words[k + 3] != "and")
      throw wrong("'" + words[k + 3] + "' where and or or joins comparisons");
  }
}

std::vector<bool> edges_where(const Graph& graph, const Condition& condition) {
  Subject subject{graph};
  std::vector<bool> result(graph.edges());
  for (Index e = 0; e < graph.edges(); ++e) {
    result[e] = std::ranges::any_of(condition, [&](const auto& all) {
      return std::ranges::all_of(all, [&](const auto& c) { return holds(c, subject, e); });
    });
  }
  return result;
}

std::string where_columns() {
  return text::listed(text::names_of(columns));
}

}  // namespace sg::cut
