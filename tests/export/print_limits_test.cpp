// What is drawn exactly at a limit, in files and places that round it to either side.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "antigrasp/export/overhang.h"
#include "antigrasp/export/print_check.h"
#include "antigrasp/mesh/place.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

TriangleMesh AsStl(TriangleMesh mesh) {
  for (Vector3d& v : mesh.vertices) {
    for (double& x : v) {
      const volatile float single = static_cast<float>(x);  // else GCC 12 leaves it out
      x = single;
    }
  }
  return mesh;
}

// As text at the origin and far off, as STL at the origin, on a printer's bed and 1.2 m away.
std::vector<TriangleMesh> Copies(const TriangleMesh& mesh) {
  const auto moved = [&](double x, double y, double z) {
    return Transformed(mesh, 1.0, {x, y, z});
  };
  return {mesh,
          moved(10000.0, 8000.0, 500.0),
          moved(400000.0, 800000.0, 0.0),
          AsStl(mesh),
          AsStl(moved(0.0, 0.0, 0.1)),
          AsStl(moved(125.3, 104.7, 5.7)),
          AsStl(moved(1253.7, 1047.1, 0.0))};
}

TriangleMesh Plate(double thickness) {
  return Transformed(shapes::Box({40.0, 40.0, thickness}), 1.0, {20.0, 20.0, 0.5 * thickness});
}

// A square spool 30.3 wide whose flanks go in to a waist of 10.1 and out again, `slope` times as
// far in as they rise. Stands on z = 0.
TriangleMesh Spool(double slope) {
  TriangleMesh mesh;
  const double half[] = {15.15, 5.05, 15.15}, rise = 10.1 / slope;
  for (int level = 0; level < 3; ++level) {
    for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
      mesh.vertices.push_back({half[level] * x, half[level] * y, level * rise});
    }
  }
  mesh.faces = {{0, 2, 1}, {0, 3, 2}, {8, 9, 10}, {8, 10, 11}};
  for (int level = 0; level < 2; ++level) {
    for (int k = 0; k < 4; ++k) {
      const int a = 4 * level + k, b = 4 * level + (k + 1) % 4;
      mesh.faces.push_back({a, b, b + 4});
      mesh.faces.push_back({a, b + 4, a + 4});
    }
  }
  return mesh;
}

TEST(PrintLimits, AWallOfExactlyTheLimitPassesWhereverItLiesAndAThinnerOneDoesNot) {
  for (const TriangleMesh& plate : Copies(Plate(0.8))) {
    const PrintCheck check = CheckPrint(plate, 40.0);
    EXPECT_NEAR(*check.wall_mm, 0.8, 5e-4);
    EXPECT_FALSE(check.thin);
    EXPECT_EQ(check.thin_share, 0.0);
    EXPECT_TRUE(check.notes.empty()) << check.notes[0];
  }
  for (const TriangleMesh& plate : Copies(Plate(0.79))) {
    const PrintCheck check = CheckPrint(plate, 40.0);
    EXPECT_TRUE(check.thin);
    EXPECT_GT(check.thin_share, 0.9);
    EXPECT_EQ(check.notes.size(), 1u);
  }
}

TEST(PrintLimits, UndersidesOfExactly45DegreesArePrintedAndEdgesOf45AreNoWalls) {
  for (const double min_probability : {0.01, 1.0}) {  // 1: the likeliest pose alone
    for (const TriangleMesh& spool : Copies(Spool(1.0))) {
      const PrintCheck check = CheckPrint(spool, 30.3, {.min_probability = min_probability});
      EXPECT_EQ(check.overhang_share, 0.0);
      EXPECT_NEAR(*check.wall_mm, 20.2, 1e-3);
      EXPECT_NEAR(check.contact_mm2, 30.3 * 30.3, 0.01);
      // Both ends are equally likely, and the plate's other axes are the object's.
      EXPECT_NEAR(
          (check.table_from_object - Eigen::Matrix3d(Vector3d(1, -1, -1).asDiagonal())).norm(), 0.0,
          1e-4);
      EXPECT_NEAR((check.print_size_mm - Vector3d(30.3, 30.3, 20.2)).norm(), 0.0, 5e-4);
      EXPECT_TRUE(check.notes.empty());
    }
  }
}

