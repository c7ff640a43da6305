#include "antigrasp/mesh/place.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "antigrasp/core/rng.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

TriangleMesh BoxAt(const Vector3d& extents, const Vector3d& center) {
  return Transformed(shapes::Box(extents), 1.0, center);
}

TEST(RoundPlace, AnObjectAtTheOriginStaysAsItIs) {
  for (const double size : {1e-3, 0.1, 0.5, 1.0, 60.0, 100.0, 3e7}) {
    const Vector3d extents(size, 0.7 * size, 0.2 * size);
    EXPECT_EQ(RoundPlace(BoxAt(extents, Vector3d::Zero())), Vector3d::Zero()) << size;
    EXPECT_EQ(RoundPlace(BoxAt(extents, 0.5 * extents)), Vector3d::Zero()) << size;  // a corner
    EXPECT_EQ(RoundPlace(BoxAt(extents, {0.9 * size, 0.0, -0.9 * size})), Vector3d::Zero());
  }
}

TEST(RoundPlace, CopiesMovedByRoundNumbersComeToLieInOnePlaceExactly) {
  // Twice the extent of 110 is at most 500: 10, 400 and 800 m in millimetres are multiples of it.
  EXPECT_EQ(RoundPlace(BoxAt({60.0, 60.0, 110.0}, {10000.0, 8000.0, 55.0})),
            Vector3d(10000.0, 8000.0, 0.0));
  EXPECT_EQ(RoundPlace(BoxAt({60.0, 60.0, 110.0}, {400000.0, -800000.0, 55.0})),
            Vector3d(400000.0, -800000.0, 0.0));
  // In metres: a fifth for a cube of 0.1, the numbers as text is read.
  EXPECT_EQ(RoundPlace(BoxAt(Vector3d::Constant(0.1), {900.2, 0.6, -10.4})),
            Vector3d(900.2, 0.6, -10.4));
}

TEST(RoundPlace, WhatIsLeftIsWithinThreeExtentsOfTheOrigin) {
  RngStream rng(1, "places");
  for (int i = 0; i < 200; ++i) {
    const double size = std::pow(10.0, rng.Uniform(-3.0, 3.0));
    const Vector3d center = 1e3 * size * Vector3d(rng.Normal(), rng.Normal(), rng.Normal());
    const TriangleMesh box = BoxAt({size, 0.5 * size, size}, center);
    EXPECT_LE((center - RoundPlace(box)).cwiseAbs().maxCoeff() + 0.5 * size, 3.0001 * size);
  }
}

TEST(RoundPlace, WhatHasNoSizeHasNoPlace) {
  EXPECT_EQ(RoundPlace(TriangleMesh()), Vector3d::Zero());
  EXPECT_EQ(RoundPlace(TriangleMesh{{{5.0, 5.0, 5.0}}, {}}), Vector3d::Zero());
  TriangleMesh broken = BoxAt({1.0, 1.0, 1.0}, {50.0, 0.0, 0.0});
  broken.vertices[0].x() = std::numeric_limits<double>::infinity();
  EXPECT_EQ(RoundPlace(broken), Vector3d::Zero());
}

TEST(SinglePrecisionLoss, IsHalfAUnitInTheLastPlaceOfTheLargestCoordinate) {
  // Floats from 2^19 to 2^20 are 2^-4 apart.
  const double far = 1024.0 * 1024.0;
  EXPECT_EQ(SinglePrecisionLoss(BoxAt({2.0, 2.0, 2.0}, {0.0, 1.0 - far, 0.0})), 1.0 / 16.0);
  EXPECT_EQ(SinglePrecisionLoss(TriangleMesh()), 0.0);
}

TEST(RoundedBy, IsTheLossOfLongSinglePrecisionNumbersAndNothingWithAnyOther) {
  // Short numbers were exact however far away they are.
  TriangleMesh mesh = BoxAt({2.0, 2.0, 0.5}, {400000.0, 0.0, 0.25});
  EXPECT_EQ(RoundedBy(mesh), 0.0);
  mesh.vertices[3].z() = 0.1F;
  EXPECT_EQ(RoundedBy(mesh), std::ldexp(0.1F, -24));
  mesh.vertices[5].x() = -400000.1F;
  EXPECT_EQ(RoundedBy(mesh), std::ldexp(400000.1F, -24));
  mesh.vertices[0].y() = 0.1;  // no file in single precision
  EXPECT_EQ(RoundedBy(mesh), 0.0);
}

}  // namespace
}  // namespace antigrasp
