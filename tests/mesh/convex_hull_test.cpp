#include "antigrasp/mesh/convex_hull.h"

#include <gtest/gtest.h>

#include "antigrasp/core/rng.h"
#include "antigrasp/mesh/inspect.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

TEST(ConvexHull, OfABoxAndPointsInsideItIsTheBox) {
  std::vector<Vector3d> points = shapes::Box({2, 3, 4}).vertices;
  RngStream rng(1, "hull");
  for (int i = 0; i < 100; ++i) {
    points.emplace_back(rng.Uniform(-0.9, 0.9), rng.Uniform(-1.4, 1.4), rng.Uniform(-1.9, 1.9));
  }
  const TriangleMesh hull = ConvexHull(points);
  EXPECT_EQ(hull.vertices.size(), 8u);
  EXPECT_EQ(hull.faces.size(), 12u);
  const MeshReport report = Inspect(hull);
  EXPECT_TRUE(report.IsSolid()) << WhyNotSolid(report);
  EXPECT_DOUBLE_EQ(report.volume, 24.0);
}

TEST(ConvexHull, HoldsEveryPointAndHasTheEulerNumberOfASphere) {
  std::vector<Vector3d> points;
  RngStream rng(2, "hull");
  for (int i = 0; i < 500; ++i) points.emplace_back(rng.Normal(), rng.Normal(), rng.Normal());
  const TriangleMesh hull = ConvexHull(points);
  EXPECT_TRUE(Inspect(hull).IsSolid());
  EXPECT_EQ(hull.faces.size(), 2 * hull.vertices.size() - 4);
  for (std::size_t f = 0; f < hull.faces.size(); ++f) {
    const Vector3d normal = FaceCross(hull, f).normalized();
    const auto corner = static_cast<std::size_t>(hull.faces[f][0]);
    for (const Vector3d& p : points) EXPECT_LE(normal.dot(p - hull.vertices[corner]), 1e-12);
  }
}

TEST(ConvexHull, FillsTheHoleOfATorus) {
  const TriangleMesh hull = ConvexHull(shapes::Torus(2, 0.5, 24, 12).vertices);
  EXPECT_TRUE(Inspect(hull).IsSolid());
  EXPECT_EQ(Inspect(hull).genus, 0);
}

TEST(ConvexHull, OfPointsInAPlaneHasNoFaces) {
  EXPECT_TRUE(ConvexHull({}).faces.empty());
  EXPECT_TRUE(ConvexHull({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}}).faces.empty());
  EXPECT_TRUE(ConvexHull({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}).faces.empty());
  EXPECT_TRUE(ConvexHull({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}).faces.empty());
  EXPECT_TRUE(ConvexHull({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}, {5, 2, 1}}).faces.empty());
}

// Corners sorted by x, y, z; every face from its lowest corner on, counter-clockwise from outside;
// faces sorted: sums over a hull have the same bits in every run.
TEST(ConvexHull, HasAnOrderOfItsOwn) {
  const TriangleMesh hull =
      ConvexHull({{1, 0, 0}, {0.2, 0.2, 0.2}, {0, 1, 0}, {0, 0, 0}, {0, 0, 1}});
  EXPECT_EQ(hull.vertices, (std::vector<Vector3d>{{0, 0, 0}, {0, 0, 1}, {0, 1, 0}, {1, 0, 0}}));
  EXPECT_EQ(hull.faces,
            (std::vector<std::array<std::int32_t, 3>>{{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}));
}

}  // namespace
}  // namespace antigrasp
