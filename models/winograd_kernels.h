#pragma once

#include <immintrin.h>

#include "antigrasp/models/winograd_products.h"

// Included by the two files that define the kernels, each compiled for vectors of another length.
// No function of the standard library is used here: the linker keeps one copy of those.
namespace antigrasp::winograd {
namespace {

#ifdef __AVX512F__
using Vector = __m512;
constexpr int kRows = 8, kWholeRows = 8;  // at a time; the last 4 by themselves
inline Vector Zero() { return _mm512_setzero_ps(); }
inline Vector Load(const float* from) { return _mm512_loadu_ps(from); }
inline Vector Broadcast(const float* from) { return _mm512_set1_ps(*from); }
inline Vector MultiplyAdd(Vector a, Vector b, Vector sum) { return _mm512_fmadd_ps(a, b, sum); }
inline void Store(float* to, Vector x) { _mm512_storeu_ps(to, x); }
#else
using Vector = __m256;
constexpr int kRows = 6, kWholeRows = 12;  // six fill the registers, four still hide the latency
inline Vector Zero() { return _mm256_setzero_ps(); }
inline Vector Load(const float* from) { return _mm256_loadu_ps(from); }
inline Vector Broadcast(const float* from) { return _mm256_broadcast_ss(from); }
inline Vector MultiplyAdd(Vector a, Vector b, Vector sum) { return _mm256_fmadd_ps(a, b, sum); }
inline void Store(float* to, Vector x) { _mm256_storeu_ps(to, x); }
#endif

constexpr int kLength = sizeof(Vector) / sizeof(float);
// A broadcast number is worth two vectors: of one panel, or one of each of two.
constexpr int kPairPanels = 2 * kLength / kPanel;

template <int Rows, int Vectors>
inline void AddTile(const ProductBlock& b, std::int64_t row, std::int64_t panel) {
  const std::int64_t right_step = kPairPanels == 1 ? kLength : b.right_panel_step;
  const std::int64_t sums_step = kPairPanels == 1 ? kLength : b.sums_panel_step;
  const float* left = b.left + row * b.left_row_step;
  const float* right = b.right + panel * b.right_panel_step;
  float* sums = b.sums + row * b.sums_row_step + panel * b.sums_panel_step;
  Vector total[Rows][Vectors];
#pragma GCC unroll 8
  for (int r = 0; r < Rows; ++r) {
#pragma GCC unroll 2
    for (int v = 0; v < Vectors; ++v) {
      total[r][v] = b.first ? Zero() : Load(sums + r * b.sums_row_step + v * sums_step);
    }
  }
  const std::int64_t row_step = b.left_row_step, depth_step = b.left_depth_step;
  for (std::int64_t i = 0; i < b.depth; ++i, left += depth_step, right += kPanel) {
    Vector factors[Vectors];
#pragma GCC unroll 2
    for (int v = 0; v < Vectors; ++v) factors[v] = Load(right + v * right_step);
#pragma GCC unroll 8
    for (int r = 0; r < Rows; ++r) {
      const Vector value = Broadcast(left + r * row_step);
#pragma GCC unroll 2
      for (int v = 0; v < Vectors; ++v) total[r][v] = MultiplyAdd(value, factors[v], total[r][v]);
    }
  }
#pragma GCC unroll 8
  for (int r = 0; r < Rows; ++r) {
#pragma GCC unroll 2
    for (int v = 0; v < Vectors; ++v)
      Store(sums + r * b.sums_row_step + v * sums_step, total[r][v]);
  }
}

template <int Vectors>
inline void AddRows(const ProductBlock& b, std::int64_t panel) {
  const std::int64_t whole = b.rows / kWholeRows * kWholeRows;
  std::int64_t row = 0;
  for (; row < whole; row += kRows) AddTile<kRows, Vectors>(b, row, panel);
  for (; row < b.rows; row += kRowStep) AddTile<kRowStep, Vectors>(b, row, panel);
}

inline void AddProducts(const ProductBlock& b) {
  const std::int64_t panels = b.width / kPanel;
  std::int64_t panel = 0;
  for (; panel + kPairPanels <= panels; panel += kPairPanels) AddRows<2>(b, panel);
  if (kPairPanels == 2 && panel < panels) AddRows<1>(b, panel);
}

}  // namespace
}  // namespace antigrasp::winograd
