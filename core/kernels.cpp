#include "antigrasp/core/kernels.h"

#include <cstdlib>

namespace antigrasp {

void AskForTheSameKernelsEverywhere() {
#ifdef __x86_64__
  constexpr int kKeepTheUsersOwn = 0;
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) return;
  setenv("ATEN_CPU_CAPABILITY", "avx2", kKeepTheUsersOwn);
  setenv("DNNL_MAX_CPU_ISA", "AVX2", kKeepTheUsersOwn);
  setenv("OPENBLAS_CORETYPE", "Haswell", kKeepTheUsersOwn);
#endif
}

}  // namespace antigrasp
