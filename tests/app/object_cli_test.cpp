// The commands dataset, remesh, export and info: every column and line by its name.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <filesystem>

#include "antigrasp/datasets/prior_set.h"
#include "antigrasp/mesh/mesh_file.h"
#include "antigrasp/sdf/remesh.h"
#include "tests/app/run_binary.h"
#include "tests/support/csv_rows.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;
using cli::Antigrasp;
using cli::Outcome;
using shapes::CsvRows;
using shapes::TempFolder;

void ExpectLine(const std::string& text, const std::string& line) {
  EXPECT_NE(text.find(line + "\n"), std::string::npos) << line << "\nis not in\n" << text;
}

TEST(ObjectCli, MakesTheSetOfTheAskedKindCountAndSeedAndSaysWhatItIs) {
  const TempFolder folder;
  const std::string path = (folder / "p.h5").string();
  const Outcome made = Antigrasp("dataset make prisms --count 3 --seed 5 --out " + path);
  ASSERT_EQ(made.code, 0) << made.text;
  ExpectLine(made.text, path + ": 3 prisms, 32^3, seed 5");
  PriorSetOptions options;
  options.kind = "prisms";
  options.count = 3;
  options.seed = 5;
  const ShapeSet expected = MakePriorSet(options), set = ReadShapeSet(path);
  ASSERT_EQ(set.grids.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(set.grids[i].values, expected.grids[i].values);
  const std::string info = Antigrasp("info " + path).text;
  ExpectLine(info, "  kind        prisms");
  ExpectLine(info, "  shapes      3 of 32^3");
  ExpectLine(info, "  spacing     0.03125 (unit cube), positive inside");
  ExpectLine(info, "  values      exact distances");
  ExpectLine(info, "  seed        5");
}

TEST(ObjectCli, RemeshSaysOfEveryGridHowLargeItsMeshIs) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  PriorSetOptions options;
  options.count = 2;
  ShapeSet set = MakePriorSet(options);
  for (float& value : set.grids[1].values) value = -1.0F;
  WriteShapeSet(folder / "p.h5", set);
  const Outcome outcome = Antigrasp("remesh " + dir + "p.h5 --format off --out " + dir + "m");
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  ExpectLine(outcome.text, "2 objects: 1 ok, 1 empty");
  auto rows = CsvRows(folder / "m/remesh.csv");
  ASSERT_EQ(rows.size(), 2U);
  const TriangleMesh mesh = Remesh(set.grids[0]).mesh;
  ASSERT_NE(mesh.vertices.size(), mesh.faces.size());
  EXPECT_EQ(rows[0]["object"], set.names[0]);
  EXPECT_EQ(rows[0]["status"], "ok");
  EXPECT_EQ(rows[0]["vertices"], std::to_string(mesh.vertices.size()));
  EXPECT_EQ(rows[0]["faces"], std::to_string(mesh.faces.size()));
  EXPECT_EQ(std::stod(rows[0]["volume"]), Volume(mesh));
  EXPECT_EQ(std::stod(rows[0]["area"]), SurfaceArea(mesh));
  EXPECT_EQ(rows[1]["status"], "empty");
  EXPECT_EQ(ReadMesh(folder / "m" / (set.names[0] + ".off")).faces.size(), mesh.faces.size());
  EXPECT_FALSE(fs::exists(folder / "m" / (set.names[1] + ".off")));
}

TEST(ObjectCli, ImportReportsEveryMeshAndCountsByVerdict) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  fs::create_directory(folder / "in");
  WriteMesh(folder / "in/a.obj", shapes::Cube());
  for (const char* name : {"b.obj", "c.obj"}) {
    WriteMesh(folder / "in" / name, shapes::Inverted(shapes::Cube()));
  }
  for (const char* name : {"d.obj", "e.obj", "f.obj"}) {
    WriteMesh(folder / "in" / name, shapes::FlatSquare());
  }
  const Outcome outcome = Antigrasp("dataset import " + dir + "in --out " + dir +
                                    "set.h5 --report " + dir + "report.csv");
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  ExpectLine(outcome.text, dir + "set.h5: 3 shapes (1 accepted, 2 repaired, 3 refused)");
  EXPECT_EQ(ReadShapeSet(folder / "set.h5").grids.size(), 3U);
  auto rows = CsvRows(folder / "report.csv");
  ASSERT_EQ(rows.size(), 6U);
  EXPECT_TRUE(rows[0]["path"].ends_with("a.obj"));
  EXPECT_EQ(rows[0]["status"], "accepted");
  EXPECT_EQ(rows[0]["detail"], "");
  EXPECT_TRUE(rows[1]["path"].ends_with("b.obj"));
  EXPECT_EQ(rows[1]["status"], "repaired");
  EXPECT_NE(rows[1]["detail"], "");
  EXPECT_TRUE(rows[3]["path"].ends_with("d.obj"));
  EXPECT_EQ(rows[3]["status"], "refused");
  EXPECT_EQ(rows[3]["detail"], "open: 4 boundary edges");
}

