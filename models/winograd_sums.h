#pragma once

#include <immintrin.h>

#include <cstdint>

#include "antigrasp/models/winograd_tiles.h"

// The sums around the products of winograd_conv.h, on one tile: 2^3 outputs and the 3^3 cells that
// they see. Included by files compiled for AVX2 only.
//
// A tile's 27 values m[z][y][x] are made and used a plane z at a time: nine vectors fit the
// registers, and a plane of a block of tiles the L2 cache. Value 3 y + x of a plane lies
// (3 y + x) * plane_step floats from the first.
namespace antigrasp::winograd {

// Cells to plane Z: (d0 - d1, d1, d2 - d1) along each axis.
template <int Z>
inline void DifferenceCells(const float* cells, const Steps& step, std::int64_t channels,
                            float* plane, std::int64_t plane_step) {
  for (std::int64_t c = 0; c < channels; c += kLanes) {
    __m256 d[3][3];
#pragma GCC unroll 3
    for (int y = 0; y < 3; ++y) {
#pragma GCC unroll 3
      for (int x = 0; x < 3; ++x) {
        const float* at = cells + c + y * step.y + x * step.x;
        d[y][x] = _mm256_loadu_ps(at + step.z);
        if (Z != 1) d[y][x] = _mm256_sub_ps(_mm256_loadu_ps(at + Z * step.z), d[y][x]);
      }
    }
#pragma GCC unroll 3
    for (int x = 0; x < 3; ++x) {
      d[0][x] = _mm256_sub_ps(d[0][x], d[1][x]);
      d[2][x] = _mm256_sub_ps(d[2][x], d[1][x]);
    }
#pragma GCC unroll 3
    for (int y = 0; y < 3; ++y) {
      float* to = plane + c + 3 * y * plane_step;
      _mm256_storeu_ps(to, _mm256_sub_ps(d[y][0], d[y][1]));
      _mm256_storeu_ps(to + plane_step, d[y][1]);
      _mm256_storeu_ps(to + 2 * plane_step, _mm256_sub_ps(d[y][2], d[y][1]));
    }
  }
}

inline void AddTo(float* to, __m256 x) {
  _mm256_storeu_ps(to, _mm256_add_ps(_mm256_loadu_ps(to), x));
}
inline void TakeFrom(float* to, __m256 x) {
  _mm256_storeu_ps(to, _mm256_sub_ps(_mm256_loadu_ps(to), x));
}

// Its transpose: adds (m0, m1 - m0 - m2, m2) along each axis to the cells.
template <int Z>
inline void AddToCells(const float* plane, std::int64_t plane_step, std::int64_t channels,
                       const Steps& step, float* cells) {
  for (std::int64_t c = 0; c < channels; c += kLanes) {
    __m256 d[3][3];
#pragma GCC unroll 3
    for (int y = 0; y < 3; ++y) {
      const float* from = plane + c + 3 * y * plane_step;
      d[y][0] = _mm256_loadu_ps(from);
      d[y][2] = _mm256_loadu_ps(from + 2 * plane_step);
      d[y][1] = _mm256_sub_ps(_mm256_sub_ps(_mm256_loadu_ps(from + plane_step), d[y][0]), d[y][2]);
    }
#pragma GCC unroll 3
    for (int x = 0; x < 3; ++x) {
      d[1][x] = _mm256_sub_ps(_mm256_sub_ps(d[1][x], d[0][x]), d[2][x]);
    }
#pragma GCC unroll 3
    for (int y = 0; y < 3; ++y) {
#pragma GCC unroll 3
      for (int x = 0; x < 3; ++x) {
        float* at = cells + c + y * step.y + x * step.x;
        if (Z == 1) {
          AddTo(at + step.z, d[y][x]);
        } else {
          AddTo(at + Z * step.z, d[y][x]);
          TakeFrom(at + step.z, d[y][x]);
        }
      }
    }
  }
}

// Plane Z to outputs: (m0 + m1, m1 + m2) along each axis. The planes come in order, the first to
// reach an output starts it with the bias.
template <int Z>
inline void AddToOutputs(const float* plane, std::int64_t plane_step, std::int64_t channels,
                         const float* bias, const Steps& step, float* outputs) {
  for (std::int64_t c = 0; c < channels; c += kLanes) {
    const __m256 b = bias != nullptr ? _mm256_loadu_ps(bias + c) : _mm256_setzero_ps();
    __m256 m[3][2];
#pragma GCC unroll 3
    for (int y = 0; y < 3; ++y) {
      const float* from = plane + c + 3 * y * plane_step;
      const __m256 middle = _mm256_loadu_ps(from + plane_step);
      m[y][0] = _mm256_add_ps(_mm256_loadu_ps(from), middle);
      m[y][1] = _mm256_add_ps(middle, _mm256_loadu_ps(from + 2 * plane_step));
    }
#pragma GCC unroll 2
    for (int y = 0; y < 2; ++y) {
#pragma GCC unroll 2
      for (int x = 0; x < 2; ++x) {
        const __m256 sum = _mm256_add_ps(m[y][x], m[y + 1][x]);
        float* at = outputs + c + y * step.y + x * step.x;
        if (Z == 0) _mm256_storeu_ps(at, _mm256_add_ps(sum, b));
        if (Z == 1) AddTo(at, sum);
        if (Z == 1) _mm256_storeu_ps(at + step.z, _mm256_add_ps(sum, b));
        if (Z == 2) AddTo(at + step.z, sum);
      }
    }
  }
}

// Its transpose: outputs to plane Z, (y0, y0 + y1, y1) along each axis.
template <int Z>
inline void SpreadOutputs(const float* outputs, const Steps& step, std::int64_t channels,
                          float* plane, std::int64_t plane_step) {
  for (std::int64_t c = 0; c < channels; c += kLanes) {
    __m256 m[3][2];
#pragma GCC unroll 2
    for (int x = 0; x < 2; ++x) {
#pragma GCC unroll 2
      for (int y = 0; y < 2; ++y) {
        const float* at = outputs + c + y * step.y + x * step.x;
        __m256& sum = m[2 * y][x];
        sum = _mm256_loadu_ps(Z == 2 ? at + step.z : at);
        if (Z == 1) sum = _mm256_add_ps(sum, _mm256_loadu_ps(at + step.z));
      }
      m[1][x] = _mm256_add_ps(m[0][x], m[2][x]);
    }
#pragma GCC unroll 3
    for (int y = 0; y < 3; ++y) {
      float* to = plane + c + 3 * y * plane_step;
      _mm256_storeu_ps(to, m[y][0]);
      _mm256_storeu_ps(to + plane_step, _mm256_add_ps(m[y][0], m[y][1]));
      _mm256_storeu_ps(to + 2 * plane_step, m[y][1]);
    }
  }
}

}  // namespace antigrasp::winograd
