#pragma once

#include <torch/types.h>

namespace antigrasp {

// Convolutions with kernel 4, stride 2, padding 1 and their transposes, in a form that runs fast on
// the CPU. A grid of s^3 nodes with a ring of zero nodes around it is cut into 2^3 blocks: the
// eight nodes of a block become channels of one cell of h^3, h = s / 2 + 1. On the cells the kernel
// is 2 and the stride 1, with the same weights and the same numbers. Strided gradients have no AVX2
// kernel in oneDNN, and one-channel grids are slow everywhere: docs/performance.md. Float on a CPU
// with AVX2 goes through cell_conv.h, all else through the convolutions of LibTorch. Everything
// here is differentiable once.

// Networks keep the channels of a node side by side.
inline constexpr at::MemoryFormat kChannelsLast = at::MemoryFormat::ChannelsLast3d;

// [N, C, s, s, s] <-> [N, 8 C, h, h, h], s even: channel p C + c of a cell is channel c of its node
// p = 4 pz + 2 py + px. Unfolding drops the ring. Each is the other's gradient.
torch::Tensor Fold(const torch::Tensor& grid);
torch::Tensor Unfold(const torch::Tensor& folded);

// Fold(leaky_relu(grid, leak)).
torch::Tensor FoldLeaky(const torch::Tensor& grid, double leak);

// conv3d of the unfolded grid, stride 2, padding 1: weight [out, in, 4, 4, 4], bias [out].
// folded [N, 8 in, h, h, h] -> [N, out, h - 1, h - 1, h - 1]. `compute`: the type in which products
// are taken (float or bfloat16); tensors in and out are float.
torch::Tensor DownConv(const torch::Tensor& folded, const torch::Tensor& weight,
                       const torch::Tensor& bias, at::ScalarType compute = at::kFloat);

// DownConv(FoldLeaky(grid, leak), ...) and Unfold(UpConv(...)), with the same bits; where a few
// samples fit the caches they pass through both before the next.
torch::Tensor DownConvLeaky(const torch::Tensor& grid, double leak, const torch::Tensor& weight,
                            const torch::Tensor& bias, at::ScalarType compute = at::kFloat);
torch::Tensor UpConvUnfolded(const torch::Tensor& x, const torch::Tensor& weight,
                             at::ScalarType compute = at::kFloat);

// conv_transpose3d, stride 2, folded: weight [in, out, 4, 4, 4], no bias.
// x [N, in, s, s, s] -> [N, 8 out, s + 1, s + 1, s + 1]. Unfolded it is the layer with padding 1;
// the ring holds what a padding of 0 adds.
torch::Tensor UpConv(const torch::Tensor& x, const torch::Tensor& weight,
                     at::ScalarType compute = at::kFloat);

// Smooths with [1 2 1]/4 along each axis (zero beyond the ring) if `blur`, then zeroes the ring.
// [N, 8, h, h, h].
torch::Tensor BlurAndClearRing(const torch::Tensor& folded, bool blur);

// x - gain * Laplacian(x) on the unfolded one-channel grid, nodes beyond it being equal to the
// outermost; the ring stays zero. [N, 8, h, h, h].
torch::Tensor EmphasizeEdges(const torch::Tensor& folded, double gain);

}  // namespace antigrasp
