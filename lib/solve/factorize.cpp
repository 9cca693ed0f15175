#include "lib/solve/factorize.h"

#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cassert>

#include "lib/parallel/parallel.h"

namespace sg::solve {
namespace {

constexpr int panel_width = 128;
constexpr int rows_at_once =
    384;  // of a panel: three eighths of a megabyte, which a cache of second level holds

// Calls work(first, last) for all tiles, some at a time.
template <class Work>
void each_block(int tiles, int at_once, bool parallel, Work&& work) {
  const int blocks = (tiles + at_once - 1) / at_once;
  const auto block = [&](int b) { work(b * at_once, std::min((b + 1) * at_once, tiles)); };
  if (parallel) {
    // Isolated: a thread that waits must not take up another front, whose work it would write over.
    tbb::this_task_arena::isolate([&] { parallel::each(blocks, block); });
  } else {
    for (int b = 0; b < blocks; ++b) block(b);
  }
}

}  // namespace

bool is_large(int f, int n) {
  return f >= 16 && n >= 768;
}

std::size_t panel_work(const Kernels& kernel, int n, int width) {
  const std::size_t w = width;
  return (round_up(width) + lane) * w + lane + 3 * round_up(width) + (n + 2 * kernel.tile) * w;
}

std::size_t factorization_work(const Kernels& kernel, int f, int n) {
  return is_large(f, n) ? panel_work(kernel, n, panel_width) : 0;
}

int factorize_by_panels(const Kernels& kernel, const Front& front, const double* floor,
                        double* work, int threads, int width) {
  assert(width % 4 == 0);
  int dropped = 0;
  for (int first = 0; first < front.f; first += width) {
    Panel panel{first, std::min(width, front.f - first), work, nullptr, nullptr};
    panel.diagonals = panel.block + panel.ld_block() * panel.width + lane;
    panel.packed = panel.diagonals + 3 * round_up(panel.width);
    dropped += kernel.factorize_block(front, panel, floor);
    const int tiles = kernel.tiles(front, panel), at_once = std::max(1, rows_at_once / kernel.tile);
    const bool parallel = threads > 1 && tiles > 2 * at_once;
    each_block(tiles, at_once, parallel,
               [&](int begin, int end) { kernel.solve_tiles(front, panel, begin, end); });
    each_block(tiles, at_once, parallel,
               [&](int begin, int end) { kernel.update_tiles(front, panel, begin, end); });
  }
  return dropped;
}

int factorize(const Kernels& kernel, const Front& front, const double* floor, double* work,
              int threads) {
  return is_large(front.f, front.n)
             ? factorize_by_panels(kernel, front, floor, work, threads, panel_width)
             : kernel.factorize(front, floor);
}

}  // namespace sg::solve
