// The policies against their definitions, on random graphs written as text; keyframing against a
// least-squares solution of the odometry that it composes.
#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <map>
#include <numbers>
#include <set>
#include <sstream>

#include "formats/formats.h"
#include "formats/write.h"
#include "lib/elim/score.h"
#include "lib/graph/components.h"
#include "lib/graph/pattern.h"
#include "lib/order/order.h"
#include "lib/prune/candidates.h"
#include "lib/prune/covisible.h"
#include "lib/prune/decimate.h"
#include "lib/prune/keyframes.h"
#include "lib/prune/sample.h"
#include "lib/text/words.h"
#include "tests/unit/common.h"

using namespace sg;
using namespace sg::test;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

enum class Kind { se2, quat, expmap };
constexpr std::array kinds{Kind::se2, Kind::quat, Kind::expmap};

std::string vertex_tag(Kind kind) {
  return kind == Kind::se2    ? "VERTEX_SE2"
         : kind == Kind::quat ? "VERTEX_SE3:QUAT"
                              : "VERTEX_SE3:EXPMAP";
}
std::string edge_tag(Kind kind) {
  return kind == Kind::se2 ? "EDGE_SE2" : kind == Kind::quat ? "EDGE_SE3:QUAT" : "EDGE_SE3:EXPMAP";
}
int dof(Kind kind) {
  return kind == Kind::se2 ? 3 : 6;
}

// Everything below lives in SE(3); the plane is the part of it with these coordinates.
VectorXd coordinates(Kind kind, const SE3& x) {
  if (kind == Kind::se2) return Eigen::Vector3d(x.t.x(), x.t.y(), geometry::log_so3(x.q).z());
  return (VectorXd(7) << x.t, x.q.coeffs()).finished();
}
SE3 moved(Kind kind, const SE3& x, const VectorXd& d) {
  Vector6d v = Vector6d::Zero();
  if (kind == Kind::se2) {
    v << d[0], d[1], 0, 0, 0, d[2];
  } else {
    v = d;
  }
  return compose(x, geometry::exp(v));
}
SE3 random_motion(Random& random, Kind kind, double size) {
  return moved(kind, SE3{},
               VectorXd::NullaryExpr(dof(kind), [&] { return uniform(random, -size, size); }));
}

std::string numbers(const VectorXd& values) {
  std::ostringstream out;
  out.precision(17);
  for (double value : values) out << ' ' << value;
  return out.str();
}

MatrixXd random_information(Random& random, int n) {
  const MatrixXd a = MatrixXd::NullaryExpr(n, n, [&] { return uniform(random, -1, 1); });
  return 10 * (a * a.transpose() + MatrixXd::Identity(n, n));
}

std::string motion_edge(Random& random, Kind kind, Id a, Id b, const SE3& z) {
  const MatrixXd w = random_information(random, dof(kind));
  std::vector<double> upper;
  for (int i = 0; i < w.rows(); ++i) {
    for (int j = i; j < w.cols(); ++j) upper.push_back(w(i, j));
  }
  return edge_tag(kind) + " " + std::to_string(a) + " " + std::to_string(b) +
         numbers(coordinates(kind, z)) +
         numbers(Eigen::Map<VectorXd>(upper.data(), static_cast<Index>(upper.size()))) + "\n";
}

// A world of poses (ids 0, 2, 4, ...) and its measurements, exact up to `noise`.
struct World {
  Kind kind;
  std::vector<SE3> pose;
  std::string vertices, edges;
};

void add_motion(Random& random, World& world, int i, int j, double noise) {
  if (draw(random, 0, 2) == 0) std::swap(i, j);  // in either direction
  const SE3 z =
      compose(between(world.pose[i], world.pose[j]), random_motion(random, world.kind, noise));
  world.edges += motion_edge(random, world.kind, 2 * i, 2 * j, z);
}

World random_world(Random& random, Kind kind, int n, double noise) {
  World world{kind, {}, "", ""};
  for (int i = 0; i < n; ++i) {
    world.pose.push_back(i ? compose(world.pose.back(), random_motion(random, kind, 0.5))
                           : random_motion(random, kind, 1));
    world.vertices += vertex_tag(kind) + " " + std::to_string(2 * i) +
                      numbers(coordinates(kind, world.pose[i])) + "\n";
  }
  for (int i = 1; i < n; ++i) {
    if (draw(random, 0, 9) == 0) continue;  // a new segment
    for (int copies = draw(random, 0, 4) == 0 ? 2 : 1; copies > 0; --copies)
      add_motion(random, world, i - 1, i, noise);
  }
  for (int k = 0; k < n; ++k) {
    const int i = draw(random, 0, n - 1), j = draw(random, 0, n - 1);
    if (std::abs(i - j) > 1) add_motion(random, world, i, j, noise);
  }
  return world;
}

