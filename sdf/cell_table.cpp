#include "antigrasp/sdf/cell_table.h"

#include <algorithm>
#include <limits>
#include <string>

#include "antigrasp/core/check.h"
#include "antigrasp/core/rng.h"
#include "antigrasp/sdf/cell_crossing.h"

namespace antigrasp {
namespace {

using Triangulation = std::vector<CellTriangle>;

constexpr int kUnit = 1000;  // integer length of a cell's edge
constexpr int kDraws = 4000;

int EdgeBetween(int corner_a, int corner_b) {
  for (int e = 0; e < kCellEdges; ++e) {
    const int low = CellEdgeLow(e), high = low + (1 << (e / 4));
    if (low == std::min(corner_a, corner_b) && high == std::max(corner_a, corner_b)) return e;
  }
  AG_CHECK(false, "not the corners of a cell edge");
}

// The corners of face (axis, side), counter-clockwise seen from outside the cell.
std::array<int, 4> FaceCorners(int axis, int side) {
  const int u = 1 << ((axis + 1) % 3), v = 1 << ((axis + 2) % 3), base = side << axis;
  if (side == 1) return {base, base + u, base + u + v, base + v};
  return {base, base + v, base + u + v, base + u};
}

// Bit mask of the two faces on which an edge lies; face = 2 * axis + side.
int FacesOf(int edge) {
  int mask = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (axis != edge / 4) mask |= 1 << (2 * axis + (CellEdgeLow(edge) >> axis & 1));
  }
  return mask;
}

// All triangulations of the loop's piece i..j, closed by the chord j-i.
std::vector<Triangulation> Triangulations(const CellLoop& loop, std::size_t i, std::size_t j) {
  if (j - i < 2) return {Triangulation{}};
  const auto chord_ok = [&](std::size_t a, std::size_t b) {
    const bool side = b - a == 1 || (a == 0 && b == loop.size() - 1);
    return side || !ShareCellFace(loop[a], loop[b]);
  };
  std::vector<Triangulation> all;
  for (std::size_t apex = i + 1; apex < j; ++apex) {
    if (!chord_ok(i, apex) || !chord_ok(apex, j)) continue;
    const auto left_pieces = Triangulations(loop, i, apex);
    const auto right_pieces = Triangulations(loop, apex, j);
    for (const Triangulation& left : left_pieces) {
      for (const Triangulation& right : right_pieces) {
        Triangulation joined = left;
        joined.insert(joined.end(), right.begin(), right.end());
        joined.push_back({loop[i], loop[apex], loop[j]});
        all.push_back(std::move(joined));
      }
    }
  }
  return all;
}

// Every combination of one triangulation for each loop.
std::vector<Triangulation> AllTriangulations(int cell_case) {
  std::vector<Triangulation> all = {{}};
  for (const CellLoop& loop : TraceCellLoops(cell_case)) {
    std::vector<Triangulation> longer;
    for (const Triangulation& head : all) {
      for (const Triangulation& tail : Triangulations(loop, 0, loop.size() - 1)) {
        longer.push_back(head);
        longer.back().insert(longer.back().end(), tail.begin(), tail.end());
      }
    }
    all = std::move(longer);
  }
  return all;
}

using Crossings = std::array<IntPoint, kCellEdges>;  // the vertex on each edge

Crossings CrossingsAt(const std::array<int, kCellEdges>& along) {
  Crossings points;
  for (int e = 0; e < kCellEdges; ++e) {
    const int low = CellEdgeLow(e);
    for (int a = 0; a < 3; ++a) points[e][a] = (low >> a & 1) * kUnit;
    points[e][e / 4] = along[e];
  }
  return points;
}

// Every fourth draw is uniform; the others favour the ends, where triangles come closest.
Crossings DrawCrossings(RngStream& rng, int draw) {
  constexpr std::array<int, 6> kSpecial = {1,         kUnit - 1, kUnit / 20, kUnit - kUnit / 20,
                                           kUnit / 2, 0};
  std::array<int, kCellEdges> along;
  for (int& t : along) {
    const int special = draw % 4 == 0 ? 0 : kSpecial[rng.Below(kSpecial.size())];
    t = special != 0 ? special : 1 + static_cast<int>(rng.Below(kUnit - 1));
  }
  return CrossingsAt(along);
}

bool IsEmbedded(const Triangulation& triangles, const Crossings& at) {
  std::vector<IntTriangle> solid;
  for (const CellTriangle& t : triangles) {
    solid.push_back({at[t[0]], at[t[1]], at[t[2]]});
    if (IsDegenerate(solid.back())) return false;
    for (std::size_t i = 0; i + 1 < solid.size(); ++i) {
      if (Crosses(solid[i], solid.back())) return false;
    }
  }
  return true;
}

// Four times the squared area of the smallest triangle with all crossings at the middle: the larger
// it is, the rounder the triangles.
std::int64_t SmallestArea(const Triangulation& triangles) {
  std::array<int, kCellEdges> middle;
  middle.fill(kUnit / 2);
  const Crossings at = CrossingsAt(middle);
  std::int64_t smallest = std::numeric_limits<std::int64_t>::max();
  for (const CellTriangle& t : triangles) {
    IntPoint u, v;
    for (int a = 0; a < 3; ++a) {
      u[a] = (at[t[1]][a] - at[t[0]][a]) / 10;
      v[a] = (at[t[2]][a] - at[t[0]][a]) / 10;
    }
    std::int64_t area = 0;
    for (int a = 0; a < 3; ++a) {
      const std::int64_t c = u[(a + 1) % 3] * v[(a + 2) % 3] - u[(a + 2) % 3] * v[(a + 1) % 3];
      area += c * c;
    }
    smallest = std::min(smallest, area);
  }
  return smallest;
}

Triangulation BestTriangulation(int cell_case) {
  std::vector<Triangulation> all = AllTriangulations(cell_case);
  std::stable_sort(all.begin(), all.end(), [](const Triangulation& a, const Triangulation& b) {
    return SmallestArea(a) > SmallestArea(b);
  });
  for (const Triangulation& candidate : all) {
    RngStream rng(0, "marching-cubes-table", static_cast<std::uint64_t>(cell_case));
    bool embedded = true;
    for (int draw = 0; draw < kDraws && embedded; ++draw) {
      embedded = IsEmbedded(candidate, DrawCrossings(rng, draw));
    }
    if (embedded) return candidate;
  }
  AG_CHECK(false, "no triangulation without crossings for case " + std::to_string(cell_case));
}

// One of the 24 rotations of the cell, as a map of corners.
using CornerMap = std::array<int, 8>;

std::vector<CornerMap> CellRotations() {
  std::vector<CornerMap> rotations;
  std::array<int, 3> axes = {0, 1, 2};
  int parity = 0;  // next_permutation visits the six in the parities + - - + + -
  constexpr std::array<int, 6> kParity = {0, 1, 1, 0, 0, 1};
  do {
    for (int flips = 0; flips < 8; ++flips) {
      const int flipped = (flips & 1) + (flips >> 1 & 1) + (flips >> 2 & 1);
      if ((flipped + kParity[parity]) % 2 != 0) continue;  // a reflection
      CornerMap map;
      for (int c = 0; c < 8; ++c) {
        int image = flips;
        for (int a = 0; a < 3; ++a) image ^= (c >> a & 1) << axes[a];
        map[c] = image;
      }
      rotations.push_back(map);
    }
    ++parity;
  } while (std::next_permutation(axes.begin(), axes.end()));
  return rotations;
}

int MapCase(const CornerMap& map, int cell_case) {
  int image = 0;
  for (int c = 0; c < 8; ++c) image |= (cell_case >> c & 1) << map[c];
  return image;
}

Triangulation MapTriangles(const CornerMap& map, Triangulation triangles) {
  for (CellTriangle& t : triangles) {
    for (std::uint8_t& e : t) {
      const int low = CellEdgeLow(e);
      e = static_cast<std::uint8_t>(EdgeBetween(map[low], map[low + (1 << (e / 4))]));
    }
  }
  return triangles;
}

// Only one case of each of the 23 rotation classes is searched; the others are its images.
std::array<std::vector<CellTriangle>, kCellCases> MakeTable() {
  std::array<std::vector<CellTriangle>, kCellCases> table;
  std::array<bool, kCellCases> done{};
  const std::vector<CornerMap> rotations = CellRotations();
  for (int c = 0; c < kCellCases; ++c) {
    if (done[c]) continue;
    const Triangulation best = BestTriangulation(c);
    for (const CornerMap& rotation : rotations) {
      const int image = MapCase(rotation, c);
      if (done[image]) continue;
      done[image] = true;
      table[image] = MapTriangles(rotation, best);
    }
  }
  return table;
}

}  // namespace

