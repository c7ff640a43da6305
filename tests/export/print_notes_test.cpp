#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "antigrasp/core/error.h"
#include "antigrasp/export/print_check.h"
#include "tests/support/shapes.h"

// The pose in its three criteria, and that every number and every option is where it belongs.
namespace antigrasp {
namespace {

using Eigen::Vector3d;

// A square tower of height 2: 1 x 1 at both ends, 1.5 x 1.5 at height 0.5.
TriangleMesh Tower(bool upside_down) {
  TriangleMesh mesh;
  const double half[] = {0.5, 0.75, 0.5}, height[] = {0.0, 0.5, 2.0};
  for (int level = 0; level < 3; ++level) {
    for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
      mesh.vertices.push_back({half[level] * x, half[level] * y, height[level]});
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
  if (!upside_down) return mesh;
  return shapes::Rotated(mesh, Vector3d(1.0, -1.0, -1.0).asDiagonal());
}

TEST(PrintPose, OfTwoThatPrintAlikeTheOneWithTheLowerCentreOfMassIsSuggested) {
  // Both ends of the tower are alike: 1 x 1 on the plate, slopes of 27 and 9 degrees. Its centre of
  // mass is nearer to the wide end. On a slanted side another slope hangs over.
  for (const bool upside_down : {false, true}) {
    const PrintCheck check = CheckPrint(Tower(upside_down), 20.0);
    EXPECT_EQ(check.why_not_solid, "");
    EXPECT_NEAR(check.table_from_object(2, 2), upside_down ? -1.0 : 1.0, 1e-9);
    EXPECT_EQ(check.overhang_share, 0.0);
    EXPECT_NEAR(check.contact_mm2, 100.0, 1e-6);
  }
}

TEST(PrintPose, LessOverhangIsWorthAnUnlikelyPoseWithLittleContact) {
  // The lying tower rests on a big side, likelier and with more contact, and hangs over.
  const TriangleMesh tower = Tower(false);
  const PrintCheck check = CheckPrint(tower, 20.0);
  EXPECT_LT(check.pose_probability, 0.2);
  // With steeper undersides allowed than the lying one has, it lies.
  const PrintCheck lying = CheckPrint(tower, 20.0, {.overhang_angle = 60.0});
  EXPECT_LT(std::abs(lying.table_from_object(2, 2)), 0.3);
  EXPECT_EQ(lying.overhang_share, 0.0);
  EXPECT_GT(lying.contact_mm2, 100.0);
  EXPECT_GT(lying.pose_probability, check.pose_probability);
}

TEST(PrintCheck, HoldsItsSizesAsItIsAndAsItStands) {
  const PrintCheck check = CheckPrint(shapes::Box({2.0, 0.8, 1.0}), 40.0);
  EXPECT_NEAR(check.mm_per_unit, 20.0, 1e-12);
  EXPECT_NEAR((check.size_mm - Vector3d(40.0, 16.0, 20.0)).norm(), 0.0, 1e-9);
  EXPECT_NEAR(check.print_size_mm.z(), 16.0, 1e-6);
  EXPECT_NEAR(check.print_size_mm.head<2>().maxCoeff(), 40.0, 1e-6);
  EXPECT_NEAR(check.print_size_mm.head<2>().minCoeff(), 20.0, 1e-6);
  EXPECT_NEAR(*check.wall_mm, 16.0, 1e-3);
  EXPECT_NEAR(std::abs(check.wall_at.y()), 0.4, 1e-6);  // on the mesh, in its own unit
}

TEST(PrintCheck, EveryNoteNamesItsOwnNumbers) {
  // A sheet of 30 x 20 x 0.5 mm.
  const PrintCheck plate = CheckPrint(shapes::Box({3.0, 2.0, 0.05}), 30.0);
  ASSERT_EQ(plate.notes.size(), 1u);
  EXPECT_TRUE(plate.notes[0].starts_with("The thinnest wall is 0.5 mm, below 0.8 mm; "));
  char share[64];
  std::snprintf(share, sizeof share, "%.1f %% of the surface belongs to such walls.",
                100.0 * plate.thin_share);
  EXPECT_TRUE(plate.notes[0].ends_with(share)) << plate.notes[0];
  EXPECT_NEAR(plate.thin_share, 12.0 / 12.5, 0.02);
  // The pencil lies: of 24 sides two hang over, 4 % of the surface beside 0 % in thin walls.
  PrintOptions options;
  options.max_overhang = 0.03;
  options.min_wall_mm = 0.01;
  options.min_contact_mm2 = 1e4;
  const PrintCheck pencil = CheckPrint(shapes::Cylinder(0.05, 2.0, 24), 100.0, options);
  ASSERT_EQ(pencil.notes.size(), 2u);
  std::snprintf(share, sizeof share, "%.0f %% of the surface", 100.0 * pencil.overhang_share);
  EXPECT_EQ(pencil.notes[0],
            std::string(share) + " hangs over by more than 45 degrees and needs support.");
  EXPECT_GT(pencil.overhang_share, 0.05);
  EXPECT_TRUE(pencil.notes[1].ends_with(" mm2 lie on the plate: print it on a raft."));
  std::snprintf(share, sizeof share, "Only %.2g mm2 lie", pencil.contact_mm2);
  EXPECT_TRUE(pencil.notes[1].starts_with(share));
}

TEST(PrintCheck, EveryOptionReachesItsCheck) {
  // The wedge of 40 degrees: a wall at 45, none between its slanted sides at 30.
  const double h = std::tan(20.0 * std::numbers::pi / 180.0);
  const TriangleMesh wedge{
      {{0, 0, 0}, {0, 9, 0}, {1, 0, h}, {1, 9, h}, {1, 0, -h}, {1, 9, -h}},
      {{0, 3, 1}, {0, 2, 3}, {0, 1, 5}, {0, 5, 4}, {2, 4, 5}, {2, 5, 3}, {0, 4, 2}, {1, 3, 5}}};
  EXPECT_LT(*CheckPrint(wedge, 90.0).wall_mm, 4.0);
  EXPECT_NEAR(*CheckPrint(wedge, 90.0, {.opposite_angle = 30.0}).wall_mm, 90.0, 0.01);
  // What rests of a ball within the first layer grows with it.
  const TriangleMesh ball = shapes::Sphere(1.0, 4);
  EXPECT_GT(CheckPrint(ball, 60.0, {.layer_mm = 0.6}).contact_mm2,
            2.0 * CheckPrint(ball, 60.0, {.layer_mm = 0.2}).contact_mm2);
  const PrintCheck inside = CheckPrint(shapes::Inverted(shapes::Cube()), 10.0);
  EXPECT_FALSE(inside.watertight);  // closed, but wound inward
  EXPECT_TRUE(CheckPrint(shapes::Cube(), 10.0).watertight);
}

TEST(PrintOptions, AreThoseOfTheHandbookUnderTheirOwnKeys) {
  PrintOptions options;
  EXPECT_EQ(options.min_wall_mm, 0.8);
  EXPECT_EQ(options.overhang_angle, 45.0);
  EXPECT_EQ(options.max_overhang, 0.05);
  EXPECT_EQ(options.layer_mm, 0.2);
  EXPECT_EQ(options.opposite_angle, 45.0);
  EXPECT_EQ(options.min_probability, 0.01);
  EXPECT_EQ(options.min_contact_mm2, 10.0);
  OptionTable table;
  Bind(&table, &options);
  const std::pair<const char*, double*> keys[] = {
      {"print.min_wall_mm", &options.min_wall_mm},
      {"print.overhang_angle", &options.overhang_angle},
      {"print.max_overhang", &options.max_overhang},
      {"print.layer_mm", &options.layer_mm},
      {"print.opposite_angle", &options.opposite_angle},
      {"print.min_probability", &options.min_probability},
      {"print.min_contact_mm2", &options.min_contact_mm2}};
  double value = 0.125;
  for (const auto& [key, field] : keys) {
    table.ApplyOverride(std::string(key) + "=" + std::to_string(value));
    EXPECT_EQ(*field, value) << key;
    value += 0.0625;
  }
  EXPECT_THROW(table.ApplyOverride("print.overhang_angle=91"), InputError);
}

TEST(PrintNotes, SayThatAVoidIsClosedIn) {
  const TriangleMesh block = shapes::Box({4, 4, 10});
  const auto void_at = [](double z) {
    return shapes::Inverted(Transformed(shapes::Box({2, 2, 2}), 1.0, {0, 0, z}));
  };
  const auto says = [](const PrintCheck& check, const std::string& note) {
    return std::find(check.notes.begin(), check.notes.end(), note) != check.notes.end();
  };
  EXPECT_EQ(CheckPrint(block, 50.0).voids, 0);
  TriangleMesh hollow = shapes::Joined(block, void_at(2.0));
  const PrintCheck one = CheckPrint(hollow, 50.0);
  EXPECT_EQ(one.why_not_solid, "");
  EXPECT_TRUE(one.watertight);
  EXPECT_NEAR(*one.wall_mm, 5.0, 1e-4);  // one unit, between block and void
  EXPECT_TRUE(says(one, "A void is closed in: powder, resin or support stays inside."));
  hollow = shapes::Joined(hollow, void_at(-2.0));
  EXPECT_TRUE(says(CheckPrint(hollow, 50.0),
                   "2 voids are closed in: powder, resin or support stays inside."));
}

}  // namespace
}  // namespace antigrasp
