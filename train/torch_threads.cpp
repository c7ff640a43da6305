#include "antigrasp/train/torch_threads.h"

#include <ATen/Parallel.h>
#include <dlfcn.h>

namespace antigrasp {

void SetTorchThreads(int threads) {
  void* const set = dlsym(RTLD_DEFAULT, "openblas_set_num_threads");  // absent with another BLAS
  if (set != nullptr) reinterpret_cast<void (*)(int)>(set)(1);
  at::set_num_threads(threads);
}

}  // namespace antigrasp
