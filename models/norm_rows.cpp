#include "antigrasp/models/norm_rows.h"

#include <type_traits>

// Everything with vectors is inlined: how they would be passed does not matter.
#pragma GCC diagnostic ignored "-Wpsabi"
#define ANTIGRASP_INLINE __attribute__((always_inline))
#ifdef __x86_64__
#define ANTIGRASP_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define ANTIGRASP_CLONES
#endif

namespace antigrasp::norm {
namespace {

// Channels side by side, which the compiler maps to the vectors that there are.
template <int Count>
struct Lanes {
  typedef float Type __attribute__((vector_size(4 * Count)));
};

// Calls visit(count, first channel) for blocks of 16, 8 and at last single channels. A block goes
// through all rows, so that its sums stay in registers.
template <typename Visit>
ANTIGRASP_INLINE inline void ForBlocks(std::int64_t channels, const Visit& visit) {
  std::int64_t c = 0;
  for (; c + 16 <= channels; c += 16) visit(std::integral_constant<int, 16>(), c);
  for (; c + 8 <= channels; c += 8) visit(std::integral_constant<int, 8>(), c);
  for (; c < channels; ++c) visit(std::integral_constant<int, 1>(), c);
}

template <int Count>
ANTIGRASP_INLINE inline typename Lanes<Count>::Type Load(const float* from) {
  typename Lanes<Count>::Type values;
  __builtin_memcpy(&values, from, sizeof(values));
  return values;
}
template <typename Vector>
ANTIGRASP_INLINE inline void Store(float* to, const Vector& values) {
  __builtin_memcpy(to, &values, sizeof(values));
}

}  // namespace

ANTIGRASP_CLONES void Sum(const float* x, std::int64_t rows, std::int64_t channels, float* sums) {
  ForBlocks(channels, [&](auto count, std::int64_t c) ANTIGRASP_INLINE {
    typename Lanes<count>::Type sum = {};
    for (std::int64_t r = 0; r < rows; ++r) sum += Load<count>(x + r * channels + c);
    Store(sums + c, sum);
  });
}

ANTIGRASP_CLONES void SumSquares(const float* x, std::int64_t rows, std::int64_t channels,
                                 const float* mean, float* squares) {
  ForBlocks(channels, [&](auto count, std::int64_t c) ANTIGRASP_INLINE {
    const auto center = Load<count>(mean + c);
    typename Lanes<count>::Type sum = {};
    for (std::int64_t r = 0; r < rows; ++r) {
      const auto apart = Load<count>(x + r * channels + c) - center;
      sum += apart * apart;
    }
    Store(squares + c, sum);
  });
}

ANTIGRASP_CLONES void ScaleAndCut(const float* x, std::int64_t rows, std::int64_t channels,
                                  const Cut& cut, float* y) {
  ForBlocks(channels, [&](auto count, std::int64_t c) ANTIGRASP_INLINE {
    const typename Lanes<count>::Type zero = {};
    const auto scale = Load<count>(cut.scale + c), shift = Load<count>(cut.shift + c);
    for (std::int64_t r = 0; r < rows; ++r) {
      const auto value = Load<count>(x + r * channels + c) * scale + shift;
      Store(y + r * channels + c, value > 0.0F ? value : zero);
    }
  });
}

ANTIGRASP_CLONES void SumGradients(const float* x, const float* g, std::int64_t rows,
                                   std::int64_t channels, const Cut& cut, const float* mean,
                                   float* sums, float* weighted) {
  ForBlocks(channels, [&](auto count, std::int64_t c) ANTIGRASP_INLINE {
    const auto scale = Load<count>(cut.scale + c), shift = Load<count>(cut.shift + c);
    const auto center = Load<count>(mean + c);
    const typename Lanes<count>::Type zero = {};
    typename Lanes<count>::Type sum = {}, product = {};
    for (std::int64_t r = 0; r < rows; ++r) {
      const auto value = Load<count>(x + r * channels + c);
      const auto slope = value * scale + shift > 0.0F ? Load<count>(g + r * channels + c) : zero;
      sum += slope;
      product += slope * (value - center);
    }
    Store(sums + c, sum);
    Store(weighted + c, product);
  });
}

ANTIGRASP_CLONES void InputGradient(const float* x, const float* g, std::int64_t rows,
                                    std::int64_t channels, const Cut& cut, const float* slope,
                                    const float* offset, float* y) {
  ForBlocks(channels, [&](auto count, std::int64_t c) ANTIGRASP_INLINE {
    const typename Lanes<count>::Type zero = {};
    const auto scale = Load<count>(cut.scale + c), shift = Load<count>(cut.shift + c);
    const auto u = Load<count>(slope + c), v = Load<count>(offset + c);
    for (std::int64_t r = 0; r < rows; ++r) {
      const auto value = Load<count>(x + r * channels + c);
      const auto passed =
          value * scale + shift > 0.0F ? scale * Load<count>(g + r * channels + c) : zero;
      Store(y + r * channels + c, passed + (u * value + v));
    }
  });
}

}  // namespace antigrasp::norm
