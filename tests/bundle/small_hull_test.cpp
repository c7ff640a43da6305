#include "antigrasp/bundle/small_hull.h"

#include <gtest/gtest.h>

#include "antigrasp/mesh/convex_hull.h"
#include "tests/bundle/dented_solids.h"
#include "tests/support/random_draws.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

TEST(SmallHull, OfABoxWithPointsInItsFacesIsTheBox) {
  std::vector<Vector3d> points = shapes::Away(shapes::Box({1, 2, 3})).vertices;
  const std::vector<Vector3d> corners = points;
  for (const Vector3d& a : corners) {
    for (const Vector3d& b : corners) points.push_back(0.25 * a + 0.75 * b);
  }
  const SmallHull hull(points);
  EXPECT_NEAR(hull.Volume(), 6.0, 1e-9);
  const ConvexPart part = hull.Part();
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d& corner : corners) middle += corner / 8.0;
  EXPECT_NEAR(part.Depth(middle), 0.5, 1e-9);
  EXPECT_NEAR(part.Way(middle, Vector3d::UnitZ(), 0.0), 1.5, 1e-9);
  EXPECT_TRUE(part.box.Extent().isApprox(Vector3d(1, 2, 3), 1e-12));
}

TEST(SmallHull, HasTheVolumeOfTheExactHull) {
  RngStream rng(1, "small hull", 0, 0);
  for (int count = 5; count < 100; ++count) {
    std::vector<Vector3d> points;
    // Every other set is of a lattice: many points of its hull lie in one plane.
    for (int i = 0; i < count; ++i) {
      const Vector3d point = DrawPoint(2.0, &rng);
      points.push_back(count % 2 == 0 ? Vector3d(point.array().round()) : point);
    }
    const double volume = Volume(ConvexHull(points));
    EXPECT_NEAR(SmallHull(points).Volume(), volume, 1e-9 * volume) << count;
  }
}

TEST(SmallHull, OfPointsInAPlaneIsEmpty) {
  const SmallHull flat({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}, {2, 5, 1}});
  EXPECT_EQ(flat.Volume(), 0.0);
  EXPECT_TRUE(flat.Part().empty());
}

}  // namespace
}  // namespace antigrasp
