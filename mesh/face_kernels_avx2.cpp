// Compiled with the flags of its instruction set (CMakeLists.txt).
#define FACE_KERNELS FaceKernelsAvx2
#include "antigrasp/mesh/face_kernels.inc"
