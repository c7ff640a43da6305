// 3MF that lib3mf writes, read by our own reader of zip and XML.
#include "antigrasp/export/plate.h"

#include <gtest/gtest.h>

#include <utility>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/mesh/mass_properties.h"
#include "antigrasp/mesh/mesh_file.h"
#include "antigrasp/mesh/pieces.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using shapes::TempFolder;

MeshFile WrittenAndRead(const std::vector<std::pair<std::string, TriangleMesh>>& solids) {
  const TempFolder folder;
  Plate plate;
  for (const auto& [name, mesh] : solids) plate.Add(name, mesh);
  plate.Write(folder / "plate.3mf");
  return ReadMeshFile(folder / "plate.3mf");
}

TEST(Plate, AnOnlySolidStaysWhereItIsInMillimetres) {
  const TriangleMesh box = Transformed(shapes::Box({40.0, 20.0, 10.0}), 1.0, {7.0, -3.0, 5.0});
  const MeshFile read = WrittenAndRead({{"a <box> & \"its\" 'lid'", box}});
  ASSERT_TRUE(read.unit.has_value());
  EXPECT_EQ(read.unit->name, "mm");
  EXPECT_EQ(read.mesh.faces.size(), 12U);
  EXPECT_EQ(Bounds(read.mesh).min, Eigen::Vector3d(-13.0, -13.0, 0.0));
  EXPECT_EQ(Bounds(read.mesh).max, Eigen::Vector3d(27.0, 7.0, 10.0));
  EXPECT_DOUBLE_EQ(ComputeMassProperties(read.mesh).volume, 8000.0);
}

// Three in two columns: rows begin at 0 and are as deep as their deepest, 5 mm between.
TEST(Plate, SeveralStandInRowsFiveMillimetresApart) {
  const TriangleMesh wide = shapes::Box({40.0, 20.0, 10.0}), cube = shapes::Box({30.0, 30.0, 30.0});
  const MeshFile read = WrittenAndRead({{"a", wide}, {"b", cube}, {"c", wide}});
  EXPECT_EQ(read.mesh.faces.size(), 36U);
  EXPECT_EQ(Bounds(read.mesh).min, Eigen::Vector3d(0.0, 0.0, -15.0));
  EXPECT_EQ(Bounds(read.mesh).max, Eigen::Vector3d(75.0, 55.0, 15.0));
  EXPECT_DOUBLE_EQ(ComputeMassProperties(read.mesh).volume, 43000.0);
}

TEST(Plate, EqualPlatesAreEqualBytesAndOthersAreNot) {
  const TempFolder folder;
  const auto bytes = [&](const std::string& second, double size) {
    Plate plate;
    plate.Add("a", shapes::Sphere(10.0, 2));
    plate.Add(second, shapes::Sphere(size, 2));
    plate.Write(folder / "p.3mf");
    return ReadFile(folder / "p.3mf");
  };
  const std::string first = bytes("a", 10.0);  // the same twice
  EXPECT_EQ(bytes("a", 10.0), first);
  EXPECT_NE(bytes("b", 10.0), first);
  EXPECT_NE(bytes("a", 11.0), first);
}

TEST(Plate, WhatIsNoSolidIsRefused) {
  const TempFolder folder;
  Plate plate;
  plate.Add("sheet", shapes::FlatSquare());
  EXPECT_THROW(plate.Write(folder / "p.3mf"), RuntimeFailure);
}

}  // namespace
}  // namespace antigrasp
