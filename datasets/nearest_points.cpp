#include "antigrasp/datasets/nearest_points.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace antigrasp {
namespace {

#define AG_INLINE inline __attribute__((always_inline))

constexpr std::size_t kBlock = PointSet::kBlock;
static_assert(PointSet::kGroup == kBlock);
constexpr float kNoDistance = std::numeric_limits<float>::infinity();

// Registers of `Bytes` bytes. GCC splits wider vectors itself, but then selects element by element.
template <int Bytes>
struct Lanes {
  typedef float Register __attribute__((vector_size(Bytes)));  // `using` would drop the size
  static constexpr std::size_t kWidth = Bytes / sizeof(float);
  static constexpr std::size_t kCount = kBlock / kWidth;
};

// Of kBlock numbers.
AG_INLINE float Largest(const float* of) {
  typedef float Four __attribute__((vector_size(16)));
  Four x[4];
  std::memcpy(x, of, sizeof x);
  for (const int i : {1, 2, 3}) x[0] = x[0] > x[i] ? x[0] : x[i];
  return std::max(std::max(x[0][0], x[0][1]), std::max(x[0][2], x[0][3]));
}

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
  return Largest(best);
}

// Whether the box of block `b` is nearer to one of the query's points than what that point has.
template <int Bytes, int D>
AG_INLINE bool CanLower(const typename PointBlocks<D>::Block& query,
                        const typename PointBlocks<D>::Boxes& boxes, std::size_t b,
                        const float* best) {
  using Register = typename Lanes<Bytes>::Register;
  float lower[kBlock];
  for (std::size_t r = 0; r < Lanes<Bytes>::kCount; ++r) {
    Register d{}, nearest;
    for (std::size_t k = 0; k < PointBlocks<D>::kSize; ++k) {
      Register at;
      std::memcpy(&at, query.at[k].data() + r * Lanes<Bytes>::kWidth, sizeof at);
      const Register above = boxes.low[k][b] - at, below = at - boxes.high[k][b];
      const Register wider = above > below ? above : below;
      const Register gap = wider > Register{} ? wider : Register{};
      d = d + gap * gap;
    }
    std::memcpy(&nearest, best + r * Lanes<Bytes>::kWidth, sizeof nearest);
    nearest = nearest - d;
    std::memcpy(lower + r * Lanes<Bytes>::kWidth, &nearest, sizeof nearest);
  }
  return Largest(lower) > 0.0f;
}

// Squared distances between the box of block `b` of `from` and kBlock boxes from `first` on. The
// same operations in the same order as for points: rounding keeps order, so no computed distance of
// two points is below the computed one of their boxes, nor that below the one of boxes around
// these, and leaving blocks out changes no bit.
template <int Bytes, int D>
AG_INLINE void BoxDistances(const typename PointBlocks<D>::Boxes& from, std::size_t b,
                            const typename PointBlocks<D>::Boxes& to, std::size_t first,
                            float* out) {
  using Register = typename Lanes<Bytes>::Register;
  constexpr std::size_t kWidth = Lanes<Bytes>::kWidth, kSize = PointBlocks<D>::kSize;
  for (std::size_t i = 0; i < kBlock; i += kWidth) {
    Register d{};
    for (std::size_t k = 0; k < kSize; ++k) {
      Register low, high;
      std::memcpy(&low, &to.low[k][first + i], sizeof low);
      std::memcpy(&high, &to.high[k][first + i], sizeof high);
      const Register above = low - from.high[k][b], below = from.low[k][b] - high;
      const Register wider = above > below ? above : below;
      const Register gap = wider > Register{} ? wider : Register{};
      d = d + gap * gap;  // of the first 0 + gap gap, which is gap gap
    }
    std::memcpy(out + i, &d, sizeof d);
  }
}