TEST(ObjectCli, InfoDescribesAMesh) {
  const TempFolder folder;
  const auto info = [&](const TriangleMesh& mesh) {
    WriteMesh(folder / "m.off", mesh);
    return Antigrasp("info " + (folder / "m.off").string()).text;
  };
  const std::string box = info(shapes::Box({1.0, 2.0, 3.0}));
  EXPECT_NE(box.find(": mesh, 8 vertices, 12 faces\n"), std::string::npos) << box;
  ExpectLine(box, "  extent             1 x 2 x 3");
  ExpectLine(box, "  watertight         yes");
  ExpectLine(box, "  winding consistent yes");
  ExpectLine(box, "  outward            yes");
  ExpectLine(box, "  self-intersecting  no");
  ExpectLine(box, "  components         1");
  ExpectLine(box, "  genus              0");
  ExpectLine(box, "  volume             6");
  ExpectLine(box, "  area               22");
  ExpectLine(box, "  printable solid    yes");
  const std::string inverted = info(shapes::Inverted(shapes::Cube()));
  ExpectLine(inverted, "  watertight         yes");
  ExpectLine(inverted, "  winding consistent yes");
  ExpectLine(inverted, "  outward            no");
  EXPECT_NE(inverted.find("  printable solid    no: "), std::string::npos) << inverted;
  const std::string open = info(shapes::FlatSquare());
  ExpectLine(open, "  watertight         no");
  ExpectLine(open, "  winding consistent yes");
  ExpectLine(info(shapes::Torus(1.0, 0.4, 16, 8)), "  genus              1");
  const std::string crossed = info(shapes::Joined(shapes::Cube(), shapes::Box({0.5, 0.5, 3.0})));
  ExpectLine(crossed, "  self-intersecting  yes");
  ExpectLine(crossed, "  components         2");
}

TEST(ObjectCli, ExportPutsAllObjectsOnOnePlateAndReplacesItWhenAsked) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  WriteMesh(folder / "a.stl", shapes::Box({40.0, 20.0, 10.0}));
  WriteMesh(folder / "b.stl", shapes::Cube());
  const std::string both = "export " + dir + "a.stl " + dir + "b.stl --format 3mf --out " + dir;
  ASSERT_EQ(Antigrasp(both + "out").code, 0);
  EXPECT_EQ(shapes::CountFiles(folder / "out"), 2);
  EXPECT_EQ(ReadMesh(folder / "out/plate.3mf").faces.size(), 24U);
  cli::ExpectRefused(both + "out", "holds print.csv already");
  ASSERT_EQ(Antigrasp("export " + dir + "b.stl --overwrite --format 3mf --out " + dir + "out").code,
            0);
  EXPECT_EQ(ReadMesh(folder / "out/plate.3mf").faces.size(), 12U);
}

TEST(ObjectCli, ExportSaysHowATiltedSlabIsPrinted) {
  // A slab of 1 x 2 x 4 turned about a skew axis: 4 is its longest side, but not its largest
  // extent. It lies best on its largest side.
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.5, Eigen::Vector3d(1.0, 2.0, 3.0).normalized()).toRotationMatrix();
  const TriangleMesh slab = shapes::Rotated(shapes::Box({1.0, 2.0, 4.0}), turn);
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  WriteMesh(folder / "slab.off", slab);
  const Outcome outcome = Antigrasp(
      "export " + dir + "slab.off --size-mm 80 --pose print --format off --out " + dir + "out");
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  auto rows = CsvRows(folder / "out/print.csv");
  ASSERT_EQ(rows.size(), 1U);
  const auto number = [&](const std::string& name) { return std::stod(rows[0].at(name)); };
  const Eigen::Vector3d extent = Bounds(slab).Extent();
  const double mm = 80.0 / extent.maxCoeff();
  const Eigen::Vector3d size(number("size_x_mm"), number("size_y_mm"), number("size_z_mm"));
  EXPECT_LT((size - mm * extent).norm(), 1e-6);
  EXPECT_EQ(rows[0]["object"], "slab.off");
  EXPECT_EQ(rows[0]["watertight"], "1");
  EXPECT_NEAR(number("wall_mm"), mm, 1e-3 * mm);
  EXPECT_EQ(number("thin_share"), 0.0);
  EXPECT_EQ(number("overhang_share"), 0.0);
  EXPECT_NEAR(number("contact_mm2"), 8.0 * mm * mm, 1e-6 * mm * mm);
  EXPECT_GT(number("pose_probability"), 0.3);
  EXPECT_LT(number("pose_probability"), 0.5);  // the other side is as likely
  EXPECT_NEAR(number("print_z_mm"), mm, 1e-6 * mm);
  Eigen::Matrix3d pose;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) pose(r, c) = number("r" + std::to_string(r) + std::to_string(c));
  }
  // Rows are the plate's axes in the object's frame: up is the slab's short side.
  const Eigen::Vector3d up = pose.row(2).transpose();
  EXPECT_NEAR(std::abs(up.dot(turn.col(0))), 1.0, 1e-9);
  const Eigen::Vector3d printed = Bounds(shapes::Rotated(slab, pose)).Extent();
  EXPECT_NEAR(number("print_x_mm"), mm * printed.x(), 1e-6 * mm);
  EXPECT_NEAR(number("print_y_mm"), mm * printed.y(), 1e-6 * mm);
  const BoundingBox written = Bounds(ReadMesh(folder / "out/slab.off"));
  EXPECT_LT((written.Extent() - mm * printed).norm(), 1e-4);
  EXPECT_NEAR(written.min.z(), 0.0, 1e-4);
  EXPECT_NEAR(written.Center().x(), 0.0, 1e-4);
}

}  // namespace
}  // namespace antigrasp
