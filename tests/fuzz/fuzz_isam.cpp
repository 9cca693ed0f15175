// The iSAM reader and writer.
#include "tests/fuzz/reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  sg::fuzz::read_and_write(data, size, "isam");
  return 0;
}
