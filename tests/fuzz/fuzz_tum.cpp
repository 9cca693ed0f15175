// The reader of TUM trajectories.
#include "tests/fuzz/reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  sg::fuzz::read(data, size, "tum");
  return 0;
}
