// Compiled with the flags of its instruction set (CMakeLists.txt).
#define MAX_NORM2_PYRAMID MaxNorm2PyramidBaseline
#define PYRAMID_REGISTER_BYTES 16
#include "antigrasp/quality/pyramid_kernel.inc"
