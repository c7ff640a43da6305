// Compiled with the flags of its instruction set (CMakeLists.txt).
#define MAX_NORM2_PYRAMID MaxNorm2PyramidAvx2
#define PYRAMID_REGISTER_BYTES 32
#include "antigrasp/quality/pyramid_kernel.inc"
