#include "antigrasp/bundle/convex_parts.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "tests/bundle/dented_solids.h"

namespace antigrasp {
namespace {

double SumOfVolumes(const std::vector<ConvexPart>& parts) {
  double sum = 0.0;
  for (const ConvexPart& part : parts) sum += part.volume;
  return sum;
}

bool AnyHolds(const std::vector<ConvexPart>& parts, const Eigen::Vector3d& point) {
  return std::any_of(parts.begin(), parts.end(),
                     [&](const ConvexPart& part) { return part.Depth(point) > 0.0; });
}

TEST(ConvexParts, OfABoxAreTheBox) {
  const auto parts = ConvexParts(shapes::Away(shapes::Box({1, 2, 3})), {});
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_NEAR(parts[0].volume, 6.0, 1e-12);
  EXPECT_EQ(parts[0].planes.size(), 6u);
}

TEST(ConvexParts, OfAnLAreTwoBoxesInItsPlaces) {
  const auto parts = ConvexParts(shapes::LShape(), {});
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_GE(parts[0].volume, parts[1].volume);
  EXPECT_NEAR(SumOfVolumes(parts), 24e-6, 1e-9);
  EXPECT_TRUE(AnyHolds(parts, {.01 + .035, -.02 + .01, .03}));
  EXPECT_FALSE(AnyHolds(parts, {.01 + .021, -.02 + .021, .03}));
}

TEST(ConvexParts, KeepASlotOpenDownToItsBottom) {
  const auto parts = ConvexParts(shapes::UShape(), {});
  EXPECT_EQ(parts.size(), 3u);
  EXPECT_NEAR(SumOfVolumes(parts), 56e-6, 1e-9);
  EXPECT_FALSE(AnyHolds(parts, {.01 + .03, -.02 + .021, .03}));
  EXPECT_TRUE(AnyHolds(parts, {.01 + .03, -.02 + .019, .03}));
}

TEST(ConvexParts, AreNoMoreThanAskedFor) {
  PartOptions one;
  one.parts = 1;
  one.draw_in = 0.0;
  const auto hull = ConvexParts(shapes::UShape(), one);
  ASSERT_EQ(hull.size(), 1u);
  EXPECT_NEAR(hull[0].volume, 72e-6, 1e-12);
  PartOptions two;
  two.parts = 2;
  EXPECT_EQ(ConvexParts(shapes::UShape(), two).size(), 2u);
  PartOptions eight;
  eight.parts = 8;
  EXPECT_LE(ConvexParts(shapes::Torus(0.03, 0.012, 12, 6), eight).size(), 8u);
}

TEST(ConvexParts, AreTheSameTwice) {
  const TriangleMesh mesh = shapes::Torus(0.03, 0.012, 12, 6);
  PartOptions few;
  few.parts = 6;
  const auto a = ConvexParts(mesh, few), b = ConvexParts(mesh, few);
  ASSERT_EQ(a.size(), b.size());
  EXPECT_GT(a.size(), 1u);
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].mesh.vertices, b[i].mesh.vertices);
    EXPECT_EQ(a[i].mesh.faces, b[i].mesh.faces);
  }
}

TEST(ConvexParts, FollowTheObjectsSize) {
  const auto metres = ConvexParts(shapes::UShape(), {});
  const auto millimetres =
      ConvexParts(Transformed(shapes::UShape(), 1000.0, Eigen::Vector3d::Zero()), {});
  ASSERT_EQ(metres.size(), millimetres.size());
  EXPECT_NEAR(1e9 * SumOfVolumes(metres), SumOfVolumes(millimetres), 1e-3);
}

TEST(CellOf, IsA28thOfTheLargestExtent) {
  EXPECT_NEAR(CellOf(shapes::Box({1, 2, 0.7})), 2.0 / 28, 1e-15);
}

}  // namespace
}  // namespace antigrasp
