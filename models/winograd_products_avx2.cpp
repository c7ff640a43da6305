#include "antigrasp/models/winograd_kernels.h"

namespace antigrasp::winograd {

void AddProductsAvx2(const ProductBlock& block) { AddProducts(block); }

ProductKernel BestProductKernel() {
  static const bool wide = __builtin_cpu_supports("avx512f");
  return wide ? AddProductsAvx512 : AddProductsAvx2;
}

}  // namespace antigrasp::winograd
