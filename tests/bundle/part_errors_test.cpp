#include "antigrasp/bundle/part_errors.h"

#include <gtest/gtest.h>

#include "tests/bundle/dented_solids.h"

namespace antigrasp {
namespace {

ConvexPart PartOf(const TriangleMesh& mesh) { return MakeConvexPart(mesh.vertices); }

// 2 x 3 x 4 about (5, 0, 0).
TriangleMesh Solid() { return Transformed(shapes::Box({2, 3, 4}), 1.0, {5, 0, 0}); }
TriangleMesh BoxAt(const Eigen::Vector3d& extents, const Eigen::Vector3d& center) {
  return Transformed(shapes::Box(extents), 1.0, center);
}

TEST(PartErrors, AreNoneForTheSolidItself) {
  const PartErrors errors = MeasureParts(Solid(), {PartOf(Solid())}, 0.4);
  EXPECT_NEAR(errors.covered, 0.0, 1e-12);
  EXPECT_NEAR(errors.missing, 0.0, 1e-12);
  EXPECT_NEAR(errors.hausdorff, 0.0, 1e-12);
  EXPECT_NEAR(errors.dent, 0.0, 1e-12);
}

TEST(PartErrors, CountOverlapsOnce) {
  const auto low = PartOf(BoxAt({2, 3, 3}, {5, 0, -0.5})),
             high = PartOf(BoxAt({2, 3, 3}, {5, 0, 0.5}));
  const PartErrors errors = MeasureParts(Solid(), {low, high}, 0.4);
  EXPECT_NEAR(errors.covered, 0.0, 1e-12);
  EXPECT_NEAR(errors.missing, 0.0, 1e-12);
  EXPECT_NEAR(errors.hausdorff, 0.0, 1e-12);
}

TEST(PartErrors, TellWhatIsMissingFromWhatIsTooMuch) {
  // Half of the solid, and as much again beside it that is a quarter as thick.
  const auto half = PartOf(BoxAt({2, 3, 2}, {5, 0, 1}));
  const auto beside = PartOf(BoxAt({0.5, 3, 4}, {6.25, 0, 0}));
  const PartErrors errors = MeasureParts(Solid(), {half, beside}, 0.4);
  EXPECT_NEAR(errors.missing, 0.5, 0.01);
  EXPECT_NEAR(errors.covered, 0.25, 0.01);
}

// The hull of the U fills the slot, 20 mm wide and deep: in its middle the walls are 10 mm away,
// and the middle of its bottom lies 10 mm below either face.
TEST(PartErrors, OfTheHullOfAUAreThoseOfItsSlot) {
  const TriangleMesh u = shapes::UShape();
  const PartErrors errors = MeasureParts(u, {PartOf(u)}, 0.06 / 28);
  EXPECT_NEAR(errors.covered, 16.0 / 56.0, 0.005);
  EXPECT_NEAR(errors.missing, 0.0, 1e-12);
  EXPECT_NEAR(errors.dent, 0.010, 0.0003);
  EXPECT_NEAR(errors.hausdorff, 0.010, 0.0003);
}

// How far a surface that is not covered lies from what should cover it.
TEST(PartErrors, SeeAPartThatFallsShort) {
  const auto shorter = PartOf(BoxAt({2, 3, 3.5}, {5, 0, -0.25}));
  const PartErrors errors = MeasureParts(Solid(), {shorter}, 0.4);
  EXPECT_NEAR(errors.missing, 0.125, 0.005);
  EXPECT_NEAR(errors.hausdorff, 0.5, 0.02);
  EXPECT_NEAR(errors.dent, 0.0, 1e-12);
}

}  // namespace
}  // namespace antigrasp
