// Compiled with the flags of its instruction set (CMakeLists.txt).
#define MAX_NORM2_PYRAMID MaxNorm2PyramidAvx512
#define PYRAMID_REGISTER_BYTES 64
#include "antigrasp/quality/pyramid_kernel.inc"
