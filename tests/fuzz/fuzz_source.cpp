// Told by content, and unpacked: whatever a file may hold.
#include <unistd.h>

#include <cstdio>

#include "tests/fuzz/reader.h"

using namespace sg;

namespace {

std::string scratch() {
  return "/tmp/fuzz_source." + std::to_string(::getpid());
}

void write_file(const std::string& path, const std::uint8_t* data, std::size_t size) {
  std::FILE* const file = std::fopen(path.c_str(), "wb");
  fuzz::require(file && std::fwrite(data, 1, size, file) == size);
  std::fclose(file);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::string path = scratch();
  write_file(path, data, size);
  try {
    const auto graph = fuzz::graph_of(text::read_text(path), "");
    if (graph) fuzz::require_consistent(*graph);
  } catch (const text::Error& error) {
    fuzz::require(error.fault == text::Fault::input);
  }
  return 0;
}
