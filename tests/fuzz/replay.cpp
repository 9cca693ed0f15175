// Runs a fuzz target over files, each whole, cut short, and with bytes changed at random: what compiles and runs without
// libFuzzer, in every run of the tests, so that the targets stay as the sources are. A seed a file.
#include <boost/random/mersenne_twister.hpp>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int main(int argc, char** argv) {
  for (int k = 1; k < argc; ++k) {
    std::ifstream in(argv[k], std::ios::binary);
    std::vector<std::uint8_t> bytes(std::istreambuf_iterator<char>(in), {});
    if (bytes.empty()) {
      std::fprintf(stderr, "%s is empty or cannot be read\n", argv[k]);
      return 1;
    }
    LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
    boost::random::mt19937 random(k);
    for (int round = 0; round < 100; ++round) {
      std::vector<std::uint8_t> changed(bytes.begin(), bytes.end() - random() % bytes.size());
      for (int flips = random() % 4; flips > 0; --flips)
        changed[random() % changed.size()] = static_cast<std::uint8_t>(random());
      LLVMFuzzerTestOneInput(changed.data(), changed.size());
    }
  }
}