// The residual of a line as g2o defines it.
VectorXd residual(const prune::Motion& motion, const SE3& first, const SE3& second) {
  if (const auto* z = std::get_if<geometry::UncertainSE2>(&motion)) {
    const SE3 mean{geometry::exp_so3({0, 0, z->mean.theta}), {z->mean.x, z->mean.y, 0}};
    return coordinates(Kind::se2, between(mean, between(first, second)));
  }
  if (const auto* z = std::get_if<geometry::UncertainSE3>(&motion)) {
    const SE3 e = between(z->mean, between(first, second));
    return (VectorXd(6) << e.t, e.q.vec() * (e.q.w() < 0 ? -1 : 1)).finished();
  }
  const SE3 c =
      inverse(std::get<prune::ExpmapMotion>(motion).mean);  // T2^-1 C T1, T world-to-camera
  const Vector6d e = log(compose(second, compose(c, inverse(first))));
  return (VectorXd(6) << e.tail<3>(), e.head<3>()).finished();
}

MatrixXd weight(const prune::Motion& motion) {
  return std::visit([](const auto& z) { return MatrixXd(z.information); }, motion);
}

struct Factor {
  int first, second;  // places in a list of poses
  prune::Motion motion;
};

// The Hessian of the factors by all poses, and their gradient; derivatives by central differences.
std::pair<MatrixXd, VectorXd> linearize(Kind kind, const std::vector<Factor>& factors,
                                        const std::vector<SE3>& poses) {
  const int d = dof(kind), n = static_cast<int>(poses.size());
  MatrixXd hessian = MatrixXd::Zero(d * n, d * n);
  VectorXd gradient = VectorXd::Zero(d * n);
  for (const Factor& f : factors) {
    const auto shifted = [&](int which, int axis, double h) {
      VectorXd step = VectorXd::Zero(d);
      step[axis] = h;
      return residual(f.motion, which == 0 ? moved(kind, poses[f.first], step) : poses[f.first],
                      which == 1 ? moved(kind, poses[f.second], step) : poses[f.second]);
    };
    MatrixXd jacobian = MatrixXd::Zero(d, d * n);
    for (int which : {0, 1}) {
      for (int axis = 0; axis < d; ++axis) {
        jacobian.col(d * (which ? f.second : f.first) + axis) =
            (shifted(which, axis, 1e-6) - shifted(which, axis, -1e-6)) / 2e-6;
      }
    }
    hessian += jacobian.transpose() * weight(f.motion) * jacobian;
    gradient += jacobian.transpose() * weight(f.motion) *
                residual(f.motion, poses[f.first], poses[f.second]);
  }
  return {hessian, gradient};
}

// Solves the factors for all poses but the first, and returns what they know of the last one: its
// marginal information.
MatrixXd solve_and_marginalize(Kind kind, const std::vector<Factor>& factors,
                               std::vector<SE3>& poses) {
  const int d = dof(kind), n = static_cast<int>(poses.size()) - 1;
  for (int step = 0; step < 10; ++step) {
    const auto [hessian, gradient] = linearize(kind, factors, poses);
    const VectorXd change =
        hessian.bottomRightCorner(d * n, d * n).ldlt().solve(-gradient.tail(d * n));
    for (int i = 0; i < n; ++i) poses[i + 1] = moved(kind, poses[i + 1], change.segment(d * i, d));
  }
  const MatrixXd hessian = linearize(kind, factors, poses).first.bottomRightCorner(d * n, d * n);
  return hessian.inverse().bottomRightCorner(d, d).inverse();
}

struct Pruned {
  Graph graph;
  graph::PoseIndex poses;
  graph::Lists<> odometry;
  std::vector<bool> keyframe;
};
Pruned analyzed(const std::string& text, const prune::KeyframeRule& rule) {
  Pruned p{graph_of(text), {}, {}, {}};
  p.poses = graph::pose_index(p.graph);
  p.odometry = prune::odometry_steps(p.graph, p.poses);
  p.keyframe = prune::choose_keyframes(p.graph, p.poses, p.odometry, rule);
  return p;
}

