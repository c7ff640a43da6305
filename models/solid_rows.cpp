#include "antigrasp/models/solid_rows.h"

#include <array>
#include <cmath>

#include "antigrasp/models/solid_field.h"

#define ANTIGRASP_ROWS_INLINE __attribute__((always_inline)) inline
#ifdef __x86_64__
#define ANTIGRASP_ROWS_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define ANTIGRASP_ROWS_CLONES
#endif

namespace antigrasp::solid {
namespace {

constexpr float kLeast = 1e-9F;  // of a length that is divided by

using Lanes = std::array<float, kLanes>;

ANTIGRASP_ROWS_INLINE float Greater(float a, float b) { return a > b ? a : b; }
ANTIGRASP_ROWS_INLINE float Smaller(float a, float b) { return a < b ? a : b; }

struct Row {  // nodes (x[0] ... x[kLanes - 1], y, z)
  const float* x;
  float y, z;
};

// A part, and a row's nodes in its frame but for what x adds.
struct Part {
  ANTIGRASP_ROWS_INLINE Part(const float* p, const Row& row)
      : u(p[1] * row.y + p[2] * row.z - p[kPartCentre]),
        v(p[4] * row.y + p[5] * row.z - p[kPartCentre + 1]),
        w(p[7] * row.y + p[8] * row.z - p[kPartCentre + 2]),
        xu(p[0]),
        xv(p[3]),
        xw(p[6]),
        half_u(p[kPartHalf]),
        half_v(p[kPartHalf + 1]),
        half_w(p[kPartHalf + 2]),
        round(p[kPartRound]),
        lean_u(p[kPartLean]),
        lean_v(p[kPartLean + 1]),
        fillet(p[kPartFillet]),
        narrow(p[kPartNarrow]) {}
  float u, v, w, xu, xv, xw, half_u, half_v, half_w, round, lean_u, lean_v, fillet, narrow;
};

// A node in a part's frame, and what its distance is made of: du and dv to the rounded corners'
// middles, from there the section's distance, ds and dw to the middle of the rounded edge.
struct Place {
  ANTIGRASP_ROWS_INLINE Place(const Part& p, float x)
      : u(p.xu * x + p.u),
        v(p.xv * x + p.v),
        w(p.xw * x + p.w),
        a(p.half_u + p.lean_u * w),
        b(p.half_v + p.lean_v * w),
        least(Smaller(a, b)),
        r(p.round * least),
        du(std::fabs(u) - a + r),
        dv(std::fabs(v) - b + r),
        pu(Greater(du, 0.0F)),
        pv(Greater(dv, 0.0F)),
        corner(std::sqrt(pu * pu + pv * pv)),
        section(corner + Smaller(Greater(du, dv), 0.0F) - r),
        ds(p.narrow * section + p.fillet),
        dw(std::fabs(w) - p.half_w + p.fillet),
        ps(Greater(ds, 0.0F)),
        pw(Greater(dw, 0.0F)),
        edge(std::sqrt(ps * ps + pw * pw)),
        distance(edge + Smaller(Greater(ds, dw), 0.0F) - p.fillet) {}
  float u, v, w, a, b, least, r, du, dv, pu, pv, corner, section, ds, dw, ps, pw, edge, distance;
};

ANTIGRASP_ROWS_INLINE void Distances(const float* part, const Row& row, Lanes* distances) {
  const Part p(part, row);
  for (int i = 0; i < kLanes; ++i) (*distances)[i] = Place(p, row.x[i]).distance;
}

// What a row adds to the gradient of a part, by half of PartColumn: the frame's three coordinates,
// each alone and times x, then kPartHalf and on.
enum Sum { kU, kXu, kV, kXv, kW, kXw, kColumns, kSums = kColumns + kPartColumns - kPartHalf };

// `by_distance`: 0 where another part is nearer. Back through Place, from its end to its beginning.
ANTIGRASP_ROWS_INLINE void AddRow(const float* part, const Row& row, const Lanes& by_distance,
                                  float* gradient) {
  const Part p(part, row);
  std::array<Lanes, kSums> sums;
  for (int i = 0; i < kLanes; ++i) {
    const float x = row.x[i], g = by_distance[i];
    const Place at(p, x);
    const float within = Greater(at.ds, at.dw) < 0.0F ? 1.0F : 0.0F;
    const float wall = at.ds > at.dw ? within : 0.0F;
    const float by_edge = (1.0F - within) / Greater(at.edge, kLeast);
    const float gs = g * (wall + by_edge * at.ps), gw = g * (within - wall + by_edge * at.pw);
    const float gn = gs * p.narrow;
    const float section_within = Greater(at.du, at.dv) < 0.0F ? 1.0F : 0.0F;
    const float side = at.du > at.dv ? section_within : 0.0F;
    const float by_corner = (1.0F - section_within) / Greater(at.corner, kLeast);
    const float gu = gn * (side + by_corner * at.pu);
    const float gv = gn * (section_within - side + by_corner * at.pv);
    const float gr = gu + gv - gn, gl = gr * p.round, ga_least = at.a < at.b ? gl : 0.0F;
    const float ga = ga_least - gu, gb = gl - ga_least - gv;
    const float u = at.u < 0.0F ? -gu : gu, v = at.v < 0.0F ? -gv : gv;
    const float w = (at.w < 0.0F ? -gw : gw) + ga * p.lean_u + gb * p.lean_v;
    sums[kU][i] = u;
    sums[kXu][i] = u * x;
    sums[kV][i] = v;
    sums[kXv][i] = v * x;
    sums[kW][i] = w;
    sums[kXw][i] = w * x;
    sums[kColumns][i] = ga;
    sums[kColumns + 1][i] = gb;
    sums[kColumns + 2][i] = -gw;
    sums[kColumns + 3][i] = gr * at.least;
    sums[kColumns + 4][i] = ga * at.w;
    sums[kColumns + 5][i] = gb * at.w;
    sums[kColumns + 6][i] = gs + gw - g;
    sums[kColumns + 7][i] = gs * at.section;
  }
  for (Lanes& lanes : sums) {  // in a fixed order, whatever the vectors are
    for (std::int64_t half = kLanes / 2; half > 0; half /= 2) {
      for (std::int64_t i = 0; i < half; ++i) lanes[i] += lanes[i + half];
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    gradient[3 * axis] += sums[2 * axis + 1][0];
    gradient[3 * axis + 1] += row.y * sums[2 * axis][0];
    gradient[3 * axis + 2] += row.z * sums[2 * axis][0];
    gradient[kPartCentre + axis] -= sums[2 * axis][0];
  }
  for (int j = kColumns; j < kSums; ++j) gradient[kPartHalf + j - kColumns] += sums[j][0];
}

// Calls visit(row, where its first node lies in the grid).
template <typename Visit>
ANTIGRASP_ROWS_INLINE void ForRows(const Solid& solid, const Visit& visit) {
  const std::int64_t r = solid.r;
  for (std::int64_t z = 0; z < r; ++z) {
    for (std::int64_t y = 0; y < r; ++y) {
      for (std::int64_t x = 0; x < r; x += kLanes) {
        visit(Row{solid.x + x, solid.x[y], solid.x[z]}, (z * r + y) * r + x);
      }
    }
  }
}

}  // namespace

ANTIGRASP_ROWS_CLONES void Union(const Solid& solid, float* values, std::uint8_t* nearest) {
  ForRows(
      solid, [&](const Row& row, std::int64_t first) __attribute__((always_inline)) {
        Lanes best, distances;
        std::array<std::int32_t, kLanes> which{};
        Distances(solid.parts, row, &best);
        for (std::int32_t m = 1; m < solid.count; ++m) {
          Distances(solid.parts + m * kPartColumns, row, &distances);
          for (int i = 0; i < kLanes; ++i) {
            which[i] = distances[i] < best[i] ? m : which[i];
            best[i] = Smaller(distances[i], best[i]);
          }
        }
        for (int i = 0; i < kLanes; ++i) {
          values[first + i] = -best[i];
          nearest[first + i] = static_cast<std::uint8_t>(which[i]);
        }
      });
}

ANTIGRASP_ROWS_CLONES void AddUnionGradient(const Solid& solid, const float* by_value,
                                            const std::uint8_t* nearest, float* gradient) {
  ForRows(
      solid, [&](const Row& row, std::int64_t first) __attribute__((always_inline)) {
        std::uint32_t seen = 0;
        for (int i = 0; i < kLanes; ++i) {
          if (by_value[first + i] != 0.0F) seen |= 1U << nearest[first + i];
        }
        for (std::int64_t m = 0; m < solid.count; ++m) {
          if ((seen >> m & 1U) == 0) continue;
          Lanes own;
          for (int i = 0; i < kLanes; ++i) {
            own[i] = nearest[first + i] == m ? -by_value[first + i] : 0.0F;
          }
          AddRow(solid.parts + m * kPartColumns, row, own, gradient + m * kPartColumns);
        }
      });
}

}  // namespace antigrasp::solid
