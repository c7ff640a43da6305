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

}  // namespace
}  // namespace antigrasp
