// The tag registry: what every line tag of g2o's text format means for the structure of a graph.
// Source: g2o's own type libraries; the facts (dimension, role, arity, parameters) are tabulated in
// tags.cpp.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace sg {

enum class Role : std::uint8_t { pose, landmark, other };
std::string_view name(Role role);

struct VertexType {
  std::string tag;
  int dim;  // tangent-space dimension
  Role role;
  int numbers;  // numbers after the id that the format asks for, -1 where it is not known
};

struct EdgeType {
  std::string tag;
  int dim;                             // of the measurement; -1 where it depends on the line
  std::vector<std::string> endpoints;  // vertex tags in file order, "" where not known; of a
                                       // counted edge: the first vertex and the one that repeats
  bool counted;  // TAG first-id count id...: the number of vertices stands in the line
  int params;    // parameter ids between the vertex ids and the measurement
  int numbers;   // numbers after those, -1 where it is not known (per repeated vertex if counted)
  int measurement;  // how many of them are the measurement; its information follows; -1 as above
};

// Index into Tags::vertices or Tags::edges.
using TypeIndex = std::uint8_t;

enum class LineKind : std::uint8_t { vertex, edge, param, data, fix };
struct TagMeaning {
  LineKind kind;
  TypeIndex type;  // for vertices and edges
};

struct Tags {
  std::vector<VertexType> vertices;
  std::vector<EdgeType> edges;
  std::unordered_map<std::string, TagMeaning> meaning;  // of every known tag

  const TagMeaning* find(std::string_view tag) const;
  // Of a known vertex tag; throws std::out_of_range otherwise.
  TypeIndex vertex_type(std::string_view tag) const;
};

// Every tag that g2o's own libraries register.
Tags builtin_tags();

// `--vertex TAG:DIM:ROLE` and `--edge TAG:ARITY`. Throw a usage Error for text of another form.
void teach_vertex(Tags& tags, std::string_view spec);
void teach_edge(Tags& tags, std::string_view spec);

}  // namespace sg
