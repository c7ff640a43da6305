#include "antigrasp/models/winograd_kernels.h"

namespace antigrasp::winograd {

void AddProductsAvx512(const ProductBlock& block) { AddProducts(block); }

}  // namespace antigrasp::winograd
