// Kernels for x86-64 with AVX-512.
#ifdef SGTOOLS_X86_KERNELS
#define V 8
#define TILE 3
#define SET avx512
#define NAME "avx512"
#include "lib/solve/front_kernels.inc"
#endif
