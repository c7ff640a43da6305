#include "antigrasp/datasets/nearest_points.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace antigrasp {
namespace {

#define AG_INLINE inline __attribute__((always_inline))

constexpr std::size_t kBlock = PointSet::kBlock;

// Registers of `Bytes` bytes. GCC splits wider vectors itself, but then selects element by element.
template <int Bytes>
struct Lanes {
  typedef float Register __attribute__((vector_size(Bytes)));  // `using` would drop the size
  static constexpr std::size_t kWidth = Bytes / sizeof(float);
  static constexpr std::size_t kCount = kBlock / kWidth;
};

// Lowers `best` to the squared distances from the lanes of `query` to the points of `block`, and
// returns the largest of them.
template <int Bytes, int D>
AG_INLINE float LookAt(const typename PointBlocks<D>::Block& query,
                       const typename PointBlocks<D>::Block& block, float* best) {
  using Register = typename Lanes<Bytes>::Register;
  constexpr std::size_t kCount = Lanes<Bytes>::kCount, kSize = PointBlocks<D>::kSize;
  static_assert(sizeof(Register) == Bytes);
  Register at[kSize][kCount], nearest[kCount];
  std::memcpy(at, query.at.data(), sizeof at);
  std::memcpy(nearest, best, sizeof nearest);
  for (std::size_t j = 0; j < kBlock; ++j) {
    for (std::size_t r = 0; r < kCount; ++r) {
      Register d = at[0][r] - block.at[0][j];
      d = d * d;
      for (std::size_t k = 1; k < kSize; ++k) {
        const Register step = at[k][r] - block.at[k][j];
        d = d + step * step;
      }
      nearest[r] = d < nearest[r] ? d : nearest[r];
    }
  }
  std::memcpy(best, nearest, sizeof nearest);
  for (std::size_t r = 1; r < kCount; ++r) {
    nearest[0] = nearest[0] < nearest[r] ? nearest[r] : nearest[0];
  }
  float worst = nearest[0][0];
  for (std::size_t lane = 1; lane < Lanes<Bytes>::kWidth; ++lane) {
    worst = std::max(worst, nearest[0][lane]);
  }
  return worst;
}

// Squared distance between the box of block `b` of `from` and every box of `to`, the smallest of
// them first in `first`. The same operations in the same order as for points: rounding keeps order,
// so no computed distance of two points is below the computed one of their boxes, and leaving
// blocks out changes no bit.
template <int Bytes, int D>
AG_INLINE std::size_t BoxDistances(const typename PointBlocks<D>::Boxes& from, std::size_t b,
                                   const typename PointBlocks<D>::Boxes& to, float* out) {
  using Register = typename Lanes<Bytes>::Register;
  constexpr std::size_t kWidth = Lanes<Bytes>::kWidth, kSize = PointBlocks<D>::kSize;
  const std::size_t padded = to.low[0].size();
  Register smallest = std::numeric_limits<float>::infinity() - Register{};
  for (std::size_t i = 0; i < padded; i += kWidth) {
    Register d{};
    for (std::size_t k = 0; k < kSize; ++k) {
      Register low, high;
      std::memcpy(&low, &to.low[k][i], sizeof low);
      std::memcpy(&high, &to.high[k][i], sizeof high);
      const Register above = low - from.high[k][b], below = from.low[k][b] - high;
      const Register wider = above > below ? above : below;
      const Register gap = wider > Register{} ? wider : Register{};
      d = d + gap * gap;  // of the first 0 + gap gap, which is gap gap
    }
    smallest = d < smallest ? d : smallest;
    std::memcpy(out + i, &d, sizeof d);
  }
  float least = smallest[0];
  for (std::size_t lane = 1; lane < kWidth; ++lane) least = std::min(least, smallest[lane]);
  std::size_t first = 0;
  while (out[first] != least) ++first;
  return first;
}

template <int Bytes, int D>
AG_INLINE void Nearest(const PointBlocks<D>& from, const PointBlocks<D>& to, float* boxes,
                       float* squared) {
  const std::size_t count = to.blocks().size();
  for (std::size_t b = 0; b < from.blocks().size(); ++b) {
    const typename PointBlocks<D>::Block& query = from.blocks()[b];
    float* best = squared + b * kBlock;
    std::fill(best, best + kBlock, std::numeric_limits<float>::infinity());
    const std::size_t first = BoxDistances<Bytes, D>(from.boxes(), b, to.boxes(), boxes);
    // The nearest box first: it leaves little to do for the others.
    float worst = LookAt<Bytes, D>(query, to.blocks()[first], best);
    for (std::size_t i = 0; i < count; ++i) {
      if (boxes[i] < worst && i != first) worst = LookAt<Bytes, D>(query, to.blocks()[i], best);
    }
  }
}

template <int D>
void NearestBaseline(const PointBlocks<D>& from, const PointBlocks<D>& to, float* boxes,
                     float* squared) {
  Nearest<16, D>(from, to, boxes, squared);
}

#if defined(__x86_64__)
template <int D>
__attribute__((target("avx2"))) void NearestAvx2(const PointBlocks<D>& from,
                                                 const PointBlocks<D>& to, float* boxes,
                                                 float* squared) {
  Nearest<32, D>(from, to, boxes, squared);
}
#endif

template <int D>
auto Choose() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) return NearestAvx2<D>;
#endif
  return NearestBaseline<D>;
}

}  // namespace

template <int D>
void NearestSquared(const PointBlocks<D>& from, const PointBlocks<D>& to,
                    std::vector<float>* squared) {
  static const auto nearest = Choose<D>();
  thread_local std::vector<float> boxes;
  boxes.resize(to.boxes().low[0].size());
  squared->resize(from.blocks().size() * kBlock);
  nearest(from, to, boxes.data(), squared->data());
}

template void NearestSquared(const PointSet&, const PointSet&, std::vector<float>*);
template void NearestSquared(const OrientedPointSet&, const OrientedPointSet&, std::vector<float>*);

}  // namespace antigrasp
