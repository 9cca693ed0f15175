// What the tags of one graph's lines mean: those of the registry (types.h), and those that the user
// teaches.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "lib/graph/types.h"

namespace sg::graph {

std::string_view name(Role role);

struct VertexType {
  std::string tag;
  int dim;  // tangent-space dimension
  Role role;
  int numbers = -1;  // numbers after the id that the format asks for, -1 where it is not known
  Space space = Space::none;
};

struct EdgeType {
  std::string tag;
  int dim = -1;   // of the error; -1 where it depends on the line
  int arity = 0;  // vertices of a line; of a counted edge 2: the first, and what repeats
  UpTo<VertexTag, 3> ends{};   // their types in file order; none where they are not known
  UpTo<ParamTag, 2> params{};  // ids between the vertex ids and the measurement
  bool counted = false;  // TAG first-id count id...: the number of vertices stands in the line
  int numbers = -1;      // numbers after those, -1 where not known (per repeated vertex if counted)
  int measurement = -1;  // how many of them are the measurement; its information follows
  Space space = Space::none;
  Triangle order = Triangle::rows;
};

// What the type wants as its k-th vertex; one that has ends.
inline VertexTag wanted_end(const EdgeType& type, int k) {
  return type.ends[std::min(k, type.ends.size - 1)];
}

// Index into Tags::vertices or Tags::edges: of a type of the registry its enumerator, of a taught
// one a larger number. Of a parameter its enumerator.
using TypeIndex = std::uint8_t;

enum class LineKind : std::uint8_t { vertex, edge, param, data, fix };
struct TagMeaning {
  LineKind kind;
  TypeIndex type;  // of vertices, edges and parameters
};

struct Tags {
  std::vector<VertexType> vertices;
  std::vector<EdgeType> edges;
  std::unordered_map<std::string, TagMeaning> meaning;  // of every known tag, aliases too

  const TagMeaning* find(std::string_view tag) const;
};

// The registry's.
Tags builtin_tags();

// `--vertex TAG:DIM:ROLE`, `--edge TAG:ARITY` and `--params TAG` add a type. To say again what is
// known of a tag changes nothing: there, too, the registry's row holds. Throw a usage Error for
// text of another form, and for a tag that means something else.
void teach_vertex(Tags& tags, std::string_view spec);
void teach_edge(Tags& tags, std::string_view spec);
void teach_params(Tags& tags, std::string_view tag);
// `--alias TAG=TAG`: lines of the first tag mean what lines of the second mean.
void teach_alias(Tags& tags, std::string_view spec);

}  // namespace sg::graph
