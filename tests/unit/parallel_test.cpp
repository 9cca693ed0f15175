// What runs in parallel, for the thread sanitizer to watch (make tsan): with any number of threads
// the numbers are the same.
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <catch2/catch.hpp>

#include "formats/formats.h"
#include "lib/factor/initialize.h"
#include "lib/order/order.h"
#include "lib/solve/eliminate.h"

namespace {

// A grid of poses, each row joined to the next: bushy, so that many tasks have several children.
sg::Graph grid(int rows, int columns) {
  std::string text;
  const auto join = [&](int a, int b) {
    text += "EDGE_SE2 " + std::to_string(a) + " " + std::to_string(b) + " 1 0.1 0.2 9 1 0 8 2 7\n";
  };
  for (int i = 0; i < rows; ++i) {
    for (int k = 0; k < columns; ++k) {
      if (k > 0) join(i * columns + k - 1, i * columns + k);
      if (i > 0) join((i - 1) * columns + k, i * columns + k);
    }
  }
  return sg::formats::read_graph_text(sg::text::text_of(text), "grid.g2o");
}

}  // namespace

TEST_CASE("linearization and elimination: the same numbers by any number of threads",
          "[eliminate][parallel]") {
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 4);
  const sg::Graph graph = grid(30, 30);
  const sg::factor::Problem problem = sg::factor::make_problem(graph);
  const sg::factor::Values values = sg::factor::start_values(problem);
  const sg::graph::Order order = sg::order::elimination_order("metis", problem.variables.pattern);
  std::vector<double> numbers, step;
  for (const int threads : {1, 2, 4}) {
    tbb::task_arena arena(threads);
    sg::factor::LinearSystem system = sg::factor::make_linear_system(problem);
    arena.execute([&] { sg::factor::linearize(problem, values, {}, system); });
    auto elimination = sg::solve::plan_elimination(system, order, threads);
    CHECK((elimination.tasks.size() > 1) == (threads > 1));
    std::vector<double> again;
    for (int repeat = 0; repeat < 3; ++repeat) {
      REQUIRE(sg::solve::eliminate(elimination, system).empty());
      sg::solve::back_substitute(elimination, again);
      if (step.empty()) step = again;
      CHECK(again == step);
    }
    if (numbers.empty()) numbers = system.numbers;
    CHECK(system.numbers == numbers);
  }
}

TEST_CASE("the portfolio of orderings: the same order by any number of threads",
          "[best][parallel]") {
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 4);
  const sg::Graph graph = grid(12, 12);
  const sg::graph::Pattern pattern = sg::graph::graph_pattern(graph).pattern;
  sg::order::OrderOptions options;
  options.budget = {64, 0};
  sg::graph::Order first;
  for (const int threads : {1, 4}) {
    sg::graph::Order order;
    tbb::task_arena(threads).execute(
        [&] { order = sg::order::elimination_order("best", pattern, options); });
    if (first.empty()) first = order;
    CHECK(order == first);
  }
}
