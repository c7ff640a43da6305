#include "antigrasp/models/winograd_weights.h"

#include <immintrin.h>

#include "antigrasp/core/pieces.h"

// Compiled for AVX2 and FMA, like all of Winograd's convolution.
namespace antigrasp::winograd {
namespace {

constexpr std::int64_t kTaps = 64;  // of 4^3

// Vector t of 8: element t of each of the 8 vectors.
inline void Transpose(__m256* rows) {
  __m256 pairs[8], fours[8];
#pragma GCC unroll 4
  for (int i = 0; i < 4; ++i) {
    pairs[2 * i] = _mm256_unpacklo_ps(rows[2 * i], rows[2 * i + 1]);
    pairs[2 * i + 1] = _mm256_unpackhi_ps(rows[2 * i], rows[2 * i + 1]);
  }
#pragma GCC unroll 2
  for (int i = 0; i < 8; i += 4) {
    fours[i] = _mm256_shuffle_ps(pairs[i], pairs[i + 2], 0x44);
    fours[i + 1] = _mm256_shuffle_ps(pairs[i], pairs[i + 2], 0xEE);
    fours[i + 2] = _mm256_shuffle_ps(pairs[i + 1], pairs[i + 3], 0x44);
    fours[i + 3] = _mm256_shuffle_ps(pairs[i + 1], pairs[i + 3], 0xEE);
  }
#pragma GCC unroll 4
  for (int i = 0; i < 4; ++i) {
    rows[i] = _mm256_permute2f128_ps(fours[i], fours[i + 4], 0x20);
    rows[i + 4] = _mm256_permute2f128_ps(fours[i], fours[i + 4], 0x31);
  }
}

// Tap of 4^3 that is tap (z, y, x) of 2^3 and phase p.
constexpr int TapOf(int z, int y, int x, int p) {
  return 16 * (2 * z + (p >> 2)) + 4 * (2 * y + (p >> 1 & 1)) + 2 * x + (p & 1);
}

// The 27 factors of phase p of eight kernels, taps[t] their t-th taps.
inline void SpreadTaps(const __m256* taps, int p, float* to, std::int64_t step) {
  __m256 f[3][3][3];
#pragma GCC unroll 2
  for (int z = 0; z < 2; ++z) {
#pragma GCC unroll 2
    for (int y = 0; y < 2; ++y) {
      __m256* row = f[2 * z][2 * y];
      row[0] = taps[TapOf(z, y, 0, p)];
      row[2] = taps[TapOf(z, y, 1, p)];
      row[1] = _mm256_add_ps(row[0], row[2]);
    }
#pragma GCC unroll 3
    for (int x = 0; x < 3; ++x) f[2 * z][1][x] = _mm256_add_ps(f[2 * z][0][x], f[2 * z][2][x]);
  }
#pragma GCC unroll 3
  for (int y = 0; y < 3; ++y) {
#pragma GCC unroll 3
    for (int x = 0; x < 3; ++x) {
      const int k = 3 * y + x;
      _mm256_storeu_ps(to + k * step, f[0][y][x]);
      _mm256_storeu_ps(to + (9 + k) * step, _mm256_add_ps(f[0][y][x], f[2][y][x]));
      _mm256_storeu_ps(to + (18 + k) * step, f[2][y][x]);
    }
  }
}

// Its transpose.
inline void GatherTaps(const float* from, std::int64_t step, int p, __m256* taps) {
  __m256 f[2][3][3];
#pragma GCC unroll 3
  for (int y = 0; y < 3; ++y) {
#pragma GCC unroll 3
    for (int x = 0; x < 3; ++x) {
      const int k = 3 * y + x;
      const __m256 middle = _mm256_loadu_ps(from + (9 + k) * step);
      f[0][y][x] = _mm256_add_ps(_mm256_loadu_ps(from + k * step), middle);
      f[1][y][x] = _mm256_add_ps(middle, _mm256_loadu_ps(from + (18 + k) * step));
    }
  }
#pragma GCC unroll 2
  for (int z = 0; z < 2; ++z) {
#pragma GCC unroll 2
    for (int y = 0; y < 2; ++y) {
      __m256 row[3];
#pragma GCC unroll 3
      for (int x = 0; x < 3; ++x) row[x] = _mm256_add_ps(f[z][y][x], f[z][y + 1][x]);
      taps[TapOf(z, y, 0, p)] = _mm256_add_ps(row[0], row[1]);
      taps[TapOf(z, y, 1, p)] = _mm256_add_ps(row[1], row[2]);
    }
  }
}

// The taps of eight kernels, `stride` floats apart.
inline void LoadTaps(const float* kernels, std::int64_t stride, __m256* taps) {
  for (int t = 0; t < kTaps; t += kLanes) {
    for (int i = 0; i < kLanes; ++i) taps[t + i] = _mm256_loadu_ps(kernels + i * stride + t);
    Transpose(taps + t);
  }
}

}  // namespace

Panels MakePanels(const CellConvShape& s, const float* weight, bool of_outputs) {
  const std::int64_t channels = s.in / 8, step = s.in * s.out + kPadding;
  const std::int64_t rows = of_outputs ? s.in : s.out;
  // Eight outputs of one channel, or eight channels of one output, at a time: first the two that
  // share lines of the panels.
  const std::int64_t rounds = of_outputs ? channels : s.out,
                     columns = of_outputs ? s.out : channels;
  const std::int64_t along = of_outputs ? channels * kTaps : kTaps;  // floats between columns
  const std::int64_t across = of_outputs ? kTaps : channels * kTaps;
  Panels panels{AllocateFloats(27 * step), step};
  ForPieces((columns + kPanel - 1) / kPanel, [&](std::int64_t panel) {
    __m256 taps[kTaps];
    for (std::int64_t i = 0; i < rounds; ++i) {
      for (std::int64_t c = panel * kPanel; c < std::min(columns, (panel + 1) * kPanel);
           c += kLanes) {
        LoadTaps(weight + i * across + c * along, along, taps);
        for (int p = 0; p < 8; ++p) {
          const std::int64_t column = of_outputs ? c : p * channels + c;
          const std::int64_t row = of_outputs ? p * channels + i : i;
          SpreadTaps(
              taps, p,
              panels.values.get() + (column / kPanel * rows + row) * kPanel + column % kPanel,
              step);
        }
      }
    }
  });
  return panels;
}

void GatherWeightGradient(const CellConvShape& s, const InputBlock& block, const float* sums,
                          std::int64_t step, float* weight_gradient) {
  const std::int64_t channels = s.in / 8, rows = 4 * block.width;
  __m256 taps[kTaps];  // of which a block has those of one pz
  for (std::int64_t o = 0; o < s.out; o += kLanes) {
    for (std::int64_t j = 0; j < block.width; ++j) {
      for (int p = 0; p < 4; ++p) {
        const float* from = sums + (o / kPanel * rows + p * block.width + j) * kPanel + o % kPanel;
        GatherTaps(from, step, p, taps);
      }
      for (int t = 0; t < kTaps; t += kLanes) {
        if ((t >> 4 & 1) != 0) continue;
        Transpose(taps + t);
        float* to = weight_gradient + (o * channels + block.first + j) * kTaps + t + 16 * block.pz;
        for (int i = 0; i < kLanes; ++i) _mm256_storeu_ps(to + i * channels * kTaps, taps[t + i]);
      }
    }
  }
}

}  // namespace antigrasp::winograd
