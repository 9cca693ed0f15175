#include "lib/solve/front.h"

#include <array>

namespace sg {
namespace plain {
extern const Kernels table;
}
#ifdef SGTOOLS_X86_KERNELS
namespace avx2 {
extern const Kernels table;
}
namespace avx512 {
extern const Kernels table;
}
#endif

namespace {

struct Choice {
  std::array<const Kernels*, 3> kernels{&plain::table};
  std::size_t count = 1;

  Choice() {
#ifdef SGTOOLS_X86_KERNELS
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
      kernels[count++] = &avx2::table;
    if (count > 1 && __builtin_cpu_supports("avx512f")) kernels[count++] = &avx512::table;
#endif
  }
};

const Choice& choice() {
  static const Choice made;
  return made;
}

}  // namespace

std::span<const Kernels* const> all_kernels() {
  return {choice().kernels.data(), choice().count};
}

const Kernels& kernels() {
  return *all_kernels().back();
}

}  // namespace sg
