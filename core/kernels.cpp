#include "antigrasp/core/kernels.h"

#include <cstdlib>

namespace antigrasp {

namespace {

constexpr int kKeepTheUsersOwn = 0;

}  // namespace

void AskForTheSameKernelsEverywhere() {
#ifdef __x86_64__
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) return;
  setenv("ATEN_CPU_CAPABILITY", "avx2", kKeepTheUsersOwn);
  setenv("DNNL_MAX_CPU_ISA", "AVX2", kKeepTheUsersOwn);
  setenv("OPENBLAS_CORETYPE", "Haswell", kKeepTheUsersOwn);
#endif
}

void PrepareForNetworks() {
  AskForTheSameKernelsEverywhere();
  setenv("GLIBC_TUNABLES", "glibc.malloc.hugetlb=1", kKeepTheUsersOwn);
}

}  // namespace antigrasp
