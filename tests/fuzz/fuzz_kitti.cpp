// The reader of KITTI trajectories.
#include "tests/fuzz/reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  sg::fuzz::read(data, size, "kitti");
  return 0;
}
