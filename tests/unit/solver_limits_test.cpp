// Where solvers end: rows that are not finite, numbers too large to square, indices beyond int, and
// references to what is gone.
#include <catch2/catch.hpp>
#include <limits>
#include <type_traits>

#include "formats/formats.h"
#include "lib/factor/initialize.h"
#include "lib/order/order.h"
#include "lib/prune/keyframes.h"
#include "lib/solve/batch.h"
#include "lib/solve/isam2_replay.h"
#include "lib/solve/pivots.h"
#include "lib/solve/snapshot.h"

namespace {

sg::Graph graph_of(const std::string& text) {
  return sg::formats::read_graph_text(sg::text::text_of(text), "test.g2o");
}

// The message of the Error that `work` ends with, empty without one.
std::string failure(const auto& work) {
  try {
    work();
  } catch (const sg::text::Error& error) {
    CHECK(error.fault == sg::text::Fault::computation);
    return sg::text::message(error);
  }
  return "";
}

// Of every batch backend and of the replay, which have to agree.
std::string failure_of_all(const std::string& text) {
  const sg::Graph graph = graph_of(text);
  const sg::factor::Problem problem = sg::factor::make_problem(graph);
  std::string incremental = failure([&] {
    auto replay = sg::solve::make_isam2_replay(problem, {}, 1, !graph.edges_only);
    for (sg::Index k = 0; k < replay.steps.steps; ++k) sg::solve::replay_step(replay, k);
  });
  const sg::graph::Order order = sg::order::elimination_order("colamd", problem.variables.pattern);
  for (const sg::solve::Backend& backend : sg::solve::backends()) {
    const std::string batch = failure([&] {
      sg::factor::LinearSystem system = sg::factor::make_linear_system(problem);
      sg::factor::Values values = sg::factor::start_values(problem);
      sg::solve::optimize(problem, system, backend.make(system, order, 1), {}, values);
    });
    CHECK(batch == incremental);
  }
  return incremental;
}

const std::string in_space = " 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1";

}  // namespace

TEST_CASE("an edge without a derivative is told by its line, in batch and step by step",
          "[limits]") {
  // The second camera has the landmark at (1, 0, 0): beside its lens, in its plane.
  CHECK(failure_of_all("VERTEX_SE3:EXPMAP 0 0 0 1 0 0 0 1\n"
                       "VERTEX_SE3:EXPMAP 1 1 0 0 0 0 0 1\n"
                       "VERTEX_XYZ 2 0 0 0\n"
                       "PARAMS_CAMERAPARAMETERS 0 500 320 240 0\n"
                       "FIX 0\n"
                       "EDGE_SE3:EXPMAP 0 1 1 0 -1 0 0 0 1" +
                       in_space +
                       "\n"
                       "EDGE_PROJECT_XYZ2UV:EXPMAP 2 0 0 320 240 1 0 1\n"
                       "EDGE_PROJECT_XYZ2UV:EXPMAP 2 1 0 400 240 1 0 1\n") ==
        "test.g2o:8: EDGE_PROJECT_XYZ2UV:EXPMAP has no derivative at this estimate");
  CHECK(failure_of_all("VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\n"
                       "VERTEX_TRACKXYZ 1 0 0 0\n"
                       "PARAMS_CAMERACALIB 0 0 0 0 0 0 0 1 500 500 320 240\n"
                       "EDGE_PROJECT_DISPARITY 0 1 0 320 240 1 1 0 0 1 0 1\n") ==
        "test.g2o:4: EDGE_PROJECT_DISPARITY has no derivative at this estimate");
}

TEST_CASE("information whose sums leave the finite numbers is told by its line", "[limits]") {
  for (const char* const huge : {"1e308", "1e300"}) {
    const std::string information = std::string(huge) + " 0 0 " + huge + " 0 " + huge;
    CHECK(failure_of_all("EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\n"
                         "EDGE_SE2 1 2 1 0 0 " +
                         information + "\n") ==
          "test.g2o:2: EDGE_SE2 weighs too much to calculate with: its information or its error is "
          "too large");
  }
  CHECK(failure_of_all("EDGE_SE2 0 1 1 0 0 1e270 0 0 1e270 0 1e270\n"
                       "EDGE_SE2 1 2 1 0 0 1e-300 0 0 1e-300 0 1e-300\n")
            .empty());
}

