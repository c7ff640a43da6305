#include "antigrasp/models/turned_rows.h"

#include <array>
#include <cmath>
#include <vector>

#ifdef __x86_64__
#define ANTIGRASP_TURNED_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define ANTIGRASP_TURNED_CLONES
#endif

namespace antigrasp::turned {
namespace {

constexpr std::int64_t kHeights = 16;  // nodes taken at once
constexpr float kShort = 1e-12F;       // squared; a shorter piece is its first point
constexpr float kNear = 1e-9F;         // of a distance that is divided by
constexpr float kFar = 1e9F;           // farther than any distance

inline __attribute__((always_inline)) float Within(float t) {
  t = t > 0.0F ? t : 0.0F;
  return t < 1.0F ? t : 1.0F;
}

// A piece of the outline, as its points' sums are needed.
struct Piece {
  __attribute__((always_inline)) explicit Piece(const float* p)
      : radius(p[0]), z(p[1]), along_radius(p[2] - p[0]), along_z(p[3] - p[1]), top(p[3]) {
    const float squared = along_radius * along_radius + along_z * along_z;
    inverse = squared > kShort ? 1.0F / squared : 0.0F;
    slope = along_z != 0.0F ? along_radius / along_z : 0.0F;
  }
  float radius, z, along_radius, along_z, top, inverse, slope;
};

// In the order of distances: across, along half a side, b >= a.
std::int64_t RadiusIndex(std::int64_t x, std::int64_t y, std::int64_t r) {
  const std::int64_t h = r / 2, i = x < h ? h - 1 - x : x - h, j = y < h ? h - 1 - y : y - h;
  const std::int64_t a = i < j ? i : j, b = i < j ? j : i;
  return b * (b + 1) / 2 + a;
}

std::vector<float> RadiiOf(const Outline& outline) {
  std::vector<float> radii;
  const float* half = outline.x + outline.r / 2;
  for (std::int64_t b = 0; b < outline.r / 2; ++b) {
    for (std::int64_t a = 0; a <= b; ++a) {
      radii.push_back(std::sqrt(half[a] * half[a] + half[b] * half[b]));
    }
  }
  return radii;
}

}  // namespace

ANTIGRASP_TURNED_CLONES void Distances(const Outline& outline, float* distances,
                                       std::int16_t* nearest) {
  const std::vector<float> radii = RadiiOf(outline);
  std::vector<Piece> pieces;
  for (std::int64_t k = 0; k + 1 < outline.count; ++k) {
    pieces.emplace_back(outline.points + 2 * k);
  }
  const auto count = static_cast<std::int32_t>(pieces.size());
  for (std::size_t c = 0; c < radii.size(); ++c) {
    const float radius = radii[c];
    for (std::int64_t first = 0; first < outline.r; first += kHeights) {
      const float* z = outline.x + first;
      std::array<float, kHeights> best;
      std::array<std::int32_t, kHeights> which{}, crossings{};
      best.fill(kFar);
      for (std::int32_t k = 0; k < count; ++k) {
        const Piece& p = pieces[k];
        const float from = radius - p.radius, along = from * p.along_radius;
        for (std::int64_t i = 0; i < kHeights; ++i) {
          const float up = z[i] - p.z;
          const float t = Within((along + up * p.along_z) * p.inverse);
          const float dr = from - t * p.along_radius, dz = up - t * p.along_z;
          const float squared = dr * dr + dz * dz;
          which[i] = squared < best[i] ? k : which[i];
          best[i] = squared < best[i] ? squared : best[i];
          const bool spans = (p.z > z[i]) != (p.top > z[i]);
          crossings[i] += spans & (up * p.slope > from) ? 1 : 0;
        }
      }
      for (std::int64_t i = 0; i < kHeights; ++i) {
        const std::int64_t at = static_cast<std::int64_t>(c) * outline.r + first + i;
        const float distance = std::sqrt(best[i]);
        distances[at] = (crossings[i] & 1) != 0 ? distance : -distance;
        nearest[at] = static_cast<std::int16_t>(which[i]);
      }
    }
  }
}

void Spread(const float* distances, std::int64_t r, float* values) {
  for (std::int64_t y = 0; y < r; ++y) {
    for (std::int64_t x = 0; x < r; ++x) {
      const float* column = distances + RadiusIndex(x, y, r) * r;
      for (std::int64_t z = 0; z < r; ++z) values[(z * r + y) * r + x] = column[z];
    }
  }
}

void AddGradient(const Outline& outline, const float* by_value, const float* distances,
                 const std::int16_t* nearest, float* gradient) {
  const std::int64_t r = outline.r;
  std::vector<float> sums(static_cast<std::size_t>(Radii(r) * r));
  for (std::int64_t z = 0; z < r; ++z) {
    for (std::int64_t y = 0; y < r; ++y) {
      for (std::int64_t x = 0; x < r; ++x) {
        sums[RadiusIndex(x, y, r) * r + z] += by_value[(z * r + y) * r + x];
      }
    }
  }
  const std::vector<float> radii = RadiiOf(outline);
  for (std::size_t at = 0; at < sums.size(); ++at) {
    if (sums[at] == 0.0F) continue;
    const Piece p(outline.points + 2 * nearest[at]);
    const float from = radii[at / r] - p.radius, up = outline.x[at % r] - p.z;
    const float t = Within((from * p.along_radius + up * p.along_z) * p.inverse);
    // The nearest place of a piece moves with its ends; that it also slides along adds nothing.
    const float size = std::fabs(distances[at]) > kNear ? distances[at] : kNear;
    const float by = -sums[at] / size;
    const float by_radius = by * (from - t * p.along_radius), by_z = by * (up - t * p.along_z);
    float* ends = gradient + 2 * nearest[at];
    ends[0] += (1.0F - t) * by_radius;
    ends[1] += (1.0F - t) * by_z;
    ends[2] += t * by_radius;
    ends[3] += t * by_z;
  }
}

}  // namespace antigrasp::turned
