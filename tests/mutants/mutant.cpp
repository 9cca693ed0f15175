// Which mutant is on, and which sites were reached: a map of the file that all processes of a test share.
#include "mutant.h"

#include <fcntl.h>
#include <sys/mman.h>

#include <cstdlib>

namespace sgm {

constexpr int most_sites = 1 << 16;
static unsigned char nobody_asks[most_sites];
constinit int active = 0;
constinit unsigned char* reached = nobody_asks;

// Ahead of the constructors of all static objects.
[[gnu::constructor(101)]] static void begin() {
  if (const char* k = std::getenv("SGTOOLS_MUTANT")) active = std::atoi(k);
  if (const char* file = std::getenv("SGTOOLS_MUTANT_REACHED")) {
    const int descriptor = ::open(file, O_RDWR);  // of `most_sites` bytes
    void* const map =
        ::mmap(nullptr, most_sites, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
    if (map == MAP_FAILED) std::abort();
    reached = static_cast<unsigned char*>(map);
  }
}

}  // namespace sgm
