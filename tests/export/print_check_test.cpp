#include "antigrasp/export/print_check.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

// Stands with its axis along this direction of the mesh.
void ExpectUp(const PrintCheck& check, const Vector3d& up) {
  EXPECT_NEAR((check.table_from_object.row(2).transpose() - up).norm(), 0.0, 1e-6)
      << check.table_from_object;
}

// Whether some note holds `part`.
bool Notes(const PrintCheck& check, const std::string& part) {
  for (const std::string& note : check.notes) {
    if (note.find(part) != std::string::npos) return true;
  }
  return false;
}

TEST(PrintCheck, ACubeNeedsNothing) {
  const PrintCheck check = CheckPrint(shapes::Box(Vector3d::Constant(0.3)), 60.0);
  EXPECT_NEAR(check.mm_per_unit, 200.0, 1e-9);
  EXPECT_NEAR((check.size_mm - Vector3d::Constant(60.0)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((check.print_size_mm - Vector3d::Constant(60.0)).norm(), 0.0, 1e-6);
  EXPECT_TRUE(check.watertight);
  EXPECT_EQ(check.why_not_solid, "");
  EXPECT_NEAR(*check.wall_mm, 60.0, 1e-3);
  EXPECT_EQ(check.overhang_share, 0.0);
  EXPECT_NEAR(check.contact_mm2, 3600.0, 1e-6);
  EXPECT_NEAR(check.pose_probability, 1.0 / 6.0, 1e-9);
  EXPECT_TRUE(check.notes.empty());
}

TEST(PrintCheck, ThePoseWithTheLeastOverhangIsSuggested) {
  TriangleMesh funnel = shapes::Cylinder(1.0, 1.0, 64);
  for (Vector3d& v : funnel.vertices) {
    if (v.z() > 0.0) v.head<2>() *= 3.0;  // widens by 63 degrees from vertical
  }
  const PrintCheck check = CheckPrint(funnel, 60.0);
  ExpectUp(check, -Vector3d::UnitZ());
  EXPECT_EQ(check.overhang_share, 0.0);
  EXPECT_NEAR(check.print_size_mm.z(), 10.0, 1e-6);  // a sixth of the wide rim
}

TEST(PrintCheck, OfPosesThatPrintAlikeTheOneWithTheLargestContactIsSuggested) {
  const PrintCheck check = CheckPrint(shapes::Box({2.0, 0.8, 1.0}), 40.0);
  EXPECT_NEAR(std::abs(check.table_from_object(2, 1)), 1.0, 1e-9);
  EXPECT_NEAR(check.contact_mm2, 40.0 * 20.0, 1e-6);
  EXPECT_NEAR(check.print_size_mm.z(), 16.0, 1e-6);
}

TEST(PrintCheck, APoseThatHardlyEverOccursIsNotSuggestedUnlessAskedFor) {
  const TriangleMesh pencil = shapes::Cylinder(0.05, 2.0, 24);
  const PrintCheck lying = CheckPrint(pencil, 100.0);
  EXPECT_NEAR(lying.table_from_object(2, 2), 0.0, 1e-6);
  // Of 24 sides the lowest rests, the next within the first layer; the one after that hangs over.
  EXPECT_NEAR(lying.overhang_share, 2.0 / 24.0 * 2.0 / (2.0 + 0.05), 1e-3);
  EXPECT_TRUE(Notes(lying, "hangs over"));
  const PrintCheck standing = CheckPrint(pencil, 100.0, {.min_probability = 0.0});
  EXPECT_NEAR(std::abs(standing.table_from_object(2, 2)), 1.0, 1e-6);
  EXPECT_EQ(standing.overhang_share, 0.0);
}

TEST(PrintCheck, AnObjectThatHardlyTouchesThePlateIsNamed) {
  const TriangleMesh ball = shapes::Sphere(1.0, 4);
  // Within the first layer lies a cap of 2 pi r 0.2 mm: 38 mm2 and 6 mm2.
  EXPECT_FALSE(Notes(CheckPrint(ball, 60.0), "print it on a raft"));
  EXPECT_TRUE(Notes(CheckPrint(ball, 10.0), "print it on a raft"));
  EXPECT_FALSE(Notes(CheckPrint(ball, 10.0, {.min_contact_mm2 = 0.0}), "raft"));
}

TEST(PrintCheck, AThinWallIsNamedWithItsThickness) {
  const PrintCheck check = CheckPrint(shapes::Box({1.0, 1.0, 0.01}), 50.0);
  EXPECT_NEAR(*check.wall_mm, 0.5, 1e-3);
  EXPECT_GT(check.thin_share, 0.9);
  EXPECT_TRUE(Notes(check, "0.5 mm, below 0.8 mm"));
  EXPECT_FALSE(
      Notes(CheckPrint(shapes::Box({1.0, 1.0, 0.01}), 50.0, {.min_wall_mm = 0.4}), "wall"));
}

TEST(PrintCheck, WhatIsNoSolidIsSaidAndStillMeasured) {
  TriangleMesh open = shapes::Cube();
  open.faces.pop_back();
  const PrintCheck check = CheckPrint(open, 10.0);
  EXPECT_FALSE(check.watertight);
  EXPECT_TRUE(Notes(check, "Not a solid: open"));
  EXPECT_NEAR(check.size_mm.x(), 10.0, 1e-9);
  const PrintCheck flat = CheckPrint(shapes::FlatSquare(), 10.0);
  EXPECT_TRUE(Notes(flat, "No stable pose"));
  EXPECT_FALSE(flat.wall_mm);
  EXPECT_EQ(flat.pose_probability, 0.0);
  EXPECT_THROW(CheckPrint(TriangleMesh(), 10.0), std::logic_error);
}

TEST(PrintCheck, TheMeshIsPlacedInMillimetresOnThePlate) {
  const TriangleMesh box = Transformed(shapes::Box({2.0, 0.8, 1.0}), 1.0, {5.0, 6.0, 7.0});
  const PrintCheck check = CheckPrint(box, 40.0);
  const BoundingBox as_is = Bounds(PlacedForPrint(box, check, Eigen::Matrix3d::Identity()));
  EXPECT_NEAR((as_is.min - Vector3d(-20.0, -8.0, 0.0)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((as_is.max - Vector3d(20.0, 8.0, 20.0)).norm(), 0.0, 1e-9);
  const BoundingBox placed = Bounds(PlacedForPrint(box, check, check.table_from_object));
  EXPECT_NEAR(placed.min.z(), 0.0, 1e-9);
  EXPECT_NEAR((placed.Extent() - check.print_size_mm).norm(), 0.0, 1e-9);
}

TEST(PrintCheck, GivesTheSameNumbersTwice) {
  const TriangleMesh mesh = shapes::Torus(1.0, 0.3, 40, 20);
  const PrintCheck a = CheckPrint(mesh, 60.0), b = CheckPrint(mesh, 60.0);
  EXPECT_EQ(*a.wall_mm, *b.wall_mm);
  EXPECT_EQ(a.thin_share, b.thin_share);
  EXPECT_EQ(a.table_from_object, b.table_from_object);
  EXPECT_EQ(a.overhang_share, b.overhang_share);
}

}  // namespace
}  // namespace antigrasp