std::string written(const Graph& graph, const prune::Keyframing& kf) {
  formats::Changes changes;
  changes.drop_vertex = kf.removal.vertex;
  changes.drop_edge = kf.removal.edge;
  changes.late_edge = kf.late;
  changes.edge_line = [&](Index e) -> std::optional<std::string> {
    return kf.rewritten[e] ? std::optional(prune::rewritten_line(kf, e)) : std::nullopt;
  };
  StringSink sink;
  formats::write_changed(graph, std::move(changes), "", sink);
  return sink.text;
}

// The factors of the steps from pose index a to pose index b, the poses numbered along the way from
// `place` on.
void append_way(const Pruned& p, Index a, Index b, std::vector<Factor>& factors,
                std::vector<SE3>& poses, const std::vector<SE3>& truth) {
  for (Index k = a; k != b; k += a < b ? 1 : -1) {
    const Index next = k + (a < b ? 1 : -1);
    const int here = static_cast<int>(poses.size()) - 1;
    for (Index e : p.odometry[std::max(k, next)]) {
      const bool forward = p.graph.edge(e)[0] == p.poses.pose[k];
      factors.push_back({forward ? here : here + 1, forward ? here + 1 : here,
                         prune::motion(p.graph, e).value()});
    }
    poses.push_back(truth[next]);
  }
}

// A landmark graph in the plane with odd parts: several landmarks an edge, landmarks joined to each
// other, priors, fixed vertices, ids in no order.
std::string random_landmark_graph(Random& random) {
  const int poses = draw(random, 1, 12), landmarks = draw(random, 1, 8);
  std::vector<std::string> lines;
  for (int i = 0; i < poses; ++i)
    lines.push_back("VERTEX_SE2 " + std::to_string(3 * i) + " 0 0 0\n");
  for (int j = 0; j < landmarks; ++j)
    lines.push_back("VERTEX_XY " + std::to_string(3 * j + 1) + " 0 0\n");
  shuffle(random, lines);
  const auto pose = [&] { return " " + std::to_string(3 * draw(random, 0, poses - 1)); };
  const auto landmark = [&] {
    return " " + std::to_string(3 * draw(random, 0, landmarks - 1) + 1);
  };
  for (int i = 1; i < poses; ++i) {
    lines.push_back("EDGE_SE2 " + std::to_string(3 * i - 3) + " " + std::to_string(3 * i) +
                    " 1 0 0 1 0 0 1 0 1\n");
  }
  for (int k = draw(random, 0, 40); k > 0; --k) {
    const int what = draw(random, 0, 9);
    if (what < 6) lines.push_back("EDGE_SE2_XY" + pose() + landmark() + " 1 0 1 0 1\n");
    if (what == 6) {
      lines.push_back("EDGE_SE2_TWOPOINTSXY" + pose() + landmark() + landmark() +
                      " 1 1 2 2 1 0 0 0 1 0 0 1 0 1\n");
    }
    if (what == 7) lines.push_back("EDGE_POINTXY" + landmark() + landmark() + " 0 0 1 0 1\n");
    if (what == 8) lines.push_back("EDGE_SE2" + pose() + pose() + " 1 0 0 1 0 0 1 0 1\n");
    if (what == 9) lines.push_back("EDGE_PRIOR_XY" + landmark() + " 0 0 1 0 1\n");
  }
  std::string text;
  for (const auto& line : lines) text += line;
  return text;
}

