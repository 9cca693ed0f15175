// The registry of types: one row tells all that is known of a vertex, an edge or a parameter of
// g2o's text format. Everybody else names a type by its enumerator here, never by the text of its
// tag, and asks its row.
//
// Source: the type libraries of g2o (slam2d, slam3d, sba, sim3, sclam2d), which register these tags
// and define the estimates, tangent steps and errors; TORO for VERTEX2, EDGE2, VERTEX3, EDGE3. The
// tags of BAL are ours, after the classes of g2o's example, which have none; so are linear factors.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <initializer_list>
#include <string_view>

namespace sg::graph {

// ---- Spaces: what an estimate or a measurement is, and how a line writes it. `none` is not known,
// or has no place at all: pixels, a bearing.

// clang-format off
enum class Space : std::uint8_t {
  none, se2, se3, expmap, camera, bal_camera, euler, sim3, xy, xyz, line2d, segment2d, line3d, plane,
  intrinsics, wheels,
};
// clang-format on

// Coordinates first .. first + size - 1 of a vector; size 0: there are none.
struct Axes {
  int first = 0;
  int size = 0;
};

struct SpaceRow {
  Space space;
  int dim;           // of its tangent space
  int numbers;       // of an estimate in a line, -1 where that is not known
  int position = 0;  // how many of them, the first ones, are its place: x y or x y z
  Axes translation = {};
  Axes rotation = {};  // both in a tangent vector
  double radian = 1;   // what a rotation of one radian is there, to first order
};

// A step is added number by number where nothing else is said.
inline constexpr std::array space_rows{
    SpaceRow{Space::none, 0, -1},
    // x y theta
    SpaceRow{Space::se2, 3, 3, 2, {0, 2}, {2, 1}},
    // x y z qx qy qz qw; a step is a translation and the vector part of a quaternion, on the right
    SpaceRow{Space::se3, 6, 7, 3, {0, 3}, {3, 3}, 0.5},
    // The same numbers, camera to world; a step is (rotation, translation) in the exponential map,
    // on the left of the world-to-camera pose
    SpaceRow{Space::expmap, 6, 7, 3, {3, 3}, {0, 3}},
    // x y z qx qy qz qw fx fy cx cy baseline; a step as of se3
    SpaceRow{Space::camera, 6, 12, 3, {0, 3}, {3, 3}, 0.5},
    // x y z qx qy qz qw focal_length k1 k2; a step as of expmap, and three numbers added
    SpaceRow{Space::bal_camera, 9, 10, 3, {3, 3}, {0, 3}},
    // x y z roll pitch yaw
    SpaceRow{Space::euler, 6, 6, 3, {0, 3}, {3, 3}},
    // The logarithm of a similarity: (rotation, translation, scale)
    SpaceRow{Space::sim3, 7, 7, 0, {3, 3}, {0, 3}}, SpaceRow{Space::xy, 2, 2, 2, {0, 2}},
    SpaceRow{Space::xyz, 3, 3, 3, {0, 3}}, SpaceRow{Space::line2d, 2, 2},
    SpaceRow{Space::segment2d, 4, 4}, SpaceRow{Space::line3d, 4, 6},  // six Pluecker coordinates
    SpaceRow{Space::plane, 3, 4}, SpaceRow{Space::intrinsics, 4, -1},
    SpaceRow{Space::wheels, 3, 3},  // of a differential drive
};

constexpr const SpaceRow& facts(Space space) {
  return space_rows[static_cast<std::size_t>(space)];
}
constexpr int space_dim(Space space) {
  return facts(space).dim;
}
constexpr int space_size(Space space) {
  return facts(space).numbers;
}
// Of a step: scalars that a motion of the whole changes. They are the first ones.
constexpr int moving_dim(Space space) {
  return facts(space).translation.size + facts(space).rotation.size;
}
// Whether a line's first seven numbers are x y z qx qy qz qw.
constexpr bool has_quaternion(Space space) {
  return space == Space::se3 || space == Space::expmap || space == Space::camera ||
         space == Space::bal_camera;
}

// ---- Vertices.

enum class Role : std::uint8_t { pose, landmark, other };

// clang-format off
enum class VertexTag : std::uint8_t {
  se2, se3, expmap, cam, bal_camera, sim3, toro3, toro2, xy, trackxyz, xyz, line2d, segment2d, line3d, plane,
  intrinsics, wheels,
};
// clang-format on

struct VertexRow {
  VertexTag type;
  std::string_view tag;
  Space space;
  Role role;
};

inline constexpr std::array vertex_rows{
    VertexRow{VertexTag::se2, "VERTEX_SE2", Space::se2, Role::pose},
    VertexRow{VertexTag::se3, "VERTEX_SE3:QUAT", Space::se3, Role::pose},
    VertexRow{VertexTag::expmap, "VERTEX_SE3:EXPMAP", Space::expmap, Role::pose},
    VertexRow{VertexTag::cam, "VERTEX_CAM", Space::camera, Role::pose},
    VertexRow{VertexTag::bal_camera, "VERTEX_CAMERA_BAL", Space::bal_camera, Role::pose},
    VertexRow{VertexTag::sim3, "VERTEX_SIM3:EXPMAP", Space::sim3, Role::pose},
    VertexRow{VertexTag::toro3, "VERTEX3", Space::euler, Role::pose},
    VertexRow{VertexTag::toro2, "VERTEX2", Space::se2, Role::pose},
    VertexRow{VertexTag::xy, "VERTEX_XY", Space::xy, Role::landmark},
    VertexRow{VertexTag::trackxyz, "VERTEX_TRACKXYZ", Space::xyz, Role::landmark},
    VertexRow{VertexTag::xyz, "VERTEX_XYZ", Space::xyz, Role::landmark},
    VertexRow{VertexTag::line2d, "VERTEX_LINE2D", Space::line2d, Role::landmark},
    VertexRow{VertexTag::segment2d, "VERTEX_SEGMENT2D", Space::segment2d, Role::landmark},
    VertexRow{VertexTag::line3d, "VERTEX_LINE3D", Space::line3d, Role::landmark},
    VertexRow{VertexTag::plane, "VERTEX_PLANE", Space::plane, Role::landmark},
    VertexRow{VertexTag::intrinsics, "VERTEX_INTRINSICS", Space::intrinsics, Role::other},
    VertexRow{VertexTag::wheels, "VERTEX_ODOM_DIFFERENTIAL", Space::wheels, Role::other},
};

// ---- Parameters: lines PARAMS ID NUMBER ... that edges refer to.

enum class ParamTag : std::uint8_t {
  se2_offset,
  se3_offset,
  camera,
  stereo_camera,
  pinhole,
  unknown,  // a taught one
};

struct ParamRow {
  ParamTag type;
  std::string_view tag;
  int numbers;    // behind the id
  Space frame;    // what they start with: the sensor's pose on the robot
  ParamTag also;  // what it can stand for, too, by its first numbers; itself: nothing else
};

inline constexpr std::array param_rows{
    ParamRow{ParamTag::se2_offset, "PARAMS_SE2OFFSET", 3, Space::se2, ParamTag::se2_offset},
    ParamRow{ParamTag::se3_offset, "PARAMS_SE3OFFSET", 7, Space::se3, ParamTag::se3_offset},
    // ... fx fy cx cy
    ParamRow{ParamTag::camera, "PARAMS_CAMERACALIB", 11, Space::se3, ParamTag::se3_offset},
    // ... baseline
    ParamRow{ParamTag::stereo_camera, "PARAMS_STEREOCAMERACALIB", 12, Space::se3, ParamTag::camera},
    // focal_length cx cy baseline
    ParamRow{ParamTag::pinhole, "PARAMS_CAMERAPARAMETERS", 4, Space::none, ParamTag::pinhole},
};

// ---- Edges.

// clang-format off
enum class EdgeTag : std::uint8_t {
  se2, se2_offset, se2_xy, bearing_se2_xy, se2_pointxy_offset, se2_line2d, se2_segment2d,
  se2_segment2d_line, se2_segment2d_pointline, pointxy, line2d, line2d_pointxy, prior_se2,
  prior_se2_xy, prior_xy, se2_calib, se2_xy_calib, se2_twopointsxy, se2_lotsofxy,
  se2_odom_differential_calib, se3, se3_offset, se3_trackxyz, project_disparity, project_depth,
  se3_prior, se3_xyz_prior, pointxyz, pointxyz_prior, se3_line3d, plane, se3_plane_calib,
  se3_calib, se3_lotsof_xyz, gicp, toro3, toro2, expmap, project_xyz2uv, project_xyz2uvu,
  se3_project_xyz, stereo_se3_project_xyz, se3_project_xyz_onlypose,
  stereo_se3_project_xyz_onlypose, project_p2mc, project_p2sc, cam, scale, sim3, project_sim3_xyz,
  project_inverse_sim3_xyz, observation_bal, linear, linear_relative,
};
// clang-format on

// How the upper triangle of an information matrix stands in a line: row by row, or 11 12 22 33 13 23.
enum class Triangle : std::uint8_t { rows, toro };
// The k-th number of TORO's is this one of the rows, which are 11 12 13 22 23 33.
inline constexpr std::array<int, 6> toro_triangle{0, 1, 3, 5, 2, 4};

// What an edge measures: `numbers`, the triangle of the information of its error, and `extra` more.
struct Measure {
  int dim;           // of the error
  int numbers;       // -1 where it is not known what a line holds
  int extra = 0;     // numbers behind the information
  Space space = {};  // that the measurement is of, and the error a tangent vector of
  Triangle order = {};
};
// At most `most` items.
template <class T, int most>
struct UpTo {
  std::array<T, most> item{};
  int size = 0;

