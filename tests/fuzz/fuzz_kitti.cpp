// The reader of KITTI trajectories.
#include "tests/fuzz/reader.h"

using namespace sg;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto graph = fuzz::graph_of(fuzz::copy_of(data, size), "kitti");
  if (graph) fuzz::require_consistent(*graph);
  return 0;
}
