#include "antigrasp/core/normal_pairs.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace antigrasp {
namespace {

#define AG_INLINE inline __attribute__((always_inline))

constexpr int kChunk = 32;  // pairs

// A number as an unevaluated sum: |low| is at most half a last place of high.
struct TwoPart {
  double high, low;
};

AG_INLINE TwoPart Sum(double a, double b) {
  const double sum = a + b, part = sum - a;
  return {sum, (a - (sum - part)) + (b - part)};
}
AG_INLINE TwoPart SumOfLarger(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}
// Whether a library's function may return another number than `high`: the low part, which is right
// to .01 of a last place, lies nearer to the half of it than the library's error is beyond .5.
// glibc's errors are at most .519 (logarithm) and .55 (sine and cosine).
constexpr double kLogStretch = 16.0 / 15.0,
                 kTurnStretch = 8.0 / 7.0;  // .031 and .0625 before the half
AG_INLINE bool IsOpen(const TwoPart& x, double stretch) {
  return x.high + x.low * stretch != x.high;
}

TwoPart Split(long double x) {
  const auto high = static_cast<double>(x);
  return {high, static_cast<double>(x - high)};
}

// log(z) = -log(inverse) + log(1 + r), r = z inverse - 1, for z of one of the intervals of [11/16,
// 11/8); sines and cosines of multiples of pi / 32.
constexpr int kLogIntervals = 128, kTurns = 65;
constexpr std::uint64_t kLogOffset = 0x3fe6000000000000;  // 11/16
struct Tables {
  double inverse[kLogIntervals], log_high[kLogIntervals], log_low[kLogIntervals];
  double sine[kTurns], sine_low[kTurns], cosine[kTurns], cosine_low[kTurns];
};

Tables MakeTables() {
  Tables t;
  for (std::uint64_t i = 0; i < kLogIntervals; ++i) {
    const auto start = std::bit_cast<double>(kLogOffset + (i << 45));
    const auto end = std::bit_cast<double>(kLogOffset + ((i + 1) << 45));
    // Next to 1 the sum would lose digits: there r is z - 1.
    const bool at_one = start <= 1.0 && end >= 1.0;
    t.inverse[i] = at_one ? 1.0 : std::round(2048.0 / (start + end)) / 1024.0;
    const TwoPart log = Split(-std::log(static_cast<long double>(t.inverse[i])));
    t.log_high[i] = log.high;
    t.log_low[i] = log.low;
  }
  for (int j = 0; j < kTurns; ++j) {
    // By the first octant, where nought is nought.
    const int quarter = j / 16, rest = j % 16;
    const long double angle = rest * (std::numbers::pi_v<long double> / 32);
    const long double s = std::sin(angle), c = std::cos(angle);
    const auto at = static_cast<std::size_t>(j);
    const TwoPart sine = Split(quarter == 0   ? s
                               : quarter == 1 ? c
                               : quarter == 2 ? -s
                               : quarter == 3 ? -c
                                              : s);
    const TwoPart cosine = Split(quarter == 0   ? c
                                 : quarter == 1 ? -s
                                 : quarter == 2 ? -c
                                 : quarter == 3 ? s
                                                : c);
    t.sine[at] = sine.high;
    t.sine_low[at] = sine.low;
    t.cosine[at] = cosine.high;
    t.cosine_low[at] = cosine.low;
  }
  return t;
}

// Of x in (0, 1].
AG_INLINE TwoPart Log(const Tables& t, double x) {
  constexpr double kLn2High = 0x1.62e42fefa3800p-1, kLn2Low = 0x1.ef35793c76730p-45;
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const std::uint64_t from = bits - kLogOffset + (std::uint64_t{1024} << 52);
  const std::uint64_t exponent = from >> 52, i = (from >> 45) & (kLogIntervals - 1);
  const auto z = std::bit_cast<double>(bits - ((exponent - 1024) << 52));
  const double k = std::bit_cast<double>(0x4330000000000000 + exponent) - (0x1p52 + 1024.0);
  const double inverse = t.inverse[i], product = z * inverse;
  const double r = product - 1.0, rest = __builtin_fma(z, inverse, -product);
  const TwoPart scale = Sum(k * kLn2High, t.log_high[i]);
  const TwoPart sum = Sum(scale.high, r);
  double p = 1.0 / 11;
  p = p * r - 1.0 / 10;
  p = p * r + 1.0 / 9;
  p = p * r - 1.0 / 8;
  p = p * r + 1.0 / 7;
  p = p * r - 1.0 / 6;
  p = p * r + 1.0 / 5;
  p = p * r - 1.0 / 4;
  p = p * r + 1.0 / 3;
  p = p * r - 1.0 / 2;
  const double low = (rest - r * rest) + (sum.low + scale.low) + (k * kLn2Low + t.log_low[i]);
  return SumOfLarger(sum.high, r * r * p + low);
}

struct SineCosine {
  TwoPart sine, cosine;
};

// Of an angle in [0, 2 pi].
AG_INLINE SineCosine SinCos(const Tables& t, double angle) {
  // pi / 32 in three parts; seven bits times the first are exact.
  constexpr double kPart1 = 0x1.921fb54442d00p-4, kPart2 = 0x1.8469898cc5170p-52,
                   kPart3 = 0x1.b839a252049c1p-108;
  constexpr double kRound = 0x1.8p52;
  const double shifted = angle * (32.0 / std::numbers::pi) + kRound;
  const std::uint64_t j = std::bit_cast<std::uint64_t>(shifted) & 127;
  const double turns = shifted - kRound;
  const double after = angle - turns * kPart1, second = turns * kPart2;
  const double second_low = __builtin_fma(turns, kPart2, -second) + turns * kPart3;
  const TwoPart left = Sum(after, -second);
  const double b = left.high, b_low = left.low - second_low, b2 = b * b;
  // sin b - b and cos b - 1.
  const double sine_rest =
      b2 * b * (((b2 * (1.0 / 362880) - 1.0 / 5040) * b2 + 1.0 / 120) * b2 - 1.0 / 6);
  const double cosine_rest =
      b2 * (((b2 * (1.0 / 40320) - 1.0 / 720) * b2 + 1.0 / 24) * b2 - 1.0 / 2);
  const double s = t.sine[j], c = t.cosine[j], s_low = t.sine_low[j], c_low = t.cosine_low[j];
  const double cb = c * b, cb_low = __builtin_fma(c, b, -cb) + (c * b_low + c_low * b);
  const double sb = s * b, sb_low = __builtin_fma(s, b, -sb) + (s * b_low + s_low * b);
  const TwoPart sine = Sum(s, cb), cosine = Sum(c, -sb);
  return {
      SumOfLarger(sine.high, (s * cosine_rest + c * sine_rest) + (sine.low + cb_low + s_low)),
      SumOfLarger(cosine.high, (c * cosine_rest - s * sine_rest) + (cosine.low - sb_low + c_low))};
}

// What the library is asked for as RngStream::Normal asks it.
void OnePair(double u, double v, double* out) {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - u));
  const double angle = 2.0 * std::numbers::pi * v;
  out[0] = radius * std::cos(angle);
  out[1] = radius * std::sin(angle);
}

