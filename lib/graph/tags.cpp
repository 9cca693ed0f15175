#include "lib/graph/tags.h"

#include <array>
#include <charconv>
#include <limits>

#include "lib/text/error.h"

namespace sg {
namespace {

struct VertexRow {
  const char* tag;
  int dim;
  Role role;
  int numbers;
};

constexpr std::array vertex_rows{
    VertexRow{"VERTEX_SE2", 3, Role::pose, 3},
    VertexRow{"VERTEX_SE3:QUAT", 6, Role::pose, 7},
    VertexRow{"VERTEX_SE3:EXPMAP", 6, Role::pose, 7},
    VertexRow{"VERTEX_CAM", 6, Role::pose, 12},
    VertexRow{"VERTEX_SIM3:EXPMAP", 7, Role::pose, 7},
    VertexRow{"VERTEX3", 6, Role::pose, 6},
    VertexRow{"VERTEX2", 3, Role::pose, 3},
    VertexRow{"VERTEX_XY", 2, Role::landmark, 2},
    VertexRow{"VERTEX_TRACKXYZ", 3, Role::landmark, 3},
    VertexRow{"VERTEX_XYZ", 3, Role::landmark, 3},
    VertexRow{"VERTEX_LINE2D", 2, Role::landmark, 2},
    VertexRow{"VERTEX_SEGMENT2D", 4, Role::landmark, 4},
    VertexRow{"VERTEX_LINE3D", 4, Role::landmark, 6},
    VertexRow{"VERTEX_PLANE", 3, Role::landmark, 4},
    VertexRow{"VERTEX_INTRINSICS", 4, Role::other, -1},
    VertexRow{"VERTEX_ODOM_DIFFERENTIAL", 3, Role::other, 3},
};

// Vertex tags by the short names that the edge table uses.
constexpr const char* SE2 = "VERTEX_SE2";
constexpr const char* XY = "VERTEX_XY";
constexpr const char* LINE2D = "VERTEX_LINE2D";
constexpr const char* SEGMENT2D = "VERTEX_SEGMENT2D";
constexpr const char* ODOM = "VERTEX_ODOM_DIFFERENTIAL";
constexpr const char* SE3 = "VERTEX_SE3:QUAT";
constexpr const char* TRACKXYZ = "VERTEX_TRACKXYZ";
constexpr const char* LINE3D = "VERTEX_LINE3D";
constexpr const char* PLANE = "VERTEX_PLANE";
constexpr const char* EXPMAP = "VERTEX_SE3:EXPMAP";
constexpr const char* XYZ = "VERTEX_XYZ";
constexpr const char* CAM = "VERTEX_CAM";
constexpr const char* SIM3 = "VERTEX_SIM3:EXPMAP";
constexpr const char* TORO2 = "VERTEX2";
constexpr const char* TORO3 = "VERTEX3";

struct LineNumbers {
  int measurement;
  int all;
};

struct EdgeRow {
  const char* tag;
  int dim;
  std::array<const char*, 3> endpoints;
  int params;
  LineNumbers numbers;
  bool counted = false;
};

// The measurement, the upper triangle of its information, and what follows it.
constexpr LineNumbers with_information(int measurement, int dim, int extra = 0) {
  return {measurement, measurement + dim * (dim + 1) / 2 + extra};
}
constexpr LineNumbers unknown{-1, -1};
constexpr LineNumbers per_vertex(int numbers) {
  return {numbers, numbers};
}

constexpr std::array edge_rows{
    EdgeRow{"EDGE_SE2", 3, {SE2, SE2}, 0, with_information(3, 3)},
    EdgeRow{"EDGE_SE2_OFFSET", 3, {SE2, SE2}, 2, with_information(3, 3)},
    EdgeRow{"EDGE_SE2_XY", 2, {SE2, XY}, 0, with_information(2, 2)},
    EdgeRow{"EDGE_BEARING_SE2_XY", 1, {SE2, XY}, 0, with_information(1, 1)},
    EdgeRow{"EDGE_SE2_POINTXY_OFFSET", 2, {SE2, XY}, 1, with_information(2, 2)},
    EdgeRow{"EDGE_SE2_LINE2D", 2, {SE2, LINE2D}, 0, with_information(2, 2)},
    EdgeRow{"EDGE_SE2_SEGMENT2D", 4, {SE2, SEGMENT2D}, 0, with_information(4, 4)},
    EdgeRow{"EDGE_SE2_SEGMENT2D_LINE", 2, {SE2, SEGMENT2D}, 0, with_information(2, 2)},
    EdgeRow{"EDGE_SE2_SEGMENT2D_POINTLINE", 3, {SE2, SEGMENT2D}, 0, unknown},
    EdgeRow{"EDGE_POINTXY", 2, {XY, XY}, 0, with_information(2, 2)},
    EdgeRow{"EDGE_LINE2D", 2, {LINE2D, LINE2D}, 0, with_information(2, 2)},
    EdgeRow{"EDGE_LINE2D_POINTXY", 1, {LINE2D, XY}, 0, with_information(1, 1)},
    EdgeRow{"EDGE_PRIOR_SE2", 3, {SE2}, 0, with_information(3, 3)},
    EdgeRow{"EDGE_PRIOR_SE2_XY", 2, {SE2}, 0, with_information(2, 2)},
    EdgeRow{"EDGE_PRIOR_XY", 2, {XY}, 0, with_information(2, 2)},
    EdgeRow{"EDGE_SE2_CALIB", 3, {SE2, SE2, SE2}, 0, with_information(3, 3)},
    EdgeRow{"EDGE_SE2_XY_CALIB", 2, {SE2, XY, SE2}, 0, with_information(2, 2)},
    EdgeRow{"EDGE_SE2_TWOPOINTSXY", 4, {SE2, XY, XY}, 0, with_information(4, 4)},
    EdgeRow{"EDGE_SE2_LOTSOFXY", -1, {SE2, XY}, 0, per_vertex(2), true},
    EdgeRow{"EDGE_SE2_ODOM_DIFFERENTIAL_CALIB", 3, {SE2, SE2, ODOM}, 0, unknown},
    EdgeRow{"EDGE_SE3:QUAT", 6, {SE3, SE3}, 0, with_information(7, 6)},
    EdgeRow{"EDGE_SE3_OFFSET", 6, {SE3, SE3}, 2, with_information(7, 6)},
    EdgeRow{"EDGE_SE3_TRACKXYZ", 3, {SE3, TRACKXYZ}, 1, with_information(3, 3)},
    EdgeRow{"EDGE_PROJECT_DISPARITY", 3, {SE3, TRACKXYZ}, 1, with_information(3, 3)},
    EdgeRow{"EDGE_PROJECT_DEPTH", 3, {SE3, TRACKXYZ}, 1, with_information(3, 3)},
    EdgeRow{"EDGE_SE3_PRIOR", 6, {SE3}, 1, with_information(7, 6)},
    EdgeRow{"EDGE_SE3_XYZ_PRIOR", 3, {SE3}, 1, with_information(3, 3)},
    EdgeRow{"EDGE_POINTXYZ", 3, {TRACKXYZ, TRACKXYZ}, 0, with_information(3, 3)},
    EdgeRow{"EDGE_POINTXYZ_PRIOR", 3, {TRACKXYZ}, 0, with_information(3, 3)},
    EdgeRow{"EDGE_SE3_LINE3D", 4, {SE3, LINE3D}, 1, with_information(6, 4)},
    EdgeRow{"EDGE_PLANE", 4, {PLANE, PLANE}, 0, unknown},
    EdgeRow{"EDGE_SE3_PLANE_CALIB", 3, {SE3, PLANE, SE3}, 0, unknown},
    EdgeRow{"EDGE_SE3_CALIB", 6, {SE3, SE3, SE3}, 0, with_information(7, 6)},
    EdgeRow{"EDGE_SE3_LOTSOF_XYZ", -1, {SE3, TRACKXYZ}, 0, per_vertex(3), true},
    EdgeRow{"EDGE_V_V_GICP", 3, {SE3, SE3}, 0, unknown},
    EdgeRow{"EDGE3", 6, {TORO3, TORO3}, 0, with_information(6, 6)},
    EdgeRow{"EDGE2", 3, {TORO2, TORO2}, 0, with_information(3, 3)},
    EdgeRow{"EDGE_SE3:EXPMAP", 6, {EXPMAP, EXPMAP}, 0, with_information(7, 6)},
    EdgeRow{"EDGE_PROJECT_XYZ2UV:EXPMAP", 2, {XYZ, EXPMAP}, 1, with_information(2, 2)},
    EdgeRow{"EDGE_PROJECT_XYZ2UVU:EXPMAP", 3, {XYZ, EXPMAP}, 1, with_information(3, 3)},
    EdgeRow{"EDGE_SE3_PROJECT_XYZ:EXPMAP", 2, {XYZ, EXPMAP}, 0, with_information(2, 2, 4)},
    EdgeRow{"EDGE_STEREO_SE3_PROJECT_XYZ:EXPMAP", 3, {XYZ, EXPMAP}, 0, with_information(3, 3, 5)},
    EdgeRow{"EDGE_SE3_PROJECT_XYZONLYPOSE:EXPMAP", 2, {EXPMAP}, 0, unknown},
    EdgeRow{"EDGE_STEREO_SE3_PROJECT_XYZONLYPOSE:EXPMAP", 3, {EXPMAP}, 0, unknown},
    EdgeRow{"EDGE_PROJECT_P2MC", 2, {XYZ, CAM}, 0, with_information(2, 2)},
    EdgeRow{"EDGE_PROJECT_P2SC", 3, {XYZ, CAM}, 0, with_information(3, 3)},
    EdgeRow{"EDGE_CAM", 6, {CAM, CAM}, 0, with_information(7, 6)},
    EdgeRow{"EDGE_SCALE", 1, {CAM, CAM}, 0, with_information(1, 1)},
    EdgeRow{"EDGE_SIM3:EXPMAP", 7, {SIM3, SIM3}, 0, unknown},
    EdgeRow{"EDGE_PROJECT_SIM3_XYZ:EXPMAP", 2, {XYZ, SIM3}, 0, with_information(2, 2)},
    EdgeRow{"EDGE_PROJECT_INVERSE_SIM3_XYZ:EXPMAP", 2, {XYZ, SIM3}, 0, with_information(2, 2)},
};

constexpr std::array param_tags{"PARAMS_SE2OFFSET", "PARAMS_SE3OFFSET", "PARAMS_CAMERACALIB",
                                "PARAMS_STEREOCAMERACALIB", "PARAMS_CAMERAPARAMETERS"};
constexpr std::array data_tags{"ROBOTLASER1", "VERTEX_TAG", "VERTEX_ELLIPSE"};

void add_vertex(Tags& tags, VertexType type) {
  tags.meaning[type.tag] = {LineKind::vertex, static_cast<TypeIndex>(tags.vertices.size())};
  tags.vertices.push_back(std::move(type));
}

void add_edge(Tags& tags, EdgeType type) {
  tags.meaning[type.tag] = {LineKind::edge, static_cast<TypeIndex>(tags.edges.size())};
  tags.edges.push_back(std::move(type));
}

bool full(std::size_t types) {
  return types > std::numeric_limits<TypeIndex>::max();
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  while (true) {
    const auto at =
        text.rfind(separator);  // from the right: a tag may hold colons, the rest may not
    if (at == text.npos || parts.size() == 2) break;
    parts.insert(parts.begin(), text.substr(at + 1));
    text = text.substr(0, at);
  }
  parts.insert(parts.begin(), text);
  return parts;
}

// A whole number of 1 or more, 0 for anything else.
int positive(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size() && value > 0 ? value : 0;
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

TypeIndex Tags::vertex_type(std::string_view tag) const {
  const TagMeaning* found = find(tag);
  if (!found || found->kind != LineKind::vertex) throw std::out_of_range(std::string(tag));
  return found->type;
}

Tags builtin_tags() {
  Tags tags;
  for (const VertexRow& row : vertex_rows) {
    add_vertex(tags, {row.tag, row.dim, row.role, row.numbers});
  }
  for (const EdgeRow& row : edge_rows) {
    std::vector<std::string> endpoints;
    for (const char* endpoint : row.endpoints) {
      if (endpoint) endpoints.emplace_back(endpoint);
    }
    add_edge(tags, {row.tag, row.dim, std::move(endpoints), row.counted, row.params,
                    row.numbers.all, row.numbers.measurement});
  }
  for (const char* tag : param_tags) tags.meaning[tag] = {LineKind::param, 0};
  for (const char* tag : data_tags) tags.meaning[tag] = {LineKind::data, 0};
  tags.meaning["FIX"] = {LineKind::fix, 0};
  return tags;
}

void teach_vertex(Tags& tags, std::string_view spec) {
  const auto parts = split(spec, ':');
  for (Role role : {Role::pose, Role::landmark, Role::other}) {
    if (parts.size() != 3 || parts[0].empty() || parts[2] != name(role)) continue;
    if (const int dim = positive(parts[1]); dim > 0 && !full(tags.vertices.size())) {
      return add_vertex(tags, {std::string(parts[0]), dim, role, -1});
    }
  }
  throw usage_error("--vertex wants TAG:DIM:ROLE with ROLE pose, landmark or other, not '" +
                    std::string(spec) + "'");
}

void teach_edge(Tags& tags, std::string_view spec) {
  const auto at = spec.rfind(':');
  const int arity = at == spec.npos || at == 0 ? 0 : positive(spec.substr(at + 1));
  if (arity == 0 || full(tags.edges.size())) {
    throw usage_error("--edge wants TAG:ARITY, as in EDGE_MINE:2, not '" + std::string(spec) + "'");
  }
  add_edge(tags, {std::string(spec.substr(0, at)), -1, std::vector<std::string>(arity), false, 0,
                  -1, -1});
}

}  // namespace sg
