#include "lib/solve/front.h"

#include <array>
#include <cstdlib>
#include <string>

#include "lib/text/error.h"

namespace sg::solve {
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

const Kernels& chosen_kernels() {
  const char* const wanted = std::getenv("SGTOOLS_KERNELS");
  if (!wanted || *wanted == '\0') return *all_kernels().back();
  std::string names;
  for (const Kernels* there : all_kernels()) {
    if (std::string_view(wanted) == there->name) return *there;
    names += (names.empty() ? "" : ", ") + std::string(there->name);
  }
  throw text::usage_error("SGTOOLS_KERNELS: no kernels '" + std::string(wanted) +
                          "' on this machine; there are: " + names);
}

}  // namespace

std::span<const Kernels* const> all_kernels() {
  return {choice().kernels.data(), choice().count};
}

const Kernels& kernels() {
  static const Kernels& chosen = chosen_kernels();
  return chosen;
}

}  // namespace sg::solve
