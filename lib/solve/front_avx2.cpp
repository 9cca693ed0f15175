// Kernels for x86-64 with AVX2 and FMA.
#ifdef SGTOOLS_X86_KERNELS
#define V 4
#define TILE 3
#define SET avx2
#define NAME "avx2"
#include "lib/solve/front_kernels.inc"
#endif
