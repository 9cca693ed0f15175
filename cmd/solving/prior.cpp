#include "cmd/solving/prior.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cmd/common/ranges.h"
#include "lib/factor/space.h"
#include "lib/text/line.h"
#include "lib/text/words.h"

namespace sg::solving {
namespace {

struct Prior {
  const std::string& text;  // as it was given
  Index vertex = 0;
  std::vector<double> numbers, sigmas;
};

text::Error wrong(const std::string& prior, const std::string& cause) {
  return text::usage_error("--prior " + prior + ": " + cause);
}

// "0.1,0.2": numbers; nothing of nothing.
std::vector<double> numbers_of(const std::string& prior, std::string_view list) {
  std::vector<double> numbers;
  while (!list.empty()) {
    const auto comma = std::min(list.find(','), list.size());
    const auto number = text::parse<double>(list.substr(0, comma));
    if (!number || !std::isfinite(*number) || comma + 1 == list.size())
      throw wrong(prior, text::quoted(list) + " is no list of numbers");
    numbers.push_back(*number);
    list.remove_prefix(std::min(comma + 1, list.size()));
  }
  return numbers;
}

Prior parse(const Graph& graph, const std::string& text) {
  const auto first = text.find(':'), second = text.find(':', first + 1);
  const auto id = text::parse<Id>(std::string_view(text).substr(0, first));
  if (first == text.npos || second == text.npos || !id)
    throw wrong(text, "it is ID:NUMBERS:SIGMAS that is wanted");
  const std::string_view rest(text);
  Prior prior{text, cmd::vertex_of(graph, "--prior", *id),
              numbers_of(text, rest.substr(first + 1, second - first - 1)),
              numbers_of(text, rest.substr(second + 1))};
  if (!prior.numbers.empty()) return prior;
  if (graph.edges_only) throw wrong(text, "the file has no VERTEX line to take the numbers from");
  graph::vertex_numbers(graph, prior.vertex, prior.numbers);
  prior.numbers.resize(graph::space_size(graph.type_of_vertex(prior.vertex).space));
  return prior;
}

// The edge that says as much as these numbers do.
graph::EdgeTag edge_of(const Graph& graph, const Prior& prior) {
  using enum graph::EdgeTag;
  const graph::VertexTag type = graph.vertex_tag(prior.vertex);
  for (const graph::EdgeTag tag :
       {prior_se2, prior_se2_xy, prior_xy, se3_prior, se3_xyz_prior, pointxyz_prior}) {
    const graph::EdgeRow& row = graph::row(tag);
    if (row.ends[0] == type && row.measure.numbers == static_cast<int>(prior.numbers.size()))
      return tag;
  }
  throw wrong(prior.text, "there is no prior of " + std::to_string(prior.numbers.size()) +
                              " numbers of a " + graph.type_of_vertex(prior.vertex).tag);
}

// The upper triangle of the information, row by row.
void append_information(const Graph& graph, const Prior& prior, int dim, std::string& line) {
  if (prior.sigmas.size() != 1 && prior.sigmas.size() != static_cast<std::size_t>(dim))
    throw wrong(prior.text, "it wants one standard deviation, or " + std::to_string(dim));
  const graph::Space space = graph.type_of_vertex(prior.vertex).space;
  for (int i = 0; i < dim; ++i) {
    double sigma = prior.sigmas.size() == 1 ? prior.sigmas[0] : prior.sigmas[i];
    if (!(sigma > 0)) throw wrong(prior.text, "a standard deviation is above 0");
    // The error of a rotation in space is a quaternion's vector part: half an angle.
    if (space == graph::Space::se3 && factor::is_turn(space, i)) sigma /= 2;
    for (int k = i; k < dim; ++k) text::append_number(line, k == i ? 1 / (sigma * sigma) : 0.0);
  }
}

// An identity of an offset's type, whose id no other parameter has.
std::string offset_line(graph::ParamTag type, Id id) {
  return std::string(graph::name(type)) + ' ' + std::to_string(id) + " 0 0 0 0 0 0 1\n";
}

}  // namespace

Graph with_priors(const Graph& graph, std::span<const std::string> priors,
                  const formats::ReadOptions& options) {
  std::string text(graph.text.view);
  if (!text.ends_with('\n')) text += '\n';
  Id offset = 0;
  for (const graph::Param& param : graph.params) offset = std::max(offset, param.id + 1);
  bool has_offset = false;
  for (const std::string& given : priors) {
    const Prior prior = parse(graph, given);
    const graph::EdgeRow& row = graph::row(edge_of(graph, prior));
    std::string line(row.tag);
    text::append_word(line, std::to_string(graph.id[prior.vertex]));
    if (row.params.size > 0) {
      if (!std::exchange(has_offset, true)) text += offset_line(row.params.item[0], offset);
      text::append_word(line, std::to_string(offset));
    }
    text::append_numbers(line, prior.numbers);
    append_information(graph, prior, row.measure.dim, line);
    text += line + '\n';
  }
  formats::ReadOptions again = options;
  again.format = "g2o";  // which the text of every format has become
  again.warning = {};    // has been told
  return formats::read_graph_text(text::text_of(std::move(text)), graph.file, again);
}

void leave_out_priors(const Graph& graph, Offset own, formats::Changes& changes) {
  for (Index e = graph.edges() - 1; e >= 0 && graph.edge_line[e] >= own; --e)
    changes.drop_edge[e] = true;
  for (const graph::Param& param : graph.params) {
    if (param.line < own) continue;
    const auto [begin, end] = formats::line_extent(graph, param.line);
    changes.edits.push_back({begin, end, ""});
  }
}

}  // namespace sg::solving