bool has_pose(const Graph& graph, Index e) {
  for (Index v : graph.edge(e)) {
    if (graph.role(v) == graph::Role::pose) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("candidates are observations or loop closures, never odometry", "[prune]") {
  Random random(1);
  for (int trial = 0; trial < 100; ++trial) {
    const Graph graph = graph_of(random_landmark_graph(random));
    const graph::PoseIndex poses = graph::pose_index(graph);
    CHECK(prune::natural_candidates(graph) == prune::Candidates::observations);
    const auto roles = graph::edge_roles(graph, poses);
    std::vector<Index> observations, loops, both;
    for (Index e = 0; e < graph.edges(); ++e) {
      if (roles[e] == graph::EdgeRole::observation) observations.push_back(e);
      if (roles[e] == graph::EdgeRole::loop_closure) loops.push_back(e);
      if (roles[e] == graph::EdgeRole::observation || roles[e] == graph::EdgeRole::loop_closure)
        both.push_back(e);
    }
    CHECK(prune::candidate_edges(graph, poses, prune::Candidates::observations) == observations);
    CHECK(prune::candidate_edges(graph, poses, prune::Candidates::loops) == loops);
    CHECK(prune::candidate_edges(graph, poses, prune::Candidates::both) == both);
  }
}

TEST_CASE("the sweep leaves no landmark with too few observations, and takes no other", "[prune]") {
  Random random(2);
  for (int trial = 0; trial < 300; ++trial) {
    const Graph graph = graph_of(random_landmark_graph(random));
    const graph::PoseIndex poses = graph::pose_index(graph);
    prune::Removal removal = prune::nothing_removed(graph);
    for (Index e = 0; e < graph.edges(); ++e) {
      removal.edge[e] = has_pose(graph, e) && graph.edge(e).size() > 1 &&
                        graph::edge_role(graph, poses, e) != graph::EdgeRole::odometry &&
                        draw(random, 0, 1) == 0;
    }
    const Index min_obs = draw(random, 1, 4);
    // The definition: one landmark at a time, counting anew.
    prune::Removal expected = removal;
    for (bool changed = true; changed;) {
      changed = false;
      for (Index v = 0; v < graph.vertices(); ++v) {
        Index before = 0, after = 0;
        for (Index e = 0; e < graph.edges(); ++e) {
          if (!has_pose(graph, e)) continue;
          for (Index u : graph.edge(e)) {
            before += u == v;
            after += u == v && !expected.edge[e];
          }
        }
        if (graph.role(v) != graph::Role::landmark || expected.vertex[v] || before == 0 ||
            after >= min_obs)
          continue;
        changed = expected.vertex[v] = true;
        for (Index e = 0; e < graph.edges(); ++e) {
          for (Index u : graph.edge(e)) expected.edge[e] = expected.edge[e] || u == v;
        }
      }
    }
    prune::sweep_landmarks(graph, poses, min_obs, removal);
    CHECK(removal.vertex == expected.vertex);
    CHECK(removal.edge == expected.edge);
  }
}

TEST_CASE("decimation is algorithm 1", "[prune]") {
  Random random(3);
  for (int trial = 0; trial < 200; ++trial) {
    const Graph graph = graph_of(random_landmark_graph(random));
    const graph::PoseIndex poses = graph::pose_index(graph);
    const auto candidates = prune::candidate_edges(graph, poses, prune::Candidates::both);
    const Index rate = draw(random, 1, 5);
    std::map<Index, Index> first;  // of every landmark; 0 of the earlier pose of a loop closure
    const auto observed = [&](Index e) {
      const auto ends = graph.edge(e);
      if (graph::edge_role(graph, poses, e) == graph::EdgeRole::observation)
        return graph.role(ends[0]) == graph::Role::landmark ? ends[0] : ends[1];
      return std::min(ends[0], ends[1]);
    };
    const auto observer = [&](Index e) {
      Index last = -1;
      for (Index v : graph.edge(e)) last = std::max(last, poses.index[v]);
      return last;
    };
    for (Index e : candidates) {
      const bool landmark = graph.role(observed(e)) == graph::Role::landmark;
      const auto it = first.emplace(observed(e), landmark ? observer(e) : 0).first;
      it->second = std::min(it->second, observer(e));
    }
    const auto by_first =
        prune::decimate(graph, poses, candidates, rate, prune::DecimationOffset::first, 0);
    const auto aligned =
        prune::decimate(graph, poses, candidates, rate, prune::DecimationOffset::aligned, 0);
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      const Index e = candidates[i];
      CHECK(by_first[i] == (observer(e) % rate == first[observed(e)] % rate));
      CHECK(aligned[i] == (observer(e) % rate == 0));
    }
    // Random offsets: the kept observers of one landmark agree mod rate, and so do the seeds.
    const auto drawn =
        prune::decimate(graph, poses, candidates, rate, prune::DecimationOffset::random, 5);
    CHECK(drawn ==
          prune::decimate(graph, poses, candidates, rate, prune::DecimationOffset::random, 5));
    std::map<Index, std::set<Index>> offsets;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      if (drawn[i]) offsets[observed(candidates[i])].insert(observer(candidates[i]) % rate);
    }
    for (const auto& [landmark, found] : offsets) CHECK(found.size() == 1);
  }
}

