#pragma once

#include <cstdint>

// The sums and products of norm_relu.h on rows of channels, x[rows][channels]. Compiled for several
// kinds of vectors, of which the CPU's best is taken.
namespace antigrasp::norm {

// Per channel: y = scale x + shift, cut at zero.
struct Cut {
  const float *scale, *shift;
};

// sums[c] = sum of x.
void Sum(const float* x, std::int64_t rows, std::int64_t channels, float* sums);
// squares[c] = sum of (x - mean)^2.
void SumSquares(const float* x, std::int64_t rows, std::int64_t channels, const float* mean,
                float* squares);
// y = max(scale x + shift, 0).
void ScaleAndCut(const float* x, std::int64_t rows, std::int64_t channels, const Cut& cut,
                 float* y);
// Sums of g and of g (x - mean) where x was not cut.
void SumGradients(const float* x, const float* g, std::int64_t rows, std::int64_t channels,
                  const Cut& cut, const float* mean, float* sums, float* weighted);
// y = (scale g where x was not cut) + slope x + offset.
void InputGradient(const float* x, const float* g, std::int64_t rows, std::int64_t channels,
                   const Cut& cut, const float* slope, const float* offset, float* y);

}  // namespace antigrasp::norm
