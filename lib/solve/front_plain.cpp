// Kernels for any machine: pairs of doubles, as every 64-bit one has them.
#define V 2
#define TILE 2
#define SET plain
#define NAME "plain"
#include "lib/solve/front_kernels.inc"
