// OpenBLAS, loaded when a benchmark runs, so that nothing else here is linked to it.
#pragma once

#include <dlfcn.h>

namespace sg::bench {

// Its function of that name, for one thread; null where OpenBLAS is not installed.
template <class Function>
Function openblas(const char* name) {
  void* const library = dlopen("libopenblas.so.0", RTLD_NOW | RTLD_LOCAL);
  if (!library) return nullptr;
  using Set = void (*)(int);
  reinterpret_cast<Set>(dlsym(library, "openblas_set_num_threads"))(1);
  return reinterpret_cast<Function>(dlsym(library, name));
}

}  // namespace sg::bench
