#include "antigrasp/mesh/fit.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

TEST(FitToPlate, StandsCentredOnThePlateAtTheGivenSize) {
  const TriangleMesh box = Transformed(shapes::Box({1, 2, 4}), 3.0, {7.0, 8.0, 9.0});
  const BoundingBox fitted = Bounds(FitToPlate(box, 40.0));
  EXPECT_TRUE(fitted.min.isApprox(Eigen::Vector3d(-5.0, -10.0, 0.0), 1e-12));
  EXPECT_TRUE(fitted.max.isApprox(Eigen::Vector3d(5.0, 10.0, 40.0), 1e-12));
}

TEST(FitToPlate, RefusesAMeshWithoutExtent) {
  EXPECT_THROW(FitToPlate(TriangleMesh{}, 1.0), std::logic_error);
}

// A lopsided shape: its middle is that of the box around it, not of its mass (1/4 of each edge).
TEST(FitToPlate, CentresTheBoxAroundTheShape) {
  const TriangleMesh fitted = FitToPlate(shapes::Tetrahedron(), 10.0);
  const std::vector<Eigen::Vector3d> expected{{-5, -5, 0}, {5, -5, 0}, {-5, 5, 0}, {-5, -5, 10}};
  EXPECT_EQ(fitted.vertices, expected);
  EXPECT_EQ(fitted.faces, shapes::Tetrahedron().faces);
}

TEST(FitToPlate, TheLargestExtentMayBeAnyAxis) {
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::Vector3d extents(1, 1, 1);
    extents[axis] = 4;
    EXPECT_EQ(Bounds(FitToPlate(shapes::Box(extents), 8.0)).Extent(), 2.0 * extents);
  }
}

}  // namespace
}  // namespace antigrasp
