#pragma once

#include <cstdint>

namespace antigrasp {

// Convolutions with kernel 2 and stride 1 on grids of cells whose channels lie side by side, for
// CPUs with AVX2 and FMA and numbers of channels that are multiples of 8. oneDNN's kernels lose a
// third of their time here: reordering tensors, and taps that fall beyond small grids.
//
// h cells along a side, g = h - 1 outputs: cells [count, h, h, h, in], outputs
// [count, g, g, g, out]. Tap 4 tz + 2 ty + tx links output p to cell p + t.
struct CellConvShape {
  std::int64_t count = 0;
  std::int64_t h = 0;
  std::int64_t in = 0;
  std::int64_t out = 0;
};

// Of this CPU. Nothing below, nor of winograd_conv.h, may be called without: on other processors
// than x86-64 it is not there (no_cell_conv.cpp).
bool HasCellConv();

// outputs = sum over taps of cells[p + t] * weight[t] + bias. panels [ceil(out / 16)][8 taps][in]
// [16 or 8 outputs]: the weights of 16 outputs at a time, then of the last 8 if out % 16 != 0.
void CellConv(const CellConvShape& shape, const float* cells, const float* panels,
              const float* bias, float* outputs);

// Its transpose: cells = sum over taps of outputs[q - t] * weight[t]. panels [in / 16][8 taps][out]
// [16 inputs], the last of 8 likewise.
void CellConvTranspose(const CellConvShape& shape, const float* outputs, const float* panels,
                       float* cells);

// gradient [8 taps][in][out] = sum over outputs of cells[p + t] x output_gradient[p].
void CellConvWeightGradient(const CellConvShape& shape, const float* cells,
                            const float* output_gradient, float* gradient);

}  // namespace antigrasp
