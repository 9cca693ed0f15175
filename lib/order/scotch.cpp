// Nested dissection by Scotch (Pellegrini, Roman, HPCN 1996) in its default strategy, variables
// weighing their dimension. In one thread: with more, Scotch gives another order each time.
// scotch.h needs stdio.h before it.
#include <cstdio>
//
#include <scotch.h>

#include <cstdlib>
#include <memory>

#include "lib/order/methods.h"
#include "lib/order/parts.h"
#include "lib/text/error.h"

namespace sg::order::methods {
namespace {

void check(int status) {
  if (status != 0) throw text::computation_error("Scotch failed");
}

// Scotch's objects are allocated, initialized, and at last taken down by functions of their own.
template <class T>
using Owned = std::unique_ptr<T, void (*)(T*)>;

template <class T>
Owned<T> owned(T* allocated, int (*initialize)(T*), void (*take_down)(T*)) {
  if (!allocated) throw std::bad_alloc();
  if (initialize(allocated) != 0) {
    SCOTCH_memFree(allocated);
    check(1);
  }
  return {allocated, take_down};
}

template <class T, void (*exit)(T*)>
void take_down(T* object) {
  exit(object);
  SCOTCH_memFree(object);
}

Owned<SCOTCH_Context> single_threaded(std::uint64_t seed) {
  auto context = owned(SCOTCH_contextAlloc(), SCOTCH_contextInit,
                       take_down<SCOTCH_Context, SCOTCH_contextExit>);
  check(SCOTCH_contextRandomClone(context.get()));
  SCOTCH_contextRandomSeed(context.get(), static_cast<SCOTCH_Num>(seed % 0x7fffffff));
  SCOTCH_contextRandomReset(context.get());
  check(SCOTCH_contextOptionSetNum(context.get(), SCOTCH_OPTIONNUMDETERMINISTIC, 1));
  check(SCOTCH_contextThreadSpawn(context.get(), 1, nullptr));
  return context;
}

std::vector<SCOTCH_Num> numbers(const std::vector<Index>& values) {
  return {values.begin(), values.end()};
}

// Scotch ends by a null pointer where memory does, so that more than it takes of chains, tori, cubes and landmark graphs
// is asked for first.
void check_memory(std::size_t vertices, std::size_t neighbours) {
  void* volatile const room = std::malloc(64 * (vertices + neighbours));
  if (!room) throw std::bad_alloc();
  std::free(room);
}

graph::Order order_part(const Part& part, std::uint64_t seed) {
  const SCOTCH_Num n = part.adjacency.size();
  const auto begin = numbers(part.adjacency.begin);
  const auto neighbours = numbers(part.adjacency.items);
  const auto weight = numbers(part.dim);
  check_memory(begin.size(), neighbours.size());
  const auto context = single_threaded(seed);
  const auto graph =
      owned(SCOTCH_graphAlloc(), SCOTCH_graphInit, take_down<SCOTCH_Graph, SCOTCH_graphExit>);
  const auto bound =
      owned(SCOTCH_graphAlloc(), SCOTCH_graphInit, take_down<SCOTCH_Graph, SCOTCH_graphExit>);
  const auto strategy =
      owned(SCOTCH_stratAlloc(), SCOTCH_stratInit, take_down<SCOTCH_Strat, SCOTCH_stratExit>);
  check(SCOTCH_graphBuild(graph.get(), 0, n, begin.data(), nullptr, weight.data(), nullptr,
                          begin[n], neighbours.data(), nullptr));
  check(SCOTCH_contextBindGraph(context.get(), graph.get(), bound.get()));
  std::vector<SCOTCH_Num> order(n);
  check(SCOTCH_graphOrder(bound.get(), strategy.get(), nullptr, order.data(), nullptr, nullptr,
                          nullptr));
  return {order.begin(), order.end()};
}

}  // namespace

graph::Order scotch(const graph::Pattern& pattern, const OrderOptions& options) {
  return order_by_parts(pattern, [&](const Part& part) { return order_part(part, options.seed); });
}

}  // namespace sg::order::methods
