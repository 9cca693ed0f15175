#include "lib/graph/tags.h"

#include <algorithm>
#include <array>
#include <limits>

#include "lib/text/error.h"
#include "lib/text/words.h"

namespace sg::graph {
namespace {

VertexType vertex_type(const VertexRow& row) {
  const SpaceRow& space = facts(row.space);
  return {std::string(row.tag), space.dim, row.role, space.numbers, row.space};
}

EdgeType edge_type(const EdgeRow& row) {
  const Measure& z = row.measure;
  EdgeType type{std::string(row.tag), z.dim, row.ends.size, row.ends, row.params, row.counted};
  type.measurement = z.numbers;
  type.space = z.space;
  type.order = z.order;
  if (row.counted) {
    type.dim = -1;
    type.numbers = z.numbers;
  } else if (z.numbers >= 0) {
    type.numbers = z.numbers + z.dim * (z.dim + 1) / 2 + z.extra;
  }
  return type;
}

template <class Type>
void add(Tags& tags, std::vector<Type>& types, LineKind kind, Type type) {
  if (types.size() > std::numeric_limits<TypeIndex>::max()) {
    throw text::usage_error("no more than 256 types of vertices and of edges can be told apart");
  }
  tags.meaning[type.tag] = {kind, static_cast<TypeIndex>(types.size())};
  types.push_back(std::move(type));
}

// A whole number of 1 or more, 0 for anything else.
int positive(std::string_view text) {
  return std::max(0, text::parse<int>(text).value_or(0));
}

// Cuts what follows the last colon off: a tag may hold colons, the rest may not. Empty without one.
std::string_view take_last(std::string_view& text) {
  const auto at = text.rfind(':');
  if (at == text.npos) return {};
  const auto last = text.substr(at + 1);
  text = text.substr(0, at);
  return last;
}

std::string described(const Tags& tags, const TagMeaning& meaning) {
  switch (meaning.kind) {
    case LineKind::vertex: {
      const VertexType& type = tags.vertices[meaning.type];
      return "a vertex of dimension " + std::to_string(type.dim) + " and role " +
             std::string(name(type.role));
    }
    case LineKind::edge: {
      const EdgeType& type = tags.edges[meaning.type];
      if (type.counted) return "an edge that counts its vertices";
      return "an edge of " + std::to_string(type.arity) +
             (type.arity == 1 ? " vertex" : " vertices");
    }
    case LineKind::param:
      return "a parameter";
    case LineKind::data:
      return "sensor data";
    case LineKind::fix:
      break;
  }
  return "the tag of constants";
}

// Whether the tag is known and means the same; throws if it means something else.
bool known(const Tags& tags, std::string_view tag, const std::string& call, const auto& same) {
  const TagMeaning* meaning = tags.find(tag);
  if (!meaning) return false;
  if (same(*meaning)) return true;
  throw text::usage_error(call + ": " + std::string(tag) + " is known already, as " +
                          described(tags, *meaning));
}

}  // namespace

std::string_view name(Role role) {
  constexpr std::array<std::string_view, 3> names{"pose", "landmark", "other"};
  return names[static_cast<std::size_t>(role)];
}

const TagMeaning* Tags::find(std::string_view tag) const {
  const auto it = meaning.find(std::string(tag));
  return it == meaning.end() ? nullptr : &it->second;
}

Tags builtin_tags() {
  Tags tags;
  for (const VertexRow& row : vertex_rows) {
    add(tags, tags.vertices, LineKind::vertex, vertex_type(row));
  }
  for (const EdgeRow& row : edge_rows) add(tags, tags.edges, LineKind::edge, edge_type(row));
  for (const ParamRow& row : param_rows) {
    tags.meaning[std::string(row.tag)] = {LineKind::param, static_cast<TypeIndex>(row.type)};
  }
  for (const auto tag : data_tags) tags.meaning[std::string(tag)] = {LineKind::data, 0};
  tags.meaning[std::string(fix_tag)] = {LineKind::fix, 0};
  for (const Alias& alias : aliases) {
    tags.meaning[std::string(alias.tag)] = *tags.find(alias.means);
  }
  return tags;
}

void teach_vertex(Tags& tags, std::string_view spec) {
  auto tag = spec;
  const auto role_name = take_last(tag);
  const int dim = positive(take_last(tag));
  for (Role role : {Role::pose, Role::landmark, Role::other}) {
    if (tag.empty() || dim == 0 || role_name != name(role)) continue;
    const auto same = [&](const TagMeaning& meaning) {
      return meaning.kind == LineKind::vertex && tags.vertices[meaning.type].dim == dim &&
             tags.vertices[meaning.type].role == role;
    };
    if (known(tags, tag, "--vertex " + std::string(spec), same)) return;
    return add(tags, tags.vertices, LineKind::vertex, {std::string(tag), dim, role});
  }
  throw text::usage_error("--vertex wants TAG:DIM:ROLE with ROLE pose, landmark or other, not '" +
                          std::string(spec) + "'");
}

void teach_edge(Tags& tags, std::string_view spec) {
  auto tag = spec;
  const int arity = positive(take_last(tag));
  if (arity == 0 || tag.empty()) {
    throw text::usage_error("--edge wants TAG:ARITY, as in EDGE_MINE:2, not '" + std::string(spec) +
                            "'");
  }
  const auto same = [&](const TagMeaning& meaning) {
    return meaning.kind == LineKind::edge && tags.edges[meaning.type].arity == arity &&
           !tags.edges[meaning.type].counted;
  };
  if (known(tags, tag, "--edge " + std::string(spec), same)) return;
  add(tags, tags.edges, LineKind::edge, {std::string(tag), -1, arity});
}

void teach_params(Tags& tags, std::string_view tag) {
  if (tag.empty()) throw text::usage_error("--params wants a TAG");
  const auto same = [](const TagMeaning& meaning) { return meaning.kind == LineKind::param; };
  if (known(tags, tag, "--params " + std::string(tag), same)) return;
  tags.meaning[std::string(tag)] = {LineKind::param, static_cast<TypeIndex>(ParamTag::unknown)};
}

void teach_alias(Tags& tags, std::string_view spec) {
  const auto at = spec.find('=');
  const auto tag = spec.substr(0, at);
  const auto means = at == spec.npos ? "" : spec.substr(at + 1);
  const std::string call = "--alias " + std::string(spec);
  if (tag.empty() || means.empty())
    throw text::usage_error("--alias wants TAG=TAG, a new one and one that is known, not '" +
                            std::string(spec) + "'");
  const TagMeaning* meaning = tags.find(means);
  if (!meaning) throw text::usage_error(call + ": nobody knows " + std::string(means));
  const auto same = [&](const TagMeaning& other) {
    return other.kind == meaning->kind && other.type == meaning->type;
  };
  if (known(tags, tag, call, same)) return;
  const TagMeaning copy = *meaning;
  tags.meaning[std::string(tag)] = copy;
}

}  // namespace sg::graph
