#include "antigrasp/bundle/draw_in.h"

#include <gtest/gtest.h>

#include "tests/bundle/dented_solids.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

ConvexPart BoxPart(const Vector3d& low, const Vector3d& high) {
  std::vector<Vector3d> corners;
  for (int i = 0; i < 8; ++i) {
    corners.emplace_back(i & 1 ? high.x() : low.x(), i & 2 ? high.y() : low.y(),
                         i & 4 ? high.z() : low.z());
  }
  return MakeConvexPart(corners);
}

constexpr double kCell = 0.002;

// The hull of the U covers its slot, whose middle is 10 mm from the walls: a cell counts. The slot
// is open at the top and at both faces in z.
TEST(DrawnIn, AHullComesCloserWhereItCoversASlotAndStaysWhereItDoesNot) {
  const TriangleMesh solid = shapes::UShape();
  const std::vector<ConvexPart> hull{MakeConvexPart(solid.vertices)};
  const auto drawn = DrawnIn(hull, SolidTest(solid), 0.25, kCell);
  ASSERT_EQ(drawn.size(), 1u);
  const double by = 0.25 * kCell;
  EXPECT_TRUE(drawn[0].box.min.isApprox(hull[0].box.min + Vector3d(0, 0, by), 1e-9));
  EXPECT_TRUE(drawn[0].box.max.isApprox(hull[0].box.max - Vector3d(0, by, by), 1e-9));
  EXPECT_NEAR(drawn[0].volume, 0.06 * (0.06 - by) * (0.02 - 2.0 * by), 1e-12);
}

TEST(DrawnIn, FacetsOnTheSolidAndInItStay) {
  const TriangleMesh solid = shapes::Box({0.04, 0.03, 0.02});
  const BoundingBox box = Bounds(solid);
  const Vector3d half(0.5 * (box.min.x() + box.max.x()), box.max.y(), box.max.z());
  const std::vector<ConvexPart> two{BoxPart(box.min, half),
                                    BoxPart({half.x(), box.min.y(), box.min.z()}, box.max)};
  const auto drawn = DrawnIn(two, SolidTest(solid), 0.5, kCell);
  ASSERT_EQ(drawn.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(drawn[i].mesh.vertices, two[i].mesh.vertices);
}

// A tenth of a cell thick and no more than 0.35 cells from the box.
TEST(DrawnIn, ASliverOverAirIsGone) {
  const TriangleMesh solid = shapes::Box({0.04, 0.03, 0.02});
  const BoundingBox box = Bounds(solid);
  const Vector3d over(0.0, 0.0, 0.02 + 0.25 * kCell);
  const std::vector<ConvexPart> two{
      BoxPart(box.min, box.max),
      BoxPart(box.min + over,
              Vector3d(box.max.x(), box.max.y(), box.min.z() + 0.1 * kCell) + over)};
  const auto drawn = DrawnIn(two, SolidTest(solid), 0.5, kCell);
  ASSERT_EQ(drawn.size(), 1u);
  EXPECT_NEAR(drawn[0].volume, 24e-6, 1e-12);
  // Where nothing else is near it stays.
  EXPECT_EQ(DrawnIn({two[1]}, SolidTest(solid), 0.5, kCell).size(), 1u);
}

TEST(Behind, IsTheBoxOfItsPlanes) {
  const ConvexPart box = BoxPart({1, 2, 3}, {2, 4, 6});
  const ConvexPart again = Behind(box.planes, {1.1, 2.5, 5.9});
  EXPECT_NEAR(again.volume, 6.0, 1e-9);
  EXPECT_EQ(again.mesh.vertices.size(), 8u);
}

}  // namespace
}  // namespace antigrasp