TEST(PrintLimits, ATenthOfADegreeMoreHangsOver) {
  const double steeper = std::tan(45.1 * std::numbers::pi / 180.0);
  for (const TriangleMesh& spool : Copies(Spool(steeper))) {
    EXPECT_GT(MeasureOverhang(spool, Vector3d::UnitZ(), 45.0, 0.2, RoundedBy(spool)).share, 0.1);
  }
  // Its edges are 44.9 degrees: walls that taper to nothing.
  EXPECT_LT(*CheckPrint(Spool(steeper), 30.3).wall_mm, 2.0);
}

TEST(PrintLimits, AStepOfExactlyTheFirstLayerRestsOnThePlate) {
  // Half of the bottom is raised by 0.2.
  const TriangleMesh step = shapes::Joined(
      Plate(2.0), Transformed(shapes::Box({40.0, 40.0, 2.0}), 1.0, {70.0, 20.0, 1.2}));
  for (const TriangleMesh& mesh : Copies(step)) {
    const Overhang overhang = MeasureOverhang(mesh, Vector3d::UnitZ(), 45.0, 0.2, RoundedBy(mesh));
    EXPECT_EQ(overhang.share, 0.0);
    EXPECT_NEAR(overhang.contact_area, 3200.0, 1.0);
    EXPECT_GT(MeasureOverhang(mesh, Vector3d::UnitZ(), 45.0, 0.19, RoundedBy(mesh)).share, 0.1);
  }
}

TEST(PrintLimits, AnAreaOnThePlateOfExactlyTheLimitNeedsNoRaft) {
  const auto notes = [](double width) {
    const TriangleMesh post = shapes::Box({2.0, 20.0, width});  // rests on 20 x `width`
    std::size_t most = 0;
    for (const TriangleMesh& copy : Copies(post)) {
      most = std::max(most, CheckPrint(copy, 20.0, {.min_contact_mm2 = 200.0}).notes.size());
    }
    return most;
  };
  EXPECT_EQ(notes(10.0), 0u);
  EXPECT_EQ(notes(9.99), 1u);
}

TEST(PrintLimits, ParallelSidesAreAWallAtAnyAngleHoweverTheyAreTurned) {
  const Eigen::Matrix3d turn =
      Eigen::Quaterniond(0.3, 0.5, -0.2, 0.7).normalized().toRotationMatrix();
  for (const TriangleMesh& plate : Copies(shapes::Rotated(shapes::Box({4, 5, 6}), turn))) {
    EXPECT_NEAR(
        *CheckPrint(plate, Bounds(plate).Extent().maxCoeff(), {.opposite_angle = 0.0}).wall_mm, 4.0,
        1e-3);
  }
}

TEST(PrintLimits, OfEquallyLikelyPosesTheSameIsSuggestedInEveryFile) {
  const PrintCheck first = CheckPrint(shapes::Box(Vector3d::Constant(20.3)), 20.3);
  for (const TriangleMesh& cube : Copies(shapes::Box(Vector3d::Constant(20.3)))) {
    const PrintCheck check = CheckPrint(cube, 20.3);
    EXPECT_NEAR((check.table_from_object - first.table_from_object).norm(), 0.0, 1e-4);
    EXPECT_NEAR(check.pose_probability, 1.0 / 6.0, 1e-4);
  }
}

TEST(PrintLimits, WhatSinglePrecisionLeavesOpenFarFromTheOriginIsSaid) {
  const TriangleMesh plate = Transformed(Plate(1.0), 1.0, {400000.3, 800000.7, 0.0});
  EXPECT_TRUE(CheckPrint(plate, 40.0).notes.empty());
  const PrintCheck check = CheckPrint(AsStl(plate), 40.0);
  EXPECT_NEAR(check.rounding_mm, 800040.7 / 16777216.0, 1e-4);
  ASSERT_EQ(check.notes.size(), 1u);
  EXPECT_TRUE(check.notes[0].starts_with("Lengths are known to 0.26 mm")) << check.notes[0];
}

TEST(PrintLimits, TheWallIsPointedOutOnTheMeshWhereItLies) {
  const Vector3d place(10000.0, 8000.0, 500.0);
  const PrintCheck check = CheckPrint(Transformed(Plate(0.5), 1.0, place), 40.0);
  const double height = check.wall_at.z() - place.z();
  EXPECT_NEAR(std::min(std::abs(height), std::abs(height - 0.5)), 0.0, 1e-6);
  EXPECT_GE(check.wall_at.x(), place.x());
}

}  // namespace
}  // namespace antigrasp
