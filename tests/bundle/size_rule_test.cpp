#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "antigrasp/bundle/object_size_rule.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

TEST(OrientedExtents, OfATurnedBoxAreItsEdges) {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const Eigen::Vector3d extents = OrientedExtents(shapes::Rotated(shapes::Box({3, 1, 2}), turn));
  EXPECT_TRUE(extents.isApprox(Eigen::Vector3d(1, 2, 3), 1e-9)) << extents.transpose();
}

TEST(EgadScale, MakesTheLongestSideAsWideAsTheGripperOpens) {
  EXPECT_NEAR(EgadScale({1, 2, 4}, 0.08), 0.02, 1e-15);
}

TEST(EgadScale, LeavesTheShortestSideFourFifthsOfTheOpening) {
  EXPECT_NEAR(EgadScale({2, 2, 2}, 0.08), 0.8 * 0.08 / 2, 1e-15);
}

}  // namespace
}  // namespace antigrasp
