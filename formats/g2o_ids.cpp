// The ids of a g2o text's lines become numbers of vertices.
#include <algorithm>
#include <numeric>

#include "formats/g2o_parser.h"

namespace sg::formats {
namespace {

template <class T>
void permute(std::vector<T>& values, const std::vector<Index>& order) {
  std::vector<T> sorted(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) sorted[k] = values[order[k]];
  values = std::move(sorted);
}

// Numbers vertices by ascending id; of several with one id the first in the file stays.
void sort_vertices(Parser& parser) {
  Graph& graph = parser.graph;
  if (std::adjacent_find(graph.id.begin(), graph.id.end(), std::greater_equal<>()) ==
      graph.id.end())
    return;
  std::vector<Index> order(graph.id.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return graph.id[a] < graph.id[b]; });
  std::vector<Index> kept;
  kept.reserve(order.size());
  std::vector<Index> duplicates;
  for (Index v : order) {
    (kept.empty() || graph.id[v] != graph.id[kept.back()] ? kept : duplicates).push_back(v);
  }
  std::sort(duplicates.begin(), duplicates.end());
  for (Index v : duplicates) {
    parser.complain(graph.vertex_line[v],
                    "vertex " + std::to_string(graph.id[v]) + " is defined a second time");
  }
  permute(graph.id, kept);
  permute(graph.vertex_type, kept);
  permute(graph.vertex_line, kept);
}

// Where lines were left out: leaves out what hung on them alone, vertices that are no poses and that no
// edge joins any more.
void leave_out_bare_vertices(Parser& parser) {
  Graph& graph = parser.graph;
  std::ranges::sort(parser.left_out);
  if (graph.left_out.empty()) return;
  std::vector<Id> joined;
  for (std::size_t k = 0; k < parser.edge_ids.small.size(); ++k)
    joined.push_back(parser.edge_ids[k]);
  std::ranges::sort(joined);
  std::vector<Index> kept;
  for (Index v = 0; v < graph.vertices(); ++v) {
    const bool pose = graph.role(v) == graph::Role::pose;
    if (pose || std::ranges::binary_search(joined, graph.id[v])) {
      kept.push_back(v);
    } else {
      graph.left_out.push_back(graph.vertex_line[v]);
      parser.left_out.push_back(graph.id[v]);
    }
  }
  std::ranges::sort(parser.left_out);
  permute(graph.id, kept);
  permute(graph.vertex_type, kept);
  permute(graph.vertex_line, kept);
}

// The vertex of an id: by table where ids are dense, by bisection where they are not.
class VertexLookup {
 public:
  explicit VertexLookup(const std::vector<Id>& ids) : ids_(ids) {
    if (ids.empty()) return;
    const auto range =
        static_cast<std::uint64_t>(ids.back()) - static_cast<std::uint64_t>(ids.front());
    identity_ = range + 1 == ids.size();
    if (identity_ || range > 2 * ids.size() + 1024) return;
    table_.assign(range + 1, -1);
    for (std::size_t v = 0; v < ids.size(); ++v)
      table_[ids[v] - ids.front()] = static_cast<Index>(v);
  }
  Index operator[](Id id) const {
    if (ids_.empty() || id < ids_.front() || id > ids_.back()) return -1;
    if (identity_) return static_cast<Index>(id - ids_.front());
    if (!table_.empty()) return table_[id - ids_.front()];
    const auto it = std::lower_bound(ids_.begin(), ids_.end(), id);
    return *it == id ? static_cast<Index>(it - ids_.begin()) : -1;
  }