AG_INLINE void Chunk(const Tables& t, const double* uniform, int pairs, double* out) {
  double x[kChunk], angle[kChunk], log[kChunk], sine[kChunk], cosine[kChunk];
  std::uint64_t open[kChunk];
  const int padded = (pairs + 7) / 8 * 8;  // whole vectors
  for (int i = 0; i < padded; ++i) {
    const int at = i < pairs ? i : 0;
    x[i] = 1.0 - uniform[2 * at];
    angle[i] = 2.0 * std::numbers::pi * uniform[2 * at + 1];
  }
  for (int i = 0; i < padded; ++i) {
    const TwoPart of_log = Log(t, x[i]);
    const SineCosine turned = SinCos(t, angle[i]);
    log[i] = of_log.high;
    sine[i] = turned.sine.high;
    cosine[i] = turned.cosine.high;
    open[i] = static_cast<std::uint64_t>(IsOpen(of_log, kLogStretch)) |
              static_cast<std::uint64_t>(IsOpen(turned.sine, kTurnStretch) |
                                         IsOpen(turned.cosine, kTurnStretch))
                  << 1;
  }
  // Listed first: whether a number is open cannot be foretold, and a branch on it would cost as
  // much as the number.
  int logs = 0, turns = 0, open_log[kChunk], open_turn[kChunk];
  for (int i = 0; i < padded; ++i) {
    open_log[logs] = open_turn[turns] = i;
    logs += static_cast<int>(open[i] & 1);
    turns += static_cast<int>(open[i] >> 1);
  }
  for (int k = 0; k < logs; ++k) log[open_log[k]] = std::log(x[open_log[k]]);
  for (int k = 0; k < turns; ++k) {
    sine[open_turn[k]] = std::sin(angle[open_turn[k]]);
    cosine[open_turn[k]] = std::cos(angle[open_turn[k]]);
  }
  for (int i = 0; i < padded; ++i) {
    const double radius = std::sqrt(-2.0 * log[i]);
    sine[i] *= radius;
    cosine[i] *= radius;
  }
  for (int i = 0; i < pairs; ++i) {
    out[2 * i] = cosine[i];
    out[2 * i + 1] = sine[i];
  }
}