TEST_CASE("every subset is as likely as another", "[prune]") {
  std::map<std::vector<bool>, int> seen;
  constexpr int draws = 20000;
  for (int seed = 0; seed < draws; ++seed) ++seen[prune::sample(6, 3, seed)];
  REQUIRE(seen.size() == 20);
  double chi2 = 0;
  for (const auto& [subset, count] : seen) {
    CHECK(std::count(subset.begin(), subset.end(), true) == 3);
    chi2 += (count - draws / 20.0) * (count - draws / 20.0) / (draws / 20.0);
  }
  CHECK(chi2 < 43.8);  // 19 degrees of freedom, one in a thousand
  CHECK(prune::sample(4, 9, 1) == std::vector<bool>(4, true));
  CHECK(prune::sample(4, 0, 1) == std::vector<bool>(4, false));
  CHECK(prune::sample(0, 3, 1).empty());
}

TEST_CASE("a keyframe every so many poses of a segment", "[prune]") {
  Random random(4);
  for (int trial = 0; trial < 60; ++trial) {
    const World world = random_world(random, kinds[trial % 3], draw(random, 2, 25), 0);
    const Index rate = draw(random, 1, 6);
    const Id fixed = 2 * draw(random, 0, static_cast<int>(world.pose.size()) - 1);
    const Pruned p = analyzed(world.vertices + "FIX " + std::to_string(fixed) + "\n" + world.edges,
                              {rate, 0, 0});
    Index first = 0;
    for (Index k = 0; k < static_cast<Index>(p.poses.pose.size()); ++k) {
      bool joined = false;
      for (Index e = 0; e < p.graph.edges(); ++e) {
        const auto ends = p.graph.edge(e);
        joined = joined || (k > 0 && std::minmax(ends[0], ends[1]) == std::minmax(k - 1, k));
      }
      if (!joined) first = k;
      CHECK(p.keyframe[k] == ((k - first) % rate == 0 || k * 2 == fixed));
    }
  }
}

TEST_CASE("keyframes by the distance and the angle travelled", "[prune]") {
  std::string text = "VERTEX_SE2 0 0 0 0\n";
  for (int k = 1; k < 10; ++k) {
    text += "VERTEX_SE2 " + std::to_string(k) + " 0 0 0\nEDGE_SE2 " + std::to_string(k - 1) + " " +
            std::to_string(k) + (k < 6 ? " 0.5 0 0" : " 0 0 -0.5") + " 1 0 0 1 0 1\n";
  }
  using Flags = std::vector<bool>;
  CHECK(analyzed(text, {0, 1, 0}).keyframe == Flags{1, 0, 1, 0, 1, 0, 0, 0, 0, 0});
  CHECK(analyzed(text, {0, 0, 1}).keyframe == Flags{1, 0, 0, 0, 0, 0, 0, 1, 0, 1});
  CHECK(analyzed(text, {0, 1, 1}).keyframe == Flags{1, 0, 1, 0, 1, 0, 0, 1, 0, 1});
}

TEST_CASE("from exact measurements keyframing makes exact ones", "[prune]") {
  Random random(5);
  Index merged = 0;
  std::size_t fused = 0;
  for (int trial = 0; trial < 180; ++trial) {
    const World world = random_world(random, kinds[trial % 3], draw(random, 2, 25), 0);
    const Pruned p = analyzed(world.vertices + world.edges, {draw(random, 1, 6), 0, 0});
    prune::KeyframingOptions options;
    options.fuse = draw(random, 0, 1) == 1;
    if (draw(random, 0, 1) == 1) options.revisit = {1, 1};
    const prune::Keyframing kf =
        prune::keyframing(p.graph, p.poses, p.odometry, p.keyframe, options);
    merged += kf.merged;
    fused += kf.fused.size();
    const Graph pruned = graph_of(written(p.graph, kf));
    CHECK(pruned.vertices() == std::count(p.keyframe.begin(), p.keyframe.end(), true) - kf.merged);
    for (Index e = 0; e < pruned.edges(); ++e) {
      const auto ends = pruned.edge(e);
      const SE3& a = world.pose[pruned.id[ends[0]] / 2];
      const SE3& b = world.pose[pruned.id[ends[1]] / 2];
      CHECK(residual(prune::motion(pruned, e).value(), a, b).norm() < 1e-9);
      CHECK(ends[0] != ends[1]);
    }
    // What was connected stays so.
    CHECK(graph::components(pruned).count == graph::components(p.graph).count);
  }
  CHECK(merged > 50);
  CHECK(fused > 50);
}

