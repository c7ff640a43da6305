#include "antigrasp/sdf/cell_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <set>

#include "antigrasp/core/rng.h"
#include "antigrasp/sdf/cell_crossing.h"

namespace antigrasp {
namespace {

bool CornerInside(int cell_case, int corner) { return (cell_case >> corner & 1) != 0; }

bool EdgeCrosses(int cell_case, int edge) {
  const int low = CellEdgeLow(edge);
  return CornerInside(cell_case, low) != CornerInside(cell_case, low + (1 << (edge / 4)));
}

std::vector<IntTriangle> Placed(const std::vector<CellTriangle>& triangles,
                                const std::array<int, kCellEdges>& along, int unit) {
  std::array<IntPoint, kCellEdges> at;
  for (int e = 0; e < kCellEdges; ++e) {
    for (int a = 0; a < 3; ++a) at[e][a] = (CellEdgeLow(e) >> a & 1) * unit;
    at[e][e / 4] = along[e];
  }
  std::vector<IntTriangle> placed;
  for (const CellTriangle& t : triangles) placed.push_back({at[t[0]], at[t[1]], at[t[2]]});
  return placed;
}

TEST(CellTable, EveryCaseUsesExactlyTheEdgesThatCrossTheSurface) {
  for (int c = 0; c < kCellCases; ++c) {
    std::set<int> used, expected;
    for (const CellTriangle& t : CellTable()[c]) used.insert(t.begin(), t.end());
    for (int e = 0; e < kCellEdges; ++e) {
      if (EdgeCrosses(c, e)) expected.insert(e);
    }
    EXPECT_EQ(used, expected) << "case " << c;
  }
}

TEST(CellTable, TrianglesAreDiscsBoundedByTheContours) {
  for (int c = 0; c < kCellCases; ++c) {
    std::set<std::pair<int, int>> contours;
    std::size_t triangles = 0;
    for (const CellLoop& loop : TraceCellLoops(c)) {
      ASSERT_GE(loop.size(), 3U) << "case " << c;
      triangles += loop.size() - 2;  // of a disc
      for (std::size_t i = 0; i < loop.size(); ++i) {
        contours.insert({loop[i], loop[(i + 1) % loop.size()]});
      }
    }
    EXPECT_EQ(CellTable()[c].size(), triangles) << "case " << c;
    std::map<std::pair<int, int>, int> directed;
    for (const CellTriangle& t : CellTable()[c]) {
      for (std::size_t i = 0; i < 3; ++i) ++directed[{t[i], t[(i + 1) % 3]}];
    }
    for (const auto& [edge, count] : directed) {
      EXPECT_EQ(count, 1) << "case " << c;
      const bool inner = directed.count({edge.second, edge.first}) == 1;
      EXPECT_NE(inner, contours.count(edge) == 1) << "case " << c;
      if (inner) {
        EXPECT_FALSE(ShareCellFace(edge.first, edge.second)) << "case " << c;
      }
    }
  }
}

TEST(CellTable, TrianglesPointFromInsideToOutside) {
  std::array<int, kCellEdges> middle;
  middle.fill(1);
  for (int corner = 0; corner < 8; ++corner) {
    const IntPoint at = {2 * (corner & 1), 2 * (corner >> 1 & 1), 2 * (corner >> 2 & 1)};
    const auto only = Placed(CellTable()[1 << corner], middle, 2);
    ASSERT_EQ(only.size(), 1U);
    EXPECT_LT(Orient(only[0][0], only[0][1], only[0][2], at), 0) << "corner " << corner;
    const auto all_but = Placed(CellTable()[255 ^ (1 << corner)], middle, 2);
    ASSERT_EQ(all_but.size(), 1U);
    EXPECT_GT(Orient(all_but[0][0], all_but[0][1], all_but[0][2], at), 0) << "corner " << corner;
  }
}

TEST(CellTable, OppositeInsideCornersOfAFaceAreSeparated) {
  const auto loops = TraceCellLoops(1 << 0 | 1 << 3);  // (0,0,0) and (1,1,0)
  EXPECT_EQ(loops.size(), 2U);
  EXPECT_EQ(TraceCellLoops(255 ^ (1 << 0 | 1 << 3)).size(), 1U);  // outside corners are joined
}

// Edges along x are 0 to 3, along y 4 to 7, along z 8 to 11. Scores of saved grids follow from
// the diagonals chosen here.
TEST(CellTable, ChoosesTheSameDiagonalsAlways) {
  using Triangles = std::vector<CellTriangle>;
  EXPECT_EQ(CellTable()[0], Triangles{});
  EXPECT_EQ(CellTable()[1], (Triangles{{0, 4, 8}}));
  EXPECT_EQ(CellTable()[254], (Triangles{{0, 8, 4}}));
  EXPECT_EQ(CellTable()[7], (Triangles{{1, 10, 8}, {8, 9, 6}, {1, 8, 6}}));  // the roundest
  EXPECT_EQ(CellTable()[15], (Triangles{{9, 11, 10}, {8, 9, 10}}));
  EXPECT_EQ(CellTable()[23], (Triangles{{2, 9, 6}, {5, 2, 6}, {10, 5, 6}, {1, 10, 6}}));
  EXPECT_EQ(CellTable()[51], (Triangles{{4, 5, 7}, {6, 4, 7}}));
  EXPECT_EQ(CellTable()[105], (Triangles{{0, 4, 8}, {1, 6, 11}, {2, 7, 9}, {3, 5, 10}}));
  // And all of it: FNV-1a over the number of triangles and the edges of every case.
  std::uint64_t hash = 0xcbf29ce484222325U;
  const auto take = [&](std::size_t value) { hash = (hash ^ value) * 0x100000001b3U; };
  for (const auto& triangles : CellTable()) {
    take(triangles.size());
    for (const CellTriangle& t : triangles) std::for_each(t.begin(), t.end(), take);
  }
  EXPECT_EQ(hash, 0x1364a7a069040471U);
}

// Other draws than those that chose the table, and exact arithmetic.
TEST(CellTable, TrianglesOfACellNeverTouchWhereverTheCrossingsLie) {
  constexpr int kUnit = 1000;
  RngStream rng(99, "cell-table-test");
  for (int draw = 0; draw < 1500; ++draw) {
    std::array<int, kCellEdges> along;
    for (int& t : along) {
      const auto kind = rng.Below(3);
      const int uniform = 1 + static_cast<int>(rng.Below(kUnit - 1));
      t = kind == 0 ? uniform : kind == 1 ? 1 + uniform / 100 : kUnit - 1 - uniform / 100;
    }
    for (int c = 0; c < kCellCases; ++c) {
      const auto placed = Placed(CellTable()[c], along, kUnit);
      for (std::size_t i = 0; i < placed.size(); ++i) {
        ASSERT_FALSE(IsDegenerate(placed[i])) << "case " << c;
        for (std::size_t j = 0; j < i; ++j) {
          ASSERT_FALSE(Crosses(placed[i], placed[j])) << "case " << c;
        }
      }
    }
  }
}

TEST(CellCrossing, KnownPairsOfTriangles) {
  const IntTriangle flat = {IntPoint{0, 0, 0}, IntPoint{10, 0, 0}, IntPoint{0, 10, 0}};
  const IntTriangle piercing = {IntPoint{2, 2, -5}, IntPoint{2, 2, 5}, IntPoint{20, 20, 5}};
  const IntTriangle above = {IntPoint{0, 0, 1}, IntPoint{10, 0, 1}, IntPoint{0, 10, 1}};
  const IntTriangle touching = {IntPoint{2, 2, 0}, IntPoint{2, 2, 5}, IntPoint{20, 20, 5}};
  const IntTriangle corner_only = {IntPoint{0, 0, 0}, IntPoint{-5, 0, 3}, IntPoint{0, -5, 3}};
  const IntTriangle corner_and_more = {IntPoint{0, 0, 0}, IntPoint{2, 3, -3}, IntPoint{4, 3, 3}};
  const IntTriangle neighbour = {IntPoint{10, 0, 0}, IntPoint{0, 0, 0}, IntPoint{5, -5, 0}};
  const IntTriangle folded = {IntPoint{10, 0, 0}, IntPoint{0, 0, 0}, IntPoint{5, 2, 0}};
  const IntTriangle coplanar_apart = {IntPoint{20, 0, 0}, IntPoint{30, 0, 0}, IntPoint{20, 9, 0}};
  EXPECT_TRUE(Crosses(flat, piercing));
  EXPECT_FALSE(Crosses(flat, above));
  EXPECT_TRUE(Crosses(flat, touching));
  EXPECT_FALSE(Crosses(flat, corner_only));
  EXPECT_TRUE(Crosses(flat, corner_and_more));
  EXPECT_FALSE(Crosses(flat, neighbour));
  EXPECT_TRUE(Crosses(flat, folded));
  EXPECT_FALSE(Crosses(flat, coplanar_apart));
  EXPECT_TRUE(Crosses(flat, flat));
  EXPECT_TRUE(IsDegenerate({IntPoint{0, 0, 0}, IntPoint{1, 1, 1}, IntPoint{3, 3, 3}}));
}

}  // namespace
}  // namespace antigrasp