 private:
  const std::vector<Id>& ids_;
  std::vector<Index> table_;
  bool identity_ = false;
};

// In a file without VERTEX lines the edges say what their vertices are.
void imply_vertices(Parser& parser) {
  Graph& graph = parser.graph;
  struct Mention {
    Id id;
    graph::TypeIndex type;
    Index edge;
  };
  std::vector<Mention> mentions;
  mentions.reserve(parser.edge_ids.small.size());
  for (Index e = 0; e < graph.edges(); ++e) {
    const graph::EdgeType& type = graph.type_of_edge(e);
    if (type.ends.size == 0) {
      throw graph::error_at(
          graph, graph.edge_line[e],
          type.tag + " does not say what its vertices are, and the file has no VERTEX lines");
    }
    const Index begin = graph.edge_vertices.begin[e];
    for (Index k = begin; k < graph.edge_vertices.begin[e + 1]; ++k) {
      const graph::VertexTag end = graph::wanted_end(type, k - begin);
      mentions.push_back({parser.edge_ids[k], static_cast<graph::TypeIndex>(end), e});
    }
  }
  std::stable_sort(mentions.begin(), mentions.end(),
                   [](const Mention& a, const Mention& b) { return a.id < b.id; });
  for (const Mention& mention : mentions) {
    if (graph.id.empty() || graph.id.back() != mention.id) {
      graph.id.push_back(mention.id);
      graph.vertex_type.push_back(mention.type);
    } else if (graph.vertex_type.back() != mention.type) {
      parser.complain(graph.edge_line[mention.edge],
                      "vertex " + std::to_string(mention.id) + " is " +
                          graph.tags.vertices[mention.type].tag + " here and " +
                          graph.tags.vertices[graph.vertex_type.back()].tag + " in another edge");
    }
  }
  graph.vertex_line.assign(graph.id.size(), graph::implied);
  graph.edges_only = !graph.id.empty();
}

// Turns edge ids into vertex numbers, in place; edges to undefined vertices are complained of and
// dropped.
void resolve_edges(Parser& parser, const VertexLookup& lookup) {
  Graph& graph = parser.graph;
  std::vector<Index>& vertices = parser.edge_ids.small;
  Index kept_edges = 0;
  Index kept_ids = 0;
  Index begin = 0;
  for (Index e = 0; e < graph.edges(); ++e) {
    const Index end = graph.edge_vertices.begin[e + 1];
    bool whole = true;
    bool left_out = false;
    for (Index k = begin; k < end; ++k) {
      const Id id = parser.edge_ids[k];
      const Index v = lookup[id];
      if (v < 0) {
        whole = false;
        if (std::ranges::binary_search(parser.left_out, id)) {
          left_out = true;
          continue;
        }
        parser.complain(graph.edge_line[e], graph.type_of_edge(e).tag + " joins vertex " +
                                                std::to_string(id) +
                                                ", which the file does not define");
      }
      vertices[kept_ids + (k - begin)] = v;
    }
    if (left_out) graph.left_out.push_back(graph.edge_line[e]);
    if (whole) {
      kept_ids += end - begin;
      graph.edge_type[kept_edges] = graph.edge_type[e];
      graph.edge_line[kept_edges] = graph.edge_line[e];
      graph.edge_vertices.begin[++kept_edges] = kept_ids;
    }
    begin = end;
  }
  vertices.resize(kept_ids);
  graph.edge_type.resize(kept_edges);
  graph.edge_line.resize(kept_edges);
  graph.edge_vertices.begin.resize(kept_edges + 1);
  graph.edge_vertices.items = std::move(vertices);
}

void resolve_fixes(Parser& parser, const VertexLookup& lookup) {
  Graph& graph = parser.graph;
  graph.fixed.assign(graph.id.size(), false);
  for (const Fix& fix : parser.fixes) {
    if (const Index v = lookup[fix.id]; v >= 0) {
      graph.fixed[v] = true;
    } else if (!std::ranges::binary_search(parser.left_out, fix.id)) {
      parser.complain(fix.line, "FIX names vertex " + std::to_string(fix.id) +
                                    ", which the file does not define");
    }
  }
}

}  // namespace

void resolve_ids(Parser& parser) {
  if (parser.graph.id.empty()) {
    imply_vertices(parser);
  } else {
    sort_vertices(parser);
    leave_out_bare_vertices(parser);
  }
  const VertexLookup lookup(parser.graph.id);
  resolve_edges(parser, lookup);
  resolve_fixes(parser, lookup);
  std::ranges::sort(parser.graph.left_out);
}

}  // namespace sg::formats
