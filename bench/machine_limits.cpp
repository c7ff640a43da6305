#include "bench/machine_limits.h"

#include <immintrin.h>

#include <algorithm>
#include <ctime>
#include <limits>
#include <vector>

namespace antigrasp::bench {
namespace {

constexpr int kSums = 12, kTimes = 2'000'000;  // sums enough to hide what a multiply-add takes

[[gnu::target("avx2,fma")]] float SumsOfEight() {
  __m256 sums[kSums];
  for (int k = 0; k < kSums; ++k) sums[k] = _mm256_set1_ps(1.0F + 0.1F * static_cast<float>(k));
  const __m256 a = _mm256_set1_ps(0.999F), b = _mm256_set1_ps(0.001F);
  for (int i = 0; i < kTimes; ++i) {
#pragma GCC unroll 12
    for (int k = 0; k < kSums; ++k) sums[k] = _mm256_fmadd_ps(sums[k], a, b);
  }
  float total = 0.0F;
  for (const __m256& sum : sums) total += _mm256_cvtss_f32(sum);
  return total;
}

[[gnu::target("avx512f")]] float SumsOfSixteen() {
  __m512 sums[kSums];
  for (int k = 0; k < kSums; ++k) sums[k] = _mm512_set1_ps(1.0F + 0.1F * static_cast<float>(k));
  const __m512 a = _mm512_set1_ps(0.999F), b = _mm512_set1_ps(0.001F);
  for (int i = 0; i < kTimes; ++i) {
#pragma GCC unroll 12
    for (int k = 0; k < kSums; ++k) sums[k] = _mm512_fmadd_ps(sums[k], a, b);
  }
  float total = 0.0F;
  for (const __m512& sum : sums) total += _mm512_cvtss_f32(sum);
  return total;
}

double ThreadSeconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double RateOf(float (*sums)(), int lanes) {
  volatile float sink = 0.0F;
  const double seconds = LeastThreadSeconds([&] { sink = sink + sums(); }, 7);
  return 2.0 * lanes * kSums * kTimes / seconds;
}

}  // namespace

double LeastThreadSeconds(const std::function<void()>& work, int rounds) {
  double least = std::numeric_limits<double>::infinity();
  for (int round = 0; round < rounds; ++round) {
    const double before = ThreadSeconds();
    work();
    least = std::min(least, ThreadSeconds() - before);
  }
  return least;
}

double PeakRateOfEight() {
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") ? RateOf(SumsOfEight, 8)
                                                                         : 0.0;
}

double PeakRateOfSixteen() {
  return __builtin_cpu_supports("avx512f") ? RateOf(SumsOfSixteen, 16) : 0.0;
}

double MemoryRate() {
  constexpr std::size_t kNumbers = std::size_t{1} << 26;  // 256 MB each
  std::vector<float> a(kNumbers, 0.0F), b(kNumbers, 1.0F), c(kNumbers, 2.0F);
  const auto triad = [&] {
    for (std::size_t i = 0; i < kNumbers; ++i) a[i] = b[i] + 3.0F * c[i];
  };
  return 3.0 * sizeof(float) * kNumbers / LeastThreadSeconds(triad, 5);
}

}  // namespace antigrasp::bench