TEST_CASE("a fused edge weighs as much as those that it stands for, at the same cost", "[prune]") {
  Random random(12);
  int fused = 0;
  for (int trial = 0; trial < 30; ++trial) {
    const Kind kind = kinds[trial % 3];
    World world = random_world(random, kind, 12, 0);
    for (int k = 0; k < 12; ++k)
      add_motion(random, world, draw(random, 0, 4), draw(random, 7, 11), 0);
    const Pruned p = analyzed(world.vertices + world.edges, {3, 0, 0});
    MatrixXd hessian[2];
    elim::Wide ec[2];
    Index edges[2];
    for (const bool fuse : {false, true}) {
      prune::KeyframingOptions options;
      options.fuse = fuse;
      const Graph pruned = graph_of(
          written(p.graph, prune::keyframing(p.graph, p.poses, p.odometry, p.keyframe, options)));
      std::vector<Factor> factors;
      std::vector<SE3> poses;
      for (Index v = 0; v < pruned.vertices(); ++v) poses.push_back(world.pose[pruned.id[v] / 2]);
      for (Index e = 0; e < pruned.edges(); ++e)
        factors.push_back({pruned.edge(e)[0], pruned.edge(e)[1], prune::motion(pruned, e).value()});
      hessian[fuse] = linearize(kind, factors, poses).first;
      const graph::Pattern pattern = graph::graph_pattern(pruned).pattern;
      ec[fuse] = elim::elimination_complexity(pattern, order::elimination_order("id", pattern));
      edges[fuse] = pruned.edges();
    }
    CHECK((hessian[1] - hessian[0]).norm() < 1e-6 * hessian[0].norm());
    CHECK(ec[0] == ec[1]);
    fused += edges[0] - edges[1];
  }
  CHECK(fused > 100);
}

TEST_CASE("keyframes by covisibility, recounted from scratch", "[prune]") {
  int dropped = 0;
  for (int trial = 0; trial < 200; ++trial) {
    Random random(trial);
    const Graph graph = graph_of(random_landmark_graph(random));
    const graph::PoseIndex poses = graph::pose_index(graph);
    const graph::Lists<> odometry = prune::odometry_steps(graph, poses);
    const prune::CovisibleRule rule{draw(random, 1, 4) / 4.0, draw(random, 1, 3)};
    const auto n = static_cast<Index>(poses.pose.size());
    std::vector<std::set<Index>> sees(n);
    for (Index e = 0; e < graph.edges(); ++e) {
      if (graph::edge_role(graph, poses, e) != graph::EdgeRole::observation) continue;
      const auto ends = graph.edge(e);
      sees[poses.index[ends[0]]].insert(ends.begin() + 1, ends.end());
    }
    std::set<Index> keyframes;
    for (Index k = 0; k < n; ++k) {
      keyframes.insert(k);
      for (const Index j : std::set<Index>(keyframes)) {
        const auto also = [&](Index other) {
          return [&, other](Index l) { return sees[other].contains(l); };
        };
        if (j == k || odometry[j].empty() || graph.fixed[poses.pose[j]] ||
            std::ranges::none_of(sees[j], also(k)))
          continue;
        int known = 0;
        for (const Index l : sees[j]) {
          known += std::ranges::count_if(keyframes, [&](Index other) {
                     return other != j && sees[other].contains(l);
                   }) >= rule.others;
        }
        if (known >= rule.part * static_cast<double>(sees[j].size())) keyframes.erase(j);
      }
    }
    const auto chosen = prune::covisible_keyframes(graph, poses, odometry, rule);
    for (Index k = 0; k < n; ++k) CHECK(chosen[k] == keyframes.contains(k));
    dropped += n - static_cast<int>(keyframes.size());
  }
  CHECK(dropped > 100);
}