  constexpr UpTo() = default;
  constexpr UpTo(std::initializer_list<T> items) : size(static_cast<int>(items.size())) {
    std::copy(items.begin(), items.end(), item.begin());
  }
  constexpr T operator[](int k) const { return item[k]; }
};

struct EdgeRow {
  EdgeTag type;
  std::string_view tag;
  Measure measure;             // of a counted edge: for every vertex that repeats
  UpTo<VertexTag, 3> ends;     // in file order; of a counted edge: the first, and what repeats;
                               // of a linear factor none: any vertices (linear.h)
  UpTo<ParamTag, 2> params{};  // that its line refers to, between vertices and numbers
  bool counted = false;  // TAG first-id count id...: the number of vertices stands in the line
};

namespace rows {  // short names for the table

constexpr Measure of(Space space, Triangle order = Triangle::rows) {
  return {space_dim(space), space_size(space), 0, space, order};
}
constexpr Measure plain(int dim, int extra = 0) {
  return {dim, dim, extra};
}
constexpr Measure unread(int dim) {
  return {dim, -1};
}

constexpr auto SE2 = VertexTag::se2, XY = VertexTag::xy, LINE2D = VertexTag::line2d,
               SEGMENT2D = VertexTag::segment2d, WHEELS = VertexTag::wheels, SE3 = VertexTag::se3,
               TRACKXYZ = VertexTag::trackxyz, LINE3D = VertexTag::line3d, PLANE = VertexTag::plane,
               EXPMAP = VertexTag::expmap, XYZ = VertexTag::xyz, CAM = VertexTag::cam,
               CAMERA_BAL = VertexTag::bal_camera, SIM3 = VertexTag::sim3, TORO2 = VertexTag::toro2,
               TORO3 = VertexTag::toro3;
constexpr auto OFFSET2 = ParamTag::se2_offset, OFFSET3 = ParamTag::se3_offset,
               CAMERA = ParamTag::camera, PINHOLE = ParamTag::pinhole;
using enum Space;
using Tag = EdgeTag;

inline constexpr std::array edges{
    EdgeRow{Tag::se2, "EDGE_SE2", of(se2), {SE2, SE2}},
    EdgeRow{Tag::se2_offset, "EDGE_SE2_OFFSET", of(se2), {SE2, SE2}, {OFFSET2, OFFSET2}},
    EdgeRow{Tag::se2_xy, "EDGE_SE2_XY", of(xy), {SE2, XY}},
    EdgeRow{Tag::bearing_se2_xy, "EDGE_BEARING_SE2_XY", plain(1), {SE2, XY}},
    EdgeRow{Tag::se2_pointxy_offset, "EDGE_SE2_POINTXY_OFFSET", of(xy), {SE2, XY}, {OFFSET2}},
    EdgeRow{Tag::se2_line2d, "EDGE_SE2_LINE2D", of(line2d), {SE2, LINE2D}},
    EdgeRow{Tag::se2_segment2d, "EDGE_SE2_SEGMENT2D", of(segment2d), {SE2, SEGMENT2D}},
    EdgeRow{Tag::se2_segment2d_line, "EDGE_SE2_SEGMENT2D_LINE", of(line2d), {SE2, SEGMENT2D}},
    EdgeRow{
        Tag::se2_segment2d_pointline, "EDGE_SE2_SEGMENT2D_POINTLINE", unread(3), {SE2, SEGMENT2D}},
    EdgeRow{Tag::pointxy, "EDGE_POINTXY", of(xy), {XY, XY}},
    EdgeRow{Tag::line2d, "EDGE_LINE2D", of(line2d), {LINE2D, LINE2D}},
    EdgeRow{Tag::line2d_pointxy, "EDGE_LINE2D_POINTXY", plain(1), {LINE2D, XY}},
    EdgeRow{Tag::prior_se2, "EDGE_PRIOR_SE2", of(se2), {SE2}},
    EdgeRow{Tag::prior_se2_xy, "EDGE_PRIOR_SE2_XY", of(xy), {SE2}},
    EdgeRow{Tag::prior_xy, "EDGE_PRIOR_XY", of(xy), {XY}},
    EdgeRow{Tag::se2_calib, "EDGE_SE2_CALIB", of(se2), {SE2, SE2, SE2}},
    EdgeRow{Tag::se2_xy_calib, "EDGE_SE2_XY_CALIB", of(xy), {SE2, XY, SE2}},
    EdgeRow{Tag::se2_twopointsxy, "EDGE_SE2_TWOPOINTSXY", plain(4), {SE2, XY, XY}},
    EdgeRow{Tag::se2_lotsofxy, "EDGE_SE2_LOTSOFXY", of(xy), {SE2, XY}, {}, true},
    EdgeRow{Tag::se2_odom_differential_calib,
            "EDGE_SE2_ODOM_DIFFERENTIAL_CALIB",
            unread(3),
            {SE2, SE2, WHEELS}},
    EdgeRow{Tag::se3, "EDGE_SE3:QUAT", of(se3), {SE3, SE3}},
    EdgeRow{Tag::se3_offset, "EDGE_SE3_OFFSET", of(se3), {SE3, SE3}, {OFFSET3, OFFSET3}},
    EdgeRow{Tag::se3_trackxyz, "EDGE_SE3_TRACKXYZ", of(xyz), {SE3, TRACKXYZ}, {OFFSET3}},
    EdgeRow{Tag::project_disparity, "EDGE_PROJECT_DISPARITY", plain(3), {SE3, TRACKXYZ}, {CAMERA}},
    EdgeRow{Tag::project_depth, "EDGE_PROJECT_DEPTH", plain(3), {SE3, TRACKXYZ}, {CAMERA}},
    EdgeRow{Tag::se3_prior, "EDGE_SE3_PRIOR", of(se3), {SE3}, {OFFSET3}},
    EdgeRow{Tag::se3_xyz_prior, "EDGE_SE3_XYZ_PRIOR", of(xyz), {SE3}, {OFFSET3}},
    EdgeRow{Tag::pointxyz, "EDGE_POINTXYZ", of(xyz), {TRACKXYZ, TRACKXYZ}},
    EdgeRow{Tag::pointxyz_prior, "EDGE_POINTXYZ_PRIOR", of(xyz), {TRACKXYZ}},
    EdgeRow{Tag::se3_line3d, "EDGE_SE3_LINE3D", of(line3d), {SE3, LINE3D}, {OFFSET3}},
    EdgeRow{Tag::plane, "EDGE_PLANE", unread(4), {PLANE, PLANE}},
    EdgeRow{Tag::se3_plane_calib, "EDGE_SE3_PLANE_CALIB", unread(3), {SE3, PLANE, SE3}},
    EdgeRow{Tag::se3_calib, "EDGE_SE3_CALIB", of(se3), {SE3, SE3, SE3}},
    EdgeRow{Tag::se3_lotsof_xyz, "EDGE_SE3_LOTSOF_XYZ", of(xyz), {SE3, TRACKXYZ}, {}, true},
    EdgeRow{Tag::gicp, "EDGE_V_V_GICP", unread(3), {SE3, SE3}},
    EdgeRow{Tag::toro3, "EDGE3", of(euler), {TORO3, TORO3}},
    EdgeRow{Tag::toro2, "EDGE2", of(se2, Triangle::toro), {TORO2, TORO2}},
    EdgeRow{Tag::expmap, "EDGE_SE3:EXPMAP", of(expmap), {EXPMAP, EXPMAP}},
    EdgeRow{Tag::project_xyz2uv, "EDGE_PROJECT_XYZ2UV:EXPMAP", plain(2), {XYZ, EXPMAP}, {PINHOLE}},
    EdgeRow{
        Tag::project_xyz2uvu, "EDGE_PROJECT_XYZ2UVU:EXPMAP", plain(3), {XYZ, EXPMAP}, {PINHOLE}},
    EdgeRow{Tag::se3_project_xyz, "EDGE_SE3_PROJECT_XYZ:EXPMAP", plain(2, 4), {XYZ, EXPMAP}},
    EdgeRow{Tag::stereo_se3_project_xyz,
            "EDGE_STEREO_SE3_PROJECT_XYZ:EXPMAP",
            plain(3, 5),
            {XYZ, EXPMAP}},
    EdgeRow{
        Tag::se3_project_xyz_onlypose, "EDGE_SE3_PROJECT_XYZONLYPOSE:EXPMAP", unread(2), {EXPMAP}},
    EdgeRow{Tag::stereo_se3_project_xyz_onlypose,
            "EDGE_STEREO_SE3_PROJECT_XYZONLYPOSE:EXPMAP",
            unread(3),
            {EXPMAP}},
    EdgeRow{Tag::project_p2mc, "EDGE_PROJECT_P2MC", plain(2), {XYZ, CAM}},
    EdgeRow{Tag::project_p2sc, "EDGE_PROJECT_P2SC", plain(3), {XYZ, CAM}},
    EdgeRow{Tag::cam, "EDGE_CAM", of(se3), {CAM, CAM}},
    EdgeRow{Tag::scale, "EDGE_SCALE", plain(1), {CAM, CAM}},
    EdgeRow{Tag::sim3, "EDGE_SIM3:EXPMAP", unread(7), {SIM3, SIM3}},
    EdgeRow{Tag::project_sim3_xyz, "EDGE_PROJECT_SIM3_XYZ:EXPMAP", plain(2), {XYZ, SIM3}},
    EdgeRow{Tag::project_inverse_sim3_xyz,
            "EDGE_PROJECT_INVERSE_SIM3_XYZ:EXPMAP",
            plain(2),
            {XYZ, SIM3}},
    EdgeRow{Tag::observation_bal, "EDGE_OBSERVATION_BAL", plain(2), {CAMERA_BAL, XYZ}},
    EdgeRow{Tag::linear, "EDGE_LINEAR", unread(-1), {}, {}, true},
    EdgeRow{Tag::linear_relative, "EDGE_LINEAR_RELATIVE", unread(-1), {}, {}, true},
};

}  // namespace rows

inline constexpr const auto& edge_rows = rows::edges;

// ---- Other lines, and other names.

inline constexpr std::string_view fix_tag = "FIX";
inline constexpr std::array<std::string_view, 3> data_tags{"ROBOTLASER1", "VERTEX_TAG",
                                                           "VERTEX_ELLIPSE"};

// A line of an alias keeps its own text, and means what a line of the other tag means.
struct Alias {
  std::string_view tag;
  std::string_view means;
};
inline constexpr std::array aliases{Alias{"EDGE_SE3", "EDGE_SE3:QUAT"}};

// ---- Rows and tags by enumerator.

constexpr const VertexRow& row(VertexTag type) {
  return vertex_rows[static_cast<std::size_t>(type)];
}
constexpr const EdgeRow& row(EdgeTag type) {
  return edge_rows[static_cast<std::size_t>(type)];
}
constexpr const ParamRow& row(ParamTag type) {
  return param_rows[static_cast<std::size_t>(type)];
}
// Whether a line of one type of parameters can stand for another: a stereo camera is a camera, and a
// camera has an offset.
constexpr bool serves_as(ParamTag wanted, ParamTag given) {
  if (given == wanted || given == ParamTag::unknown) return given == wanted;
  return row(given).also != given && serves_as(wanted, row(given).also);
}
constexpr std::string_view name(VertexTag type) {
  return row(type).tag;
}
constexpr std::string_view name(EdgeTag type) {
  return row(type).tag;
}
constexpr std::string_view name(ParamTag type) {
  return row(type).tag;
}

// Every row stands where its enumerator says.
constexpr bool in_order(const auto& table, auto key) {
  for (std::size_t k = 0; k < table.size(); ++k) {
    if (static_cast<std::size_t>(table[k].*key) != k) return false;
  }
  return true;
}
static_assert(in_order(space_rows, &SpaceRow::space) && in_order(vertex_rows, &VertexRow::type) &&
              in_order(param_rows, &ParamRow::type) && in_order(edge_rows, &EdgeRow::type));

}  // namespace sg::graph
