#include "formats/merge.h"

#include <algorithm>
#include <limits>
#include <unordered_map>

#include "formats/reorder.h"
#include "lib/text/words.h"

namespace sg::formats {
namespace {

constexpr Id largest_id = std::numeric_limits<Id>::max();

bool is_shared(const MergeOptions& options, Id id) {
  return std::ranges::any_of(
      options.shared, [id](const auto& range) { return range.first <= id && id <= range.second; });
}

// Of the ids that are not shared (all ids of the graph, if so asked); -1 without one.
Id largest(const Graph& graph, const MergeOptions& options, bool shared) {
  for (auto id = graph.id.rbegin(); id != graph.id.rend(); ++id) {
    if (shared || !is_shared(options, *id)) return *id;
  }
  return -1;
}

text::Error too_large(const Graph& graph) {
  return text::input_error(graph.file, 0,
                           "its ids would pass 2^63 - 1 (--ids keep leaves them as they are)");
}

// Its largest id that is not shared, moved by `offset`; -1 without one.
Id moved(const Graph& graph, const MergeOptions& options, Id offset) {
  const Id id = largest(graph, options, false);
  Id sum = -1;
  if (id >= 0 && __builtin_add_overflow(id, offset, &sum)) throw too_large(graph);
  return sum;
}

// 1, 2, ... times a power of ten above all ids.
std::vector<Id> prefixes(std::span<const Graph> graphs, const MergeOptions& options) {
  std::vector<Id> offset;
  Id most = 0, power = 1;
  for (const Graph& graph : graphs) most = std::max(most, largest(graph, options, true));
  while (power <= most) {
    if (__builtin_mul_overflow(power, Id{10}, &power)) throw too_large(graphs.front());
  }
  for (const Graph& graph : graphs) {
    Id add = 0;
    if (__builtin_mul_overflow(power, static_cast<Id>(offset.size() + 1), &add))
      throw too_large(graph);
    moved(graph, options, add);
    offset.push_back(add);
  }
  return offset;
}

// What is added to the ids of every graph that are not shared.
std::vector<Id> offsets(std::span<const Graph> graphs, const MergeOptions& options) {
  std::vector<Id> offset(graphs.size(), 0);
  if (options.ids == MergedIds::keep) return offset;
  if (options.ids == MergedIds::prefix) return prefixes(graphs, options);
  // Behind the ids before, and behind all that are shared.
  Id last = largest(graphs.front(), options, true);
  for (const Graph& graph : graphs) {
    for (const Id id : graph.id) {
      if (id > last && is_shared(options, id)) last = id;
    }
  }
  for (std::size_t k = 1; k < graphs.size(); ++k) {
    if (largest(graphs[k], options, false) < 0) continue;
    if (last == largest_id) throw too_large(graphs[k]);
    offset[k] = last + 1;
    last = moved(graphs[k], options, offset[k]);
  }
  return offset;
}

struct Owner {
  std::size_t graph;
  Index v;
};
using Owners = std::unordered_map<Id, Owner>;  // of ids that more than one graph may have

[[noreturn]] void refuse(const Graph& graph, Index v, const Graph& other,
                         const std::string& cause) {
  throw graph::error_at(
      graph, graph.vertex_line[v],
      "vertex " + std::to_string(graph.id[v]) + " is in " + other.file + ", too" + cause);
}

// The lines of vertices that an earlier graph has.
void drop_shared(std::span<const Graph> graphs, std::size_t k, const MergeOptions& options,
                 Owners& owners, Changes& changes) {
  const Graph& graph = graphs[k];
  for (Index v = 0; v < graph.vertices(); ++v) {
    const bool shared = is_shared(options, graph.id[v]);
    if (!shared && options.ids != MergedIds::keep) continue;
    const auto [owner, first] = owners.try_emplace(graph.id[v], Owner{k, v});
    if (first) continue;
    const Graph& other = graphs[owner->second.graph];
    if (!shared) refuse(graph, v, other, " (--shared makes them one)");
    if (other.vertex_type[owner->second.v] != graph.vertex_type[v])
      refuse(graph, v, other, ", as " + other.type_of_vertex(owner->second.v).tag);
    if (graph.edges_only) continue;
    const auto [begin, end] = vertex_extent(graph, v);
    changes.edits.push_back({begin, end, ""});
  }
}

struct MergedParam {
  std::string_view tag;
  std::vector<double> numbers;
};
using Params = std::map<Id, MergedParam>;

MergedParam param_of(const Graph& graph, const graph::Param& param) {
  MergedParam result;
  auto line = graph::line_at(graph, param.line);
  result.tag = text::next_word(line);
  graph::param_numbers(graph, param, result.numbers);
  return result;
}

// Gives the parameters of one graph their ids beside those before, and drops what is there already. Of two lines with one
// id the first holds, as everywhere.
void add_params(const Graph& graph, Params& params, NewIds& ids) {
  Params own;
  for (const graph::Param& param : graph.params) own.try_emplace(param.id, param_of(graph, param));
  const auto last = [](const Params& of) { return of.empty() ? Id{-1} : of.rbegin()->first; };
  Id next = std::max(last(params), last(own));
  Params added;
  for (auto& [id, param] : own) {
    const auto same = std::ranges::find_if(params, [&](const auto& other) {
      return other.second.tag == param.tag && other.second.numbers == param.numbers;
    });
    if (same != params.end()) {
      ids.params[id] = same->first;
      ids.dropped_params.insert(id);
    } else {
      const Id free = params.contains(id) ? ++next : id;
      ids.params[id] = free;
      added.emplace(free, std::move(param));
    }
  }
  params.merge(added);
}

}  // namespace

std::vector<Changes> merged(std::span<const Graph> graphs, const MergeOptions& options,
                            std::string_view who) {
  std::vector<Changes> result;
  const std::vector<Id> offset = offsets(graphs, options);
  Owners owners;
  Params params;
  for (std::size_t k = 0; k < graphs.size(); ++k) {
    const Graph& graph = graphs[k];
    if (graph.edges_only != graphs[0].edges_only)
      throw text::input_error((graph.edges_only ? graph : graphs[0]).file, 0,
                              "has no VERTEX lines, but " +
                                  (graph.edges_only ? graphs[0] : graph).file +
                                  " has (sg-convert --estimates adds them)");
    NewIds ids = same_ids(graph);
    for (Id& id : ids.vertex) id += is_shared(options, id) ? 0 : offset[k];
    add_params(graph, params, ids);
    Changes changes = renumbered(graph, std::move(ids));
    drop_shared(graphs, k, options, owners, changes);
    if (graphs.size() > 1) mark_stale_orders(graph, who, changes);
    result.push_back(std::move(changes));
  }
  return result;
}

void write_merged(std::span<const Graph> graphs, std::vector<Changes> changes,
                  std::string_view comment, Sink& sink) {
  for (std::size_t k = 0; k < graphs.size(); ++k) {
    if (k > 0 && !graphs[k - 1].text.view.ends_with('\n')) sink.write("\n");
    write_changed(graphs[k], std::move(changes[k]), k == 0 ? comment : "", sink);
  }
}

}  // namespace sg::formats
