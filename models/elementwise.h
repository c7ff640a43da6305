#pragma once

#include <torch/types.h>

namespace antigrasp {

// LibTorch's own, bit for bit, on the threads of core/pieces.h.
torch::Tensor Tanh(const torch::Tensor& x);
torch::Tensor AddNumber(const torch::Tensor& x, const torch::Tensor& number);  // [1]
// weight / sigma, sigma = max(u^T W v, least) of W = weight as a matrix; u and v constant.
torch::Tensor DivideBySigma(const torch::Tensor& weight, const torch::Tensor& u,
                            const torch::Tensor& v, double least);

// Tensors [N, ...] and [M, ...] -> [N + M, ...], without gradients.
torch::Tensor Stacked(const torch::Tensor& first, const torch::Tensor& second);

}  // namespace antigrasp
