#pragma once

#include <functional>

#include "antigrasp/models/cell_conv.h"

namespace antigrasp {

// The convolutions of cell_conv.h with 27 products for every 2^3 outputs where they take 64, by
// Winograd's minimal filtering F(2, 2) along each axis (Winograd, Arithmetic Complexity of
// Computations, SIAM 1980; Lavin and Gray, Fast Algorithms for Convolutional Neural Networks, CVPR
// 2016). Along one axis, of cells d0 d1 d2 and taps g0 g1:
//   m0 = (d0 - d1) g0,  m1 = d1 (g0 + g1),  m2 = (d2 - d1) g1;   y0 = m0 + m1,  y1 = m1 + m2.
// The transposed convolution and the gradient of the weights are the same bilinear form read for
// another of its three factors. Nothing but sums of two or three numbers surrounds the products, so
// that float stays as exact as it was.

// Whether the shape can and should go this way: an even number of outputs along a side, and enough
// channels for the products to outweigh the sums.
constexpr bool SuitsWinograd(const CellConvShape& s) {
  return s.h % 2 == 1 && s.h > 1 && s.in % 64 == 0 && s.out % 16 == 0;
}

// Like their namesakes in cell_conv.h; weight and its gradient are the layer's own,
// [out][in / 8][4^3]: tap t of 4^3 is tap t / 2 of 2^3 and phase t % 2, along each axis.
void WinogradConv(const CellConvShape& shape, const float* cells, const float* weight,
                  const float* bias, float* outputs);  // bias: may be null
void WinogradConvTranspose(const CellConvShape& shape, const float* outputs, const float* weight,
                           float* cells);

// The same with what is before or behind done to a few samples at a time, while they are in the
// caches, on several threads: fill(sample) makes the cells of a sample that `cells` is to hold;
// take(sample, cells) is given those of one, which lie nowhere else. For shapes of which a few
// samples are small and many of a call.
bool SuitsSampleBySample(const CellConvShape& shape);
void WinogradConvOfFilled(const CellConvShape& shape, const std::function<void(std::int64_t)>& fill,
                          const float* cells, const float* weight, const float* bias,
                          float* outputs);
void WinogradConvTransposeTaken(const CellConvShape& shape, const float* outputs,
                                const float* weight,
                                const std::function<void(std::int64_t, const float*)>& take);

void WinogradConvWeightGradient(const CellConvShape& shape, const float* cells,
                                const float* output_gradient, float* weight_gradient);

}  // namespace antigrasp
