#pragma once

#include <torch/nn/modules/batchnorm.h>

namespace antigrasp {

// norm(x).relu(), its gradients and its running statistics, in few passes over memory:
// LibTorch 1.13 takes many times as long over 3D grids whose channels lie side by side, as
// folding.h makes them. Float on the CPU goes the fast way, with the same bits for any number of
// threads; all else goes through LibTorch. x [N, C, D, H, W].
torch::Tensor NormRelu(torch::nn::BatchNorm3d& norm, const torch::Tensor& x);

}  // namespace antigrasp
