#define FACE_KERNELS FaceKernelsBaseline
#include "antigrasp/mesh/face_kernels.inc"