TEST_CASE("a composed edge says what the odometry said: mean and information", "[prune]") {
  Random random(6);
  int odometry_checked = 0, loops_checked = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const World world = random_world(random, kinds[trial % 3], draw(random, 4, 12), 0.01);
    const Pruned p = analyzed(world.vertices + world.edges, {draw(random, 2, 5), 0, 0});
    const prune::Keyframing kf = prune::keyframing(p.graph, p.poses, p.odometry, p.keyframe, {});
    for (Index e = 0; e < p.graph.edges(); ++e) {
      if (!kf.rewritten[e]) continue;
      const auto ends = p.graph.edge(e);
      const bool loop = graph::edge_role(p.graph, p.poses, e) == graph::EdgeRole::loop_closure;
      const Graph line = graph_of(world.vertices + prune::rewritten_line(kf, e));
      const Index a = line.edge(0)[0], b = line.edge(0)[1];  // pose indices, as vertices
      std::vector<SE3> poses{world.pose[a]};
      std::vector<Factor> factors;
      if (loop) {
        append_way(p, a, p.poses.index[ends[0]], factors, poses, world.pose);
        const int here = static_cast<int>(poses.size());
        factors.push_back({here - 1, here, prune::motion(p.graph, e).value()});
        poses.push_back(world.pose[p.poses.index[ends[1]]]);
        append_way(p, p.poses.index[ends[1]], b, factors, poses, world.pose);
      } else {
        append_way(p, a, b, factors, poses, world.pose);
      }
      const MatrixXd marginal = solve_and_marginalize(world.kind, factors, poses);
      const std::vector<Factor> composed{{0, 1, prune::motion(line, 0).value()}};
      const std::vector<SE3> ends_only{poses.front(), poses.back()};
      const int d = dof(world.kind);
      const MatrixXd information =
          linearize(world.kind, composed, ends_only).first.bottomRightCorner(d, d);
      CHECK(residual(composed[0].motion, ends_only[0], ends_only[1]).norm() < 4e-3);
      CHECK((information - marginal).norm() < 0.05 * marginal.norm());
      ++(loop ? loops_checked : odometry_checked);
    }
  }
  CHECK(odometry_checked > 50);
  CHECK(loops_checked > 50);
}

TEST_CASE("without noise in parallel odometry the composed information is exact", "[prune]") {
  Random random(7);
  for (int trial = 0; trial < 30; ++trial) {
    const Kind kind = kinds[trial % 3];
    const World world = random_world(random, kind, 8, 0);
    const Pruned p = analyzed(world.vertices + world.edges, {4, 0, 0});
    const prune::Keyframing kf = prune::keyframing(p.graph, p.poses, p.odometry, p.keyframe, {});
    for (Index e = 0; e < p.graph.edges(); ++e) {
      if (!kf.rewritten[e] || graph::edge_role(p.graph, p.poses, e) != graph::EdgeRole::odometry)
        continue;
      const Graph line = graph_of(world.vertices + prune::rewritten_line(kf, e));
      const Index a = line.edge(0)[0], b = line.edge(0)[1];
      std::vector<SE3> poses{world.pose[a]};
      std::vector<Factor> factors;
      append_way(p, a, b, factors, poses, world.pose);
      const MatrixXd marginal = solve_and_marginalize(kind, factors, poses);
      const int d = dof(kind);
      const MatrixXd information =
          linearize(kind, {{0, 1, prune::motion(line, 0).value()}}, {poses.front(), poses.back()})
              .first.bottomRightCorner(d, d);
      CHECK((information - marginal).norm() < 1e-5 * marginal.norm());
    }
  }
}

TEST_CASE("long ways to keyframes are composed from milestones", "[prune]") {
  Random random(8);
  World world{Kind::se2, {}, "", ""};
  for (int i = 0; i < 500; ++i) {
    world.pose.push_back(i ? compose(world.pose.back(), random_motion(random, Kind::se2, 0.1))
                           : SE3{});
    if (i) add_motion(random, world, i - 1, i, 0.01);
  }
  for (int k = 0; k < 50; ++k)
    add_motion(random, world, draw(random, 0, 200), draw(random, 300, 499), 0);
  const Pruned p = analyzed(world.edges, {300, 0, 0});
  prune::Keyframing kf = prune::keyframing(p.graph, p.poses, p.odometry, p.keyframe, {});
  CHECK(kf.milestones.size() >= 4);
  prune::Keyframing plain = kf;
  plain.milestones.clear();
  for (Index e = 0; e < p.graph.edges(); ++e) {
    if (!kf.rewritten[e]) continue;
    const Graph fast = graph_of(prune::rewritten_line(kf, e)),
                slow = graph_of(prune::rewritten_line(plain, e));
    const auto a = std::get<geometry::UncertainSE2>(*prune::motion(fast, 0));
    const auto b = std::get<geometry::UncertainSE2>(*prune::motion(slow, 0));
    CHECK((a.information - b.information).norm() < 1e-9 * b.information.norm());
    const SE2 apart = between(a.mean, b.mean);
    CHECK(std::hypot(apart.x, apart.y, apart.theta) < 1e-9);
  }
}