// Looks at the blocks of a group whose boxes are nearer than `worst`, which it lowers. Listed
// first: which they are cannot be foretold.
template <int Bytes, int D>
AG_INLINE float LookIntoGroup(const typename PointBlocks<D>::Block& query, const PointBlocks<D>& to,
                              std::size_t group, const float* boxes, float worst, float* best) {
  std::size_t near[kBlock], count = 0;
  for (std::size_t i = 0; i < kBlock; ++i) {
    near[count] = i;
    count += boxes[i] < worst ? 1 : 0;
  }
  for (std::size_t n = 0; n < count; ++n) {
    const std::size_t block = group * kBlock + near[n];
    if (!(boxes[near[n]] < worst) || !CanLower<Bytes, D>(query, to.boxes(), block, best)) continue;
    worst = LookAt<Bytes, D>(query, to.blocks()[block], best);
  }
  return worst;
}

template <int Bytes, int D>
AG_INLINE void Nearest(const PointBlocks<D>& from, const PointBlocks<D>& to, float* groups,
                       float* squared) {
  const std::size_t count = to.groups().low[0].size();
  for (std::size_t b = 0; b < from.blocks().size(); ++b) {
    const typename PointBlocks<D>::Block& query = from.blocks()[b];
    float* best = squared + b * kBlock;
    std::fill(best, best + kBlock, kNoDistance);
    for (std::size_t g = 0; g < count; g += kBlock) {
      BoxDistances<Bytes, D>(from.boxes(), b, to.groups(), g, groups + g);
    }
    // The nearest box of the nearest group first: it leaves little to do for the others.
    const auto first = static_cast<std::size_t>(std::min_element(groups, groups + count) - groups);
    float boxes[kBlock];
    BoxDistances<Bytes, D>(from.boxes(), b, to.boxes(), first * kBlock, boxes);
    const auto lane = static_cast<std::size_t>(std::min_element(boxes, boxes + kBlock) - boxes);
    float worst = LookAt<Bytes, D>(query, to.blocks()[first * kBlock + lane], best);
    boxes[lane] = kNoDistance;
    worst = LookIntoGroup<Bytes, D>(query, to, first, boxes, worst, best);
    for (std::size_t g = 0; g < count; ++g) {
      if (!(groups[g] < worst) || g == first) continue;
      BoxDistances<Bytes, D>(from.boxes(), b, to.boxes(), g * kBlock, boxes);
      worst = LookIntoGroup<Bytes, D>(query, to, g, boxes, worst, best);
    }
  }
}

template <int D>
void NearestBaseline(const PointBlocks<D>& from, const PointBlocks<D>& to, float* groups,
                     float* squared) {
  Nearest<16, D>(from, to, groups, squared);
}

#if defined(__x86_64__)
template <int D>
__attribute__((target("avx2"))) void NearestAvx2(const PointBlocks<D>& from,
                                                 const PointBlocks<D>& to, float* groups,
                                                 float* squared) {
  Nearest<32, D>(from, to, groups, squared);
}
template <int D>
__attribute__((target("avx512f,avx512dq,avx512vl,prefer-vector-width=512"))) void NearestAvx512(
    const PointBlocks<D>& from, const PointBlocks<D>& to, float* groups, float* squared) {
  Nearest<64, D>(from, to, groups, squared);
}
#endif

template <int D>
auto Choose() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl")) {
    return NearestAvx512<D>;
  }
  if (__builtin_cpu_supports("avx2")) return NearestAvx2<D>;
#endif
  return NearestBaseline<D>;
}

}  // namespace

template <int D>
void NearestSquared(const PointBlocks<D>& from, const PointBlocks<D>& to,
                    std::vector<float>* squared) {
  static const auto nearest = Choose<D>();
  thread_local std::vector<float> groups;
  groups.resize(to.groups().low[0].size());
  squared->resize(from.blocks().size() * kBlock);
  nearest(from, to, groups.data(), squared->data());
}

template void NearestSquared(const PointSet&, const PointSet&, std::vector<float>*);
template void NearestSquared(const OrientedPointSet&, const OrientedPointSet&, std::vector<float>*);

}  // namespace antigrasp
