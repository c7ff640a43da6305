#pragma once

#include <torch/types.h>

// What folded_conv.cpp and conv_passes.cpp share.
namespace antigrasp {

// Whether cell_conv.h and winograd_conv.h convolve x with this weight.
bool TakesCellConv(const at::Tensor& x, const at::Tensor& weight, at::ScalarType compute);

// The gradient of sum(values * DownConv(cells, weight)) for the weight.
at::Tensor FoldedWeightGradient(const at::Tensor& cells, const at::Tensor& values,
                                const at::Tensor& weight, at::ScalarType compute);

}  // namespace antigrasp
