#include "antigrasp/train/torch_threads.h"

#include <ATen/Parallel.h>
#include <dlfcn.h>

#include "antigrasp/core/pieces.h"
#include "antigrasp/models/cell_conv.h"

namespace antigrasp {

void SetTorchThreads(int threads, int of_libtorch) {
  void* const set = dlsym(RTLD_DEFAULT, "openblas_set_num_threads");  // absent with another BLAS
  if (set != nullptr) reinterpret_cast<void (*)(int)>(set)(1);
  at::set_num_threads(of_libtorch);
  SetPieceThreads(threads);
}

int ThreadsOfLibTorch(const ModelOptions& model, bool on_cpu, int threads) {
  const int width_d = model.width_d > 0 ? model.width_d : model.width;
  const bool ours = on_cpu && HasCellConv() && model.precision == Precision::kFloat32 &&
                    model.block == Block::kPlain && model.width % 8 == 0 && width_d % 8 == 0;
  return ours ? 1 : threads;
}

}  // namespace antigrasp
