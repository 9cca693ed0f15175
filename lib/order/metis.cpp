// Nested dissection by METIS (Karypis, Kumar, SIAM J. Sci. Comput. 20, 1998), variables weighing
// their dimension where dimensions differ, and separators for our own. METIS draws from the C library's
// generator, which it seeds itself: one call at a time.
#include "lib/order/metis.h"

#include <metis.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <new>
#include <string>

#include "lib/order/methods.h"
#include "lib/order/parts.h"
#include "lib/text/error.h"

namespace sg::order {
namespace {

static_assert(sizeof(idx_t) == sizeof(Index));

// What METIS says on standard error, which is of its own affairs: kept from there as long as this lives.
struct Said {
  char* text = nullptr;
  std::size_t size = 0;
  std::FILE* stream = ::open_memstream(&text, &size);
  std::FILE* standard = stderr;

  Said() {
    if (stream) stderr = stream;
  }
  ~Said() {
    stderr = standard;
    if (stream) std::fclose(stream);
    std::free(text);
  }
  Said(const Said&) = delete;
  Said& operator=(const Said&) = delete;
  bool anything() { return stream && std::fflush(stream) == 0 && size > 0; }
};

std::mutex one_call;

void check(int status, Said& said) {
  if (status == METIS_ERROR_MEMORY) throw std::bad_alloc();
  // METIS catches SIGTERM while it works and calls it an error, without a word: it is for whoever would have caught it.
  if (status == METIS_ERROR && !said.anything()) std::raise(SIGTERM);
  if (status != METIS_OK) {
    throw text::computation_error("METIS failed (status " + std::to_string(status) + ")");
  }
}

std::array<idx_t, METIS_NOPTIONS> options_of(std::uint64_t seed) {
  std::array<idx_t, METIS_NOPTIONS> options{};
  METIS_SetDefaultOptions(options.data());
  options[METIS_OPTION_NUMBERING] = 0;
  if (seed != 0) options[METIS_OPTION_SEED] = static_cast<idx_t>(seed % 0x7fffffff);
  return options;
}

graph::Order order_part(Part& part, std::array<idx_t, METIS_NOPTIONS> options) {
  idx_t n = part.adjacency.size();
  const bool alike = std::equal(part.dim.begin() + 1, part.dim.end(), part.dim.begin());
  graph::Order order(n);
  graph::Order position(n);
  const std::lock_guard lock(one_call);
  Said said;
  check(METIS_NodeND(&n, part.adjacency.begin.data(), part.adjacency.items.data(),
                     alike ? nullptr : part.dim.data(), options.data(), order.data(),
                     position.data()),
        said);
  return order;
}

}  // namespace

Separation metis_separation(const Piece& piece, std::uint64_t seed) {
  // METIS reads these, and takes no const.
  graph::Lists<> graph = piece.inside;
  std::vector<int> weight = piece.inner_weight;
  idx_t n = graph.size();
  auto options = options_of(seed);
  options[METIS_OPTION_NITER] = 4;      // what refinement is left is by price (refine.h)
  options[METIS_OPTION_UFACTOR] = 300;  // a side may have 1.3 times its half
  idx_t size = 0;
  std::vector<idx_t> side(n);
  const std::lock_guard lock(one_call);
  Said said;
  check(METIS_ComputeVertexSeparator(&n, graph.begin.data(), graph.items.data(), weight.data(),
                                     options.data(), &size, side.data()),
        said);
  return {side.begin(), side.end()};
}

graph::Order tuned_metis(const graph::Pattern& pattern, const OrderOptions& options) {
  auto tuned = options_of(options.seed);
  tuned[METIS_OPTION_NSEPS] = 20;
  tuned[METIS_OPTION_NITER] = 100;
  return order_by_parts(pattern, [&](Part& part) { return order_part(part, tuned); });
}

namespace methods {

graph::Order metis(const graph::Pattern& pattern, const OrderOptions& options) {
  return order_by_parts(pattern,
                        [&](Part& part) { return order_part(part, options_of(options.seed)); });
}

}  // namespace methods
}  // namespace sg::order