TEST_CASE("pruning and reordering commute", "[prune]") {
  Random random(9);
  for (int trial = 0; trial < 30; ++trial) {
    const World world = random_world(random, kinds[trial % 3], 20, 0.01);
    std::vector<std::string> lines;
    std::istringstream in(world.vertices);
    for (std::string line; std::getline(in, line);) lines.push_back(line + "\n");
    shuffle(random, lines);
    std::string shuffled;
    for (const auto& line : lines) shuffled += line;
    std::multiset<std::string> results[2];
    for (int k : {0, 1}) {
      const Pruned p = analyzed((k ? shuffled : world.vertices) + world.edges, {3, 0, 0});
      const prune::Keyframing kf = prune::keyframing(p.graph, p.poses, p.odometry, p.keyframe, {});
      std::istringstream out(written(p.graph, kf));
      for (std::string line; std::getline(out, line);) results[k].insert(line);
    }
    CHECK(results[0] == results[1]);
    for (int k : {0, 1}) {
      const Graph graph = graph_of((k ? shuffled : world.vertices) + world.edges);
      const graph::PoseIndex poses = graph::pose_index(graph);
      const auto candidates = prune::candidate_edges(graph, poses, prune::Candidates::loops);
      results[k].clear();
      for (bool kept :
           prune::decimate(graph, poses, candidates, 3, prune::DecimationOffset::first, 0))
        results[k].insert(kept ? "kept" : "gone");
    }
    CHECK(results[0] == results[1]);
  }
}

TEST_CASE("a moved line that would name a vertex too early goes to the end", "[prune]") {
  const std::string information = " 1 0 0 1 0 1\n";
  std::string text = "VERTEX_SE2 0 0 0 0\n";
  for (int k = 1; k <= 8; ++k) {
    text += "VERTEX_SE2 " + std::to_string(k) + " " + std::to_string(k) + " 0 0\n";
    text += "EDGE_SE2 " + std::to_string(k - 1) + " " + std::to_string(k) + " 1 0 0" + information;
    if (k == 7) text += "EDGE_SE2 0 7 7 0 0" + information;
  }
  const Pruned p = analyzed(text, {4, 0, 0});
  const prune::Keyframing kf = prune::keyframing(p.graph, p.poses, p.odometry, p.keyframe, {});
  std::istringstream lines(written(p.graph, kf));
  std::vector<std::string> names;
  for (std::string line; std::getline(lines, line);) {
    std::string_view rest = line;
    std::string name(text::next_word(rest));
    for (int ids = name == "VERTEX_SE2" ? 1 : 2; ids > 0; --ids)
      name += " " + std::string(text::next_word(rest));
    names.push_back(name);
  }
  CHECK(names == std::vector<std::string>{"VERTEX_SE2 0", "VERTEX_SE2 4", "EDGE_SE2 0 4",
                                          "VERTEX_SE2 8", "EDGE_SE2 4 8", "EDGE_SE2 0 8"});
}

TEST_CASE("what keyframing cannot compose it names", "[prune]") {
  const std::string two =
      "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 0 0 0\nVERTEX_SE2 2 0 0 0\nPARAMS_SE2OFFSET 0 0 0 0\n";
  const Pruned p = analyzed(two +
                                "EDGE_SE2_OFFSET 0 1 0 0 1 0 0 1 0 0 1 0 1\n"
                                "EDGE_SE2 1 2 1 0 0 1 0 0 1 0 1\n",
                            {2, 0, 0});
  try {
    prune::keyframing(p.graph, p.poses, p.odometry, p.keyframe, {});
    FAIL("composed EDGE_SE2_OFFSET");
  } catch (const text::Error& error) {
    CHECK(error.fault == text::Fault::input);
    CHECK(text::message(error) ==
          "test.g2o:5: cannot compose odometry of type EDGE_SE2_OFFSET across dropped poses");
  }
}
