#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "antigrasp/core/rng.h"
#include "antigrasp/mesh/mesh_union.h"
#include "antigrasp/mesh/nesting.h"
#include "antigrasp/mesh/repair.h"
#include "tests/support/shapes.h"

// Meshes of several pieces: voids, parts that were never united, faces that cancel, torn seams.
namespace antigrasp {
namespace {

using Eigen::Vector3d;
using shapes::Box;
using shapes::Inverted;
using shapes::Joined;

TriangleMesh BoxAt(const Vector3d& low, const Vector3d& high) {
  return Transformed(Box(high - low), 1.0, 0.5 * (low + high));
}

// A block of 4 x 4 x 10 on z = 0, and the void of 3 x 3 x 6 in its upper part, facing outward.
const TriangleMesh kBlock = BoxAt({-2, -2, 0}, {2, 2, 10});
const TriangleMesh kVoid = BoxAt({-1.5, -1.5, 3.5}, {1.5, 1.5, 9.5});

Pieces PiecesOfSix(const TriangleMesh& mesh) {  // boxes of twelve faces
  Pieces pieces;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    pieces.of_face.push_back(static_cast<std::int32_t>(f / 12));
  }
  pieces.count = static_cast<std::int32_t>(mesh.faces.size() / 12);
  return pieces;
}

TEST(RepairParts, AVoidIsMissingMatterHoweverItIsWound) {
  for (const TriangleMesh& inner : {kVoid, Inverted(kVoid)}) {
    for (const TriangleMesh& outer : {kBlock, Inverted(kBlock)}) {
      const RepairResult result = Repair(Joined(outer, inner));
      EXPECT_TRUE(result.accepted()) << result.refusal;
      EXPECT_TRUE(result.report.IsSolid() && result.report.outward);
      EXPECT_EQ(result.report.components, 2);
      EXPECT_EQ(result.report.voids, 1);
      EXPECT_DOUBLE_EQ(result.report.volume, 160.0 - 54.0);
      EXPECT_NEAR(result.report.center_of_mass.z(), (160.0 * 5.0 - 54.0 * 6.5) / 106.0, 1e-12);
    }
  }
  EXPECT_TRUE(Repair(Joined(kBlock, Inverted(kVoid))).actions.empty());
  EXPECT_EQ(Repair(Joined(kBlock, kVoid)).actions,
            std::vector<std::string>{"turned 12 wrongly wound faces"});
  EXPECT_EQ(Repair(Joined(Inverted(kBlock), kVoid)).actions,
            std::vector<std::string>{"turned inside out"});
}

TEST(RepairParts, ABodyInAVoidIsASecondBody) {
  const TriangleMesh hollow = Joined(kBlock, Inverted(kVoid));
  const RepairResult result = Repair(Joined(hollow, BoxAt({-1, -1, 5}, {1, 1, 6})));
  EXPECT_EQ(result.refusal, "disjoint pieces: 2");
  EXPECT_EQ(result.report.components, 3);
  EXPECT_EQ(result.report.voids, 1);
  EXPECT_DOUBLE_EQ(result.report.volume, 160.0 - 54.0 + 4.0);
}

TEST(RepairParts, AnUnturnedVoidIsNamedWhereNothingIsRepaired) {
  const MeshReport report = Inspect(Joined(kBlock, kVoid));
  EXPECT_EQ(report.voids, 1);
  EXPECT_FALSE(report.outward || report.IsSolid());
  EXPECT_EQ(WhyNotSolid(report), "inside-out: a body or a void faces the wrong way");
}

TEST(NestingDepths, CountsTheBoxesAroundEveryBox) {
  TriangleMesh dolls;
  const std::vector<int> depths{3, 0, 4, 1, 2};  // in an order of no meaning
  for (const int depth : depths) dolls = Joined(dolls, Box(Vector3d::Constant(9.0 - depth)));
  dolls = Joined(dolls, BoxAt({20, 0, 0}, {21, 1, 1}));
  dolls = Joined(dolls, Inverted(BoxAt({20.25, 0.25, 0.25}, {20.75, 0.75, 0.75})));
  EXPECT_EQ(NestingDepths(dolls, PiecesOfSix(dolls)), (std::vector<int>{3, 0, 4, 1, 2, 0, 1}));
}

// The wall is as thin as two neighbouring doubles are apart, and the way out may hit any edge.
TEST(NestingDepths, AreExactBehindTheThinnestWall) {
  const double inside = std::nextafter(1.0, 0.0);
  const TriangleMesh shell = Joined(BoxAt({-1, -1, -1}, {1, 1, 1}),
                                    BoxAt({-inside, -inside, -inside}, {inside, inside, inside}));
  EXPECT_EQ(NestingDepths(shell, PiecesOfSix(shell)), (std::vector<int>{0, 1}));
}

TEST(NestingDepths, TheHoleOfARingIsOutside) {
  const TriangleMesh ring = shapes::Torus(2.0, 0.5, 24, 12);
  TriangleMesh both = Joined(ring, Box({0.2, 0.2, 0.2}));
  Pieces pieces;
  pieces.count = 2;
  pieces.of_face.assign(ring.faces.size(), 0);
  pieces.of_face.resize(both.faces.size(), 1);
  EXPECT_EQ(NestingDepths(both, pieces), (std::vector<int>{0, 0}));
  const TriangleMesh in_tube = Transformed(Box({0.2, 0.2, 0.2}), 1.0, {2, 0, 0});
  both = Joined(ring, in_tube);
  EXPECT_EQ(NestingDepths(both, pieces), (std::vector<int>{0, 1}));
}

// A block of 4^3 and a handle of 6 x 2 x 2 that reaches one unit into it.
TEST(RepairParts, OverlappingPartsAreUnitedExactly) {
  const TriangleMesh parts = Joined(BoxAt({0, 0, 0}, {4, 4, 4}), BoxAt({3, 1, 1}, {9, 3, 3}));
  EXPECT_EQ(WhyNotSolid(Inspect(parts)), "overlapping pieces: 2");
  const RepairResult result = Repair(parts);
  EXPECT_TRUE(result.accepted()) << result.refusal;
  EXPECT_EQ(result.actions, std::vector<std::string>{"united 2 overlapping pieces"});
  EXPECT_EQ(result.report.components, 1);
  EXPECT_DOUBLE_EQ(result.report.volume, 64.0 + 24.0 - 4.0);
  EXPECT_NEAR(result.report.center_of_mass.x(), (128.0 + 144.0 - 14.0) / 84.0, 1e-12);
  EXPECT_DOUBLE_EQ(result.report.area, 6.0 * 16.0 + 4.0 * 2.0 * 5.0);
  const RepairResult again = Repair(Inverted(parts));
  EXPECT_EQ(again.mesh.faces, result.mesh.faces);
  EXPECT_EQ(again.mesh.vertices, result.mesh.vertices);
  EXPECT_TRUE(Repair(result.mesh).actions.empty());
}

// A cube of edge 4 with a corner set into the middle of the diagonal of its lower side, between two
// faces and a sliver, and a foot of 1 x 1 x 2 that reaches one unit into it there.
TEST(RepairParts, ASliverOnTheSeamIsNoCrossing) {
  TriangleMesh cube = BoxAt({0, 0, 0}, {4, 4, 4});
  const auto [a, b, c] = cube.faces[0];  // b is across the diagonal (a, c) from the other face
  cube.vertices.push_back(0.5 * (cube.vertices[a] + cube.vertices[c]));
  cube.faces[0] = {a, b, 8};
  cube.faces.insert(cube.faces.end(), {{b, c, 8}, {a, 8, c}});
  const RepairResult result = Repair(Joined(cube, BoxAt({1.5, 1.5, -1}, {2.5, 2.5, 1})));
  EXPECT_TRUE(result.accepted()) << result.refusal;
  EXPECT_EQ(result.actions, (std::vector<std::string>{"flipped the long edge of 1 zero-area face",
                                                      "united 2 overlapping pieces"}));
  EXPECT_DOUBLE_EQ(result.report.volume, 64.0 + 1.0);
}

// What lies in both of two overlapping blocks lies in one of them afterwards. It was a second body,
// and would be a void.
TEST(RepairParts, ABodyInTwoOverlappingPartsIsNotMadeAVoid) {
  const TriangleMesh blocks = Joined(BoxAt({0, 0, 0}, {4, 4, 4}), BoxAt({1, 1, 1}, {7, 3, 3}));
  const TriangleMesh stone = BoxAt({1.5, 1.5, 1.5}, {2.5, 2.5, 2.5});
  for (const TriangleMesh& inner : {stone, Inverted(stone)}) {
    const RepairResult result = Repair(Joined(blocks, inner));
    EXPECT_EQ(result.refusal, "overlapping pieces: 2");
    EXPECT_EQ(result.mesh.faces.size(), 36u);
  }
  // In one of them only it is a void before and after.
  const RepairResult hollow = Repair(Joined(blocks, BoxAt({0.25, 0.25, 0.25}, {0.75, 0.75, 0.75})));
  EXPECT_TRUE(hollow.accepted()) << hollow.refusal;
  EXPECT_DOUBLE_EQ(hollow.report.volume, 64.0 + 24.0 - 12.0 - 0.125);
}

// A ring whose first circle of corners is one point: closed, every edge between two faces, two fans
// at the point.
TEST(RepairParts, APartThatTouchesItselfInAVertexIsNotUnited) {
  TriangleMesh ring = shapes::Torus(2.0, 0.5, 12, 6);
  for (auto& face : ring.faces) {
    for (std::int32_t& v : face) v = v < 6 ? 0 : v;
  }
  std::erase_if(ring.faces,
                [](const auto& f) { return f[0] == f[1] || f[1] == f[2] || f[2] == f[0]; });
  const TriangleMesh bar = BoxAt({-3, -0.1, -0.1}, {-1, 0.1, 0.1});
  EXPECT_FALSE(Union({ring, bar}).has_value());
  EXPECT_EQ(Repair(Joined(ring, bar)).refusal, "non-manifold: parts touch in a single vertex");
}

TEST(RepairParts, ASmallPartOnTheFaceOfABlockIsOneBodyWithIt) {
  const RepairResult result =
      Repair(Joined(BoxAt({0, 0, 0}, {4, 4, 4}), BoxAt({1, 1, 4}, {2, 3, 6})));
  EXPECT_TRUE(result.accepted()) << result.refusal;
  EXPECT_DOUBLE_EQ(result.report.volume, 64.0 + 4.0);
}

TEST(RepairParts, RoundPartsAreUnitedToo) {
  const TriangleMesh ball = shapes::Sphere(1.0, 3);
  const TriangleMesh parts = Joined(Joined(ball, Transformed(ball, 1.0, {0.9, 0.2, 0.1})),
                                    shapes::Torus(1.0, 0.3, 40, 20));
  const RepairResult result = Repair(parts);
  EXPECT_TRUE(result.accepted()) << result.refusal;
  EXPECT_EQ(result.actions.front(), "united 3 overlapping pieces");
  EXPECT_GT(result.report.volume, Volume(ball));
  EXPECT_LT(result.report.volume, Volume(parts));
}

TEST(RepairParts, VoidsThatOverlapAreOneVoid) {
  const TriangleMesh voids =
      Joined(BoxAt({-1, -1, 3}, {1, 1, 6}), BoxAt({-0.5, -0.5, 5}, {0.5, 0.5, 9}));
  const RepairResult result = Repair(Joined(kBlock, Inverted(voids)));
  EXPECT_TRUE(result.accepted()) << result.refusal;
  EXPECT_EQ(result.report.voids, 1);
  EXPECT_DOUBLE_EQ(result.report.volume, 160.0 - (12.0 + 4.0 - 1.0));
}

// Matter or a drilled hole? The file says both.
TEST(RepairParts, OverlappingPartsWoundAgainstEachOtherAreRefusedByName) {
  const TriangleMesh drill = BoxAt({-1, -1, 8}, {1, 1, 12});
  EXPECT_EQ(Repair(Joined(kBlock, Inverted(drill))).refusal, "overlapping pieces: 2");
  TriangleMesh spike = shapes::Sphere(1.0, 2);
  spike.vertices[0] *= -3.0;
  EXPECT_EQ(Repair(Joined(kBlock, spike)).refusal, "overlapping pieces: 2");
}

// A prism whose side walls cross: its halves have volumes of both signs, 0.4 in all, and the
// solid's formula puts the centre at x = -12 for a body in 0 <= x <= 4.
TEST(RepairParts, ABodyThatCrossesItselfIsRefusedAndHasItsCentreInsideItsBox) {
  TriangleMesh crossed{{{0, -1.1, 0},
                        {4, 1, 0},
                        {4, -1, 0},
                        {0, 1.1, 0},
                        {0, -1.1, 1},
                        {4, 1, 1},
                        {4, -1, 1},
                        {0, 1.1, 1}},
                       {{{2, 1, 0}, {3, 2, 0}, {4, 5, 6}, {4, 6, 7}}}};
  for (std::int32_t i = 0; i < 4; ++i) {
    const std::int32_t j = (i + 1) % 4;
    crossed.faces.push_back({i, j, 4 + j});
    crossed.faces.push_back({i, 4 + j, 4 + i});
  }
  EXPECT_NEAR(Volume(crossed), 0.4, 1e-12);
  EXPECT_EQ(Repair(crossed).refusal, "self-intersecting");
  EXPECT_GT(CenterOfMass(crossed).x(), 0.0);
  EXPECT_LT(CenterOfMass(crossed).x(), 4.0);
}

// The bar from z = 0 to 25 and its mirror image: the ends at z = 0 have the same corners.
TriangleMesh MirroredPair(const TriangleMesh& upper) {
  TriangleMesh lower = Inverted(upper);
  for (auto& v : lower.vertices) v.z() = -v.z();
  return Joined(upper, lower);
}

TEST(RepairParts, TheFacesBetweenTwoBarsCancel) {
  const RepairResult result = Repair(MirroredPair(BoxAt({0, 0, 0}, {10, 10, 25})));
  EXPECT_TRUE(result.accepted()) << result.refusal;
  EXPECT_EQ(result.actions, (std::vector<std::string>{"merged 4 duplicate vertices",
                                                      "removed 4 cancelling faces"}));
  EXPECT_EQ(result.report.components, 1);
  EXPECT_DOUBLE_EQ(result.report.volume, 5000.0);
  EXPECT_DOUBLE_EQ(result.report.area, 200.0 + 4.0 * 500.0);
}

// Four bars around one edge: inside it, four walls meet.
TEST(RepairParts, AllFacesAmongFourBarsCancel) {
  TriangleMesh pair = MirroredPair(BoxAt({0, 0, 0}, {10, 10, 25}));
  TriangleMesh beside = Inverted(pair);
  for (auto& v : beside.vertices) v.x() = -v.x();
  const RepairResult result = Repair(Joined(pair, beside));
  EXPECT_TRUE(result.accepted()) << result.refusal;
  EXPECT_DOUBLE_EQ(result.report.volume, 10000.0);
  EXPECT_DOUBLE_EQ(result.report.area, 2.0 * 200.0 + 2.0 * 1000.0 + 2.0 * 500.0);
}

TEST(RepairParts, ABodyWithBothSidesOfEveryFaceKeepsOne) {
  const RepairResult result = Repair(Joined(shapes::Cube(), Inverted(shapes::Cube())));
  EXPECT_TRUE(result.accepted()) << result.refusal;
  EXPECT_EQ(result.actions, (std::vector<std::string>{"merged 8 duplicate vertices",
                                                      "removed 12 duplicate faces"}));
  EXPECT_EQ(result.mesh.faces, shapes::Cube().faces);
}

// Every face with corners of its own, in float32 about `place`, each coordinate moved by no or
// `steps` steps of float32.
TriangleMesh Torn(const Vector3d& place, int steps) {
  const TriangleMesh cylinder = Transformed(shapes::Cylinder(9.7, 20.0, 24), 1.0, place);
  RngStream rng(5, "torn");
  TriangleMesh torn;
  for (const auto& face : cylinder.faces) {
    const auto n = static_cast<std::int32_t>(torn.vertices.size());
    for (const auto corner : face) {
      Vector3d v = cylinder.vertices[corner];
      for (int k = 0; k < 3; ++k) {
        auto value = static_cast<float>(v[k]);
        for (int i = rng.Below(2) == 0 ? 0 : steps; i > 0 && value != 0.0F; --i) {
          value = std::nextafter(value, std::numeric_limits<float>::infinity());
        }
        v[k] = value;
      }
      torn.vertices.push_back(v);
    }
    torn.faces.push_back({n, n + 1, n + 2});
  }
  return torn;
}

TEST(Repair, ClosesSeamsOfOneFloatStepWhereverThePartLies) {
  for (const Vector3d& place :
       {Vector3d(0, 0, 10), Vector3d(125, 105, 10), Vector3d(1000, 1000, 10)}) {
    const RepairResult result = Repair(Torn(place, 1));
    EXPECT_TRUE(result.accepted()) << place.transpose() << ": " << result.refusal;
    EXPECT_TRUE(result.actions.back().ends_with("nearly equal vertices")) << result.actions.back();
    EXPECT_EQ(result.mesh.vertices.size(), 50u);
  }
  EXPECT_TRUE(Repair(Torn({1000, 1000, 10}, 8)).refusal.starts_with("open: "));
}

}  // namespace
}  // namespace antigrasp