bool ShareCellFace(int edge_a, int edge_b) { return (FacesOf(edge_a) & FacesOf(edge_b)) != 0; }

std::vector<CellLoop> TraceCellLoops(int cell_case) {
  std::array<int, kCellEdges> next;
  next.fill(-1);
  for (int face = 0; face < 6; ++face) {
    const std::array<int, 4> corners = FaceCorners(face / 2, face % 2);
    const auto inside = [&](int i) { return (cell_case >> corners[i % 4] & 1) != 0; };
    for (int i = 0; i < 4; ++i) {
      if (inside(i) || !inside(i + 1)) continue;
      int last = i + 1;  // the run of inside corners i + 1 .. last
      while (inside(last + 1)) ++last;
      next[EdgeBetween(corners[i], corners[(i + 1) % 4])] =
          EdgeBetween(corners[last % 4], corners[(last + 1) % 4]);
    }
  }
  std::vector<CellLoop> loops;
  for (int start = 0; start < kCellEdges; ++start) {
    if (next[start] < 0) continue;
    CellLoop loop;
    for (int e = start; next[e] >= 0;) {
      loop.push_back(static_cast<std::uint8_t>(e));
      const int following = next[e];
      next[e] = -1;
      e = following;
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

const std::array<std::vector<CellTriangle>, kCellCases>& CellTable() {
  static const std::array<std::vector<CellTriangle>, kCellCases> table = MakeTable();
  return table;
}

}  // namespace antigrasp
