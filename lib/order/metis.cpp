// Nested dissection by METIS (Karypis, Kumar, SIAM J. Sci. Comput. 20, 1998), variables weighing
// their dimension where dimensions differ. METIS draws from the C library's generator, which it
// seeds itself: not to be called from two threads at once.
#include <metis.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <string>

#include "lib/order/methods.h"
#include "lib/order/parts.h"
#include "lib/text/error.h"

namespace sg::order::methods {
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

graph::Order order_part(Part& part, std::uint64_t seed) {
  idx_t n = part.adjacency.size();
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_NUMBERING] = 0;
  if (seed != 0) options[METIS_OPTION_SEED] = static_cast<idx_t>(seed % 0x7fffffff);
  const bool alike = std::equal(part.dim.begin() + 1, part.dim.end(), part.dim.begin());
  graph::Order order(n);
  graph::Order position(n);
  Said said;
  const int status =
      METIS_NodeND(&n, part.adjacency.begin.data(), part.adjacency.items.data(),
                   alike ? nullptr : part.dim.data(), options, order.data(), position.data());
  if (status == METIS_ERROR_MEMORY) throw std::bad_alloc();
  // METIS catches SIGTERM while it works and calls it an error, without a word: it is for whoever would have caught it.
  if (status == METIS_ERROR && !said.anything()) std::raise(SIGTERM);
  if (status != METIS_OK) {
    throw text::computation_error("METIS failed (status " + std::to_string(status) + ")");
  }
  return order;
}

}  // namespace

graph::Order metis(const graph::Pattern& pattern, const OrderOptions& options) {
  return order_by_parts(pattern, [&](Part& part) { return order_part(part, options.seed); });
}

}  // namespace sg::order::methods
