#include "lib/marginalize/marginalize.h"

#include <algorithm>

#include "lib/marginalize/errors.h"
#include "lib/marginalize/market.h"

namespace sg::marginalize {
namespace {

// The id of a sensor that is where its pose is; its line, if the file has none, goes before those that need it.
Id sensor(const Graph& graph, std::string& lines) {
  Id free = 0;
  std::vector<double> numbers;
  std::vector<Id> seen;
  for (const graph::Param& param : graph.params) {
    free = std::max(free, param.id + 1);
    graph::param_numbers(graph, param, numbers);
    const bool first = std::ranges::count(seen, param.id) == 0;
    seen.push_back(param.id);
    if (param.type == graph::ParamTag::se3_offset && first &&
        numbers == std::vector<double>{0, 0, 0, 0, 0, 0, 1})
      return param.id;
  }
  lines += std::string(graph::name(graph::ParamTag::se3_offset)) + " " + std::to_string(free) +
           " 0 0 0 0 0 0 1\n";
  return free;
}

void write_lines(const At& at, const Draft& draft, Marginalization& result) {
  const Graph& graph = *at.problem.graph;
  Id parameter_id = -1;
  for (const Measurement& measurement : draft.measurements) {
    const bool wants = parameter(measurement.of.type).has_value();
    if (wants && parameter_id < 0) parameter_id = sensor(graph, result.lines);
    result.lines += line(graph, measurement, parameter_id);
    result.factors.add(ends_of(measurement.of));
  }
  for (const Piece& piece : draft.linear) {
    result.lines += linear_line(at, piece);
    result.factors.add(piece.vertices);
  }
}

}  // namespace

graph::GraphPattern pattern_left(const Graph& graph, const Marginalization& result) {
  return pattern_left(graph, result.vertex, result.edge, result.factors);
}

Marginalization marginalize(const At& at, const std::vector<bool>& removed, const Rule& rule,
                            const Progress& progress) {
  const bool priced = !rule.linear && rule.sparsity.topology == Topology::ec;
  Draft draft = priced ? worth_their_ec(at, removed, rule, progress)
                       : one_pass(at, removed, rule, nullptr, progress);
  std::vector<Measurement*> measurements;
  for (Measurement& m : draft.measurements) measurements.push_back(&m);
  if (!rule.linear) set_errors(at, draft.owed, measurements);
  Marginalization result{removed, std::move(draft.edge_gone), {}, {}, draft.divergence};
  write_lines(at, draft, result);
  return result;
}

}  // namespace sg::marginalize