TEST_CASE("a pivot that is not finite is dropped like one that vanished", "[limits]") {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const sg::solve::Kernels* kernel : sg::solve::all_kernels()) {
    INFO(kernel->name);
    for (const double odd : {nan, infinity, 0.0, -1.0}) {
      std::vector<double> l(3 * sg::solve::lane + sg::solve::lane),
          u(sg::solve::lane + sg::solve::lane);
      const sg::solve::Front front{l.data(), u.data(), 3, 4};
      for (int k = 0; k < 3; ++k) front.pivot(k) = k == 1 ? odd : 4;
      const std::vector<double> floors(3, 1e-9);
      CHECK(kernel->factorize(front, floors.data()) == 1);
      std::vector<sg::Index> dropped;
      const std::vector<sg::Index> frontals{0, 1};
      const std::vector<int> dim{1, 2};
      sg::solve::append_vanished(front, frontals, dim, dropped);
      CHECK(dropped == std::vector<sg::Index>{1});
      CHECK(front.pivot(0) == 2);
      std::vector<double> x(sg::solve::lane);
      x[3] = -1;
      kernel->back_substitute(front, x.data());
      CHECK(x[1] == 0);
    }
  }
}

TEST_CASE("one rule says which pivots have vanished: both backends and the replay", "[limits]") {
  // Information [1 c; c 1]: the second pivot is 1 - c^2, next to an entry of 1.
  for (const bool regular : {false, true}) {
    const std::string c = regular ? "0.99999999999998" : "0.999999999999999";
    const sg::Graph graph = graph_of(
        "FIX 0\nVERTEX_XY 0 0 0\nVERTEX_XY 1 0 0\n"
        "EDGE_POINTXY 0 1 1 1 1 " +
        c + " 1\n");
    const sg::factor::Problem problem = sg::factor::make_problem(graph);
    sg::factor::LinearSystem system = sg::factor::make_linear_system(problem);
    sg::factor::linearize(problem, sg::factor::start_values(problem), {}, system);
    INFO(regular);
    for (const sg::solve::Backend& backend : sg::solve::backends()) {
      INFO(backend.name);
      // QR, which squares nothing, sees the second pivot's root.
      const bool wanted = regular || backend.name == "qr";
      CHECK(backend.make(system, {0}, 1).eliminate(system, {}) == wanted);
    }
  }
}

TEST_CASE("the diagonal of a front lies beyond int from 46341 rows on", "[limits]") {
  STATIC_REQUIRE(sg::solve::diagonal_at(46341, 46344) == 46341LL * 46345LL);
  STATIC_REQUIRE(sg::solve::diagonal_at(46341, 46344) > std::numeric_limits<int>::max());
  double origin = 0;
  const sg::solve::Front front{&origin, &origin, 60000, 60001};
  const auto distance = [&](int k) {
    return (reinterpret_cast<std::uintptr_t>(&front.pivot(k)) -
            reinterpret_cast<std::uintptr_t>(&origin)) /
           sizeof(double);
  };
  CHECK(distance(59999) == 59999ULL * (60008 + 1));
}

// What points to its argument takes no temporary, and what points to itself is not copied.
namespace {

template <class G>
concept can_make_problem = requires(G&& graph) {
  sg::factor::make_problem(std::forward<G>(graph));
};
template <class P>
concept can_make_system = requires(P&& p) {
  sg::factor::make_linear_system(std::forward<P>(p));
};
template <class P>
concept can_make_isam2 = requires(P&& p) {
  sg::solve::make_isam2(std::forward<P>(p), {});
};
template <class P>
concept can_make_replay = requires(P&& p) {
  sg::solve::make_isam2_replay(std::forward<P>(p), {}, 1, false);
};
template <class G, class P, class O>
concept can_keyframe = requires(G&& g, P&& p, O&& o) {
  sg::prune::keyframing(std::forward<G>(g), std::forward<P>(p), std::forward<O>(o), {}, {});
};

static_assert(can_make_problem<const sg::Graph&> && !can_make_problem<sg::Graph>);
static_assert(can_make_system<const sg::factor::Problem&> && !can_make_system<sg::factor::Problem>);
static_assert(can_make_isam2<const sg::factor::Problem&> && !can_make_isam2<sg::factor::Problem>);
static_assert(can_make_replay<const sg::factor::Problem&> && !can_make_replay<sg::factor::Problem>);
static_assert(can_keyframe<sg::Graph&, sg::graph::PoseIndex&, sg::graph::Lists<>&>);
static_assert(!can_keyframe<sg::Graph, sg::graph::PoseIndex&, sg::graph::Lists<>&>);
static_assert(!can_keyframe<sg::Graph&, sg::graph::PoseIndex, sg::graph::Lists<>&>);
static_assert(!can_keyframe<sg::Graph&, sg::graph::PoseIndex&, sg::graph::Lists<>>);
static_assert(!std::is_copy_constructible_v<sg::solve::Snapshot>);
static_assert(!std::is_copy_assignable_v<sg::solve::Snapshot>);

}  // namespace