AG_INLINE void Uniforms(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key,
                        int blocks, double* out) {
  constexpr std::uint64_t kM0 = 0xD2511F53, kM1 = 0xCD9E8D57;
  std::uint32_t c[4][kChunk];
  const int padded = (blocks + 15) / 16 * 16;  // whole vectors
  const std::uint64_t first = counter[0] | static_cast<std::uint64_t>(counter[1]) << 32;
  for (int i = 0; i < padded; ++i) {
    const std::uint64_t number = first + static_cast<std::uint64_t>(i);
    c[0][i] = static_cast<std::uint32_t>(number);
    c[1][i] = static_cast<std::uint32_t>(number >> 32);
    c[2][i] = counter[2];
    c[3][i] = counter[3];
  }
  std::uint32_t k0 = key[0], k1 = key[1];
  for (int round = 0; round < 10; ++round) {
    for (int i = 0; i < padded; ++i) {
      const std::uint64_t p0 = kM0 * c[0][i], p1 = kM1 * c[2][i];
      c[0][i] = static_cast<std::uint32_t>(p1 >> 32) ^ c[1][i] ^ k0;
      c[1][i] = static_cast<std::uint32_t>(p1);
      c[2][i] = static_cast<std::uint32_t>(p0 >> 32) ^ c[3][i] ^ k1;
      c[3][i] = static_cast<std::uint32_t>(p0);
    }
    k0 += 0x9E3779B9;
    k1 += 0xBB67AE85;
  }
  for (int i = 0; i < blocks; ++i) {
    const std::uint64_t u = c[0][i] | static_cast<std::uint64_t>(c[1][i]) << 32;
    const std::uint64_t v = c[2][i] | static_cast<std::uint64_t>(c[3][i]) << 32;
    out[2 * i] = static_cast<double>(u >> 11) * 0x1.0p-53;
    out[2 * i + 1] = static_cast<double>(v >> 11) * 0x1.0p-53;
  }
}

struct Kernels {
  void (*chunk)(const Tables&, const double*, int, double*);
  void (*uniforms)(std::array<std::uint32_t, 4>, std::array<std::uint32_t, 2>, int, double*);
};

void PlainChunk(const Tables&, const double* uniform, int pairs, double* out) {
  for (int i = 0; i < pairs; ++i) OnePair(uniform[2 * i], uniform[2 * i + 1], out + 2 * i);
}
void PlainUniforms(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key,
                   int blocks, double* out) {
  Uniforms(counter, key, blocks, out);
}

#ifdef __x86_64__
#define AG_AVX2 __attribute__((target("avx2,fma")))
#define AG_AVX512 __attribute__((target("avx512f,avx512dq,avx512vl,fma,prefer-vector-width=512")))
AG_AVX2 void ChunkAvx2(const Tables& t, const double* uniform, int pairs, double* out) {
  Chunk(t, uniform, pairs, out);
}
AG_AVX2 void UniformsAvx2(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key,
                          int blocks, double* out) {
  Uniforms(counter, key, blocks, out);
}
AG_AVX512 void ChunkAvx512(const Tables& t, const double* uniform, int pairs, double* out) {
  Chunk(t, uniform, pairs, out);
}
AG_AVX512 void UniformsAvx512(std::array<std::uint32_t, 4> counter,
                              std::array<std::uint32_t, 2> key, int blocks, double* out) {
  Uniforms(counter, key, blocks, out);
}
#endif

Kernels Choose() {
#ifdef __x86_64__
  const bool fma = __builtin_cpu_supports("fma");
  if (fma && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl")) {
    return {ChunkAvx512, UniformsAvx512};
  }
  if (fma && __builtin_cpu_supports("avx2")) return {ChunkAvx2, UniformsAvx2};
#endif
  return {PlainChunk, PlainUniforms};
}

const Kernels& Chosen() {
  static const Kernels kernels = Choose();
  return kernels;
}

}  // namespace

void BoxMuller(const double* uniform, int pairs, double* out) {
  static const Tables tables = MakeTables();
  for (int done = 0; done < pairs; done += kChunk) {
    Chosen().chunk(tables, uniform + 2 * done, std::min(kChunk, pairs - done), out + 2 * done);
  }
}

void PhiloxUniforms(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key,
                    int blocks, double* out) {
  for (int done = 0; done < blocks; done += kChunk) {
    Chosen().uniforms(counter, key, std::min(kChunk, blocks - done), out + 2 * done);
    const std::uint64_t next = (counter[0] | static_cast<std::uint64_t>(counter[1]) << 32) + kChunk;
    counter[0] = static_cast<std::uint32_t>(next);
    counter[1] = static_cast<std::uint32_t>(next >> 32);
  }
}

}  // namespace antigrasp
