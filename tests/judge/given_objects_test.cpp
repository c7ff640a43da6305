// Tables of given grasps beside the objects of a command line.
#include "antigrasp/judge/given_objects.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/grasp_io/grasp_json.h"
#include "antigrasp/mesh/mesh_file.h"
#include "antigrasp/quality/named_gripper.h"
#include "tests/support/csv_rows.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;
using shapes::CsvRows;

const std::string kHeader = "object,center_x,center_y,center_z,axis_x,axis_y,axis_z,width\n";

// Boxes of 40 x 45 x 60 mm, a sheet without a volume.
class GivenObjects : public testing::Test {
 protected:
  GivenObjects() {
    const TriangleMesh box = shapes::Box({40.0, 45.0, 60.0});
    WriteMesh(folder_ / "a.stl", box);
    WriteMesh(folder_ / "b.stl", Transformed(box, 1.0, {500.0, 0.0, 0.0}));
    WriteMesh(folder_ / "open.stl", shapes::FlatSquare());
    metric_.object_min_extent = 0.0;
    metric_.units = LengthUnit::kMm;
    metric_.num_draws = 5;
    options_.draws = 2;
  }
  GivenReport Score(const std::string& table, const std::vector<std::string>& objects,
                    GivenRequest request = {}) {
    for (const std::string& name : objects) request.inputs.push_back((folder_ / name).string());
    request.grasps = folder_.Write("g.csv", table).string();
    SilentObserver observer;
    return ScoreGiven(request, metric_, metric_, options_, &observer);
  }
  std::string WhyNot(const std::string& table, const std::vector<std::string>& objects) {
    try {
      GivenRequest request;
      request.out = (folder_ / "out.csv").string();
      Score(table, objects, request);
    } catch (const InputError& error) {
      EXPECT_FALSE(std::filesystem::exists(folder_ / "out.csv"));
      return error.what();
    }
    return "";
  }

  shapes::TempFolder folder_;
  MetricOptions metric_;
  PhysicsTrialOptions options_;
};

TEST_F(GivenObjects, EveryRowBelongsToTheObjectOfItsName) {
  const GivenReport report = Score(kHeader +
                                       "b,500,0,0,1,0,0,\n"      // without the extension
                                       "a.stl,0,0,0,0,1,0,50\n"  // as wide as they open
                                       "other,0,0,0,1,0,0,\n"
                                       "b.stl,0,0,0,1,0,0,\n"  // where a lies
                                       "a.stl,0,0,0,0,0,1,60\n"
                                       "a.stl,0,nan,0,0,0,1,\n"
                                       "open.stl,0,0,0,1,0,0,\n",
                                   {"a.stl", "b.stl", "open.stl"});
  const auto file = folder_.Write("rows.csv", report.table);
  const auto rows = CsvRows(file);
  ASSERT_EQ(rows.size(), 6U);
  std::string text;
  for (const auto& row : rows) {
    text += row.at("object") + " " + row.at("grasp") + " " + row.at("status") + "\n";
  }
  EXPECT_EQ(text.substr(0, text.rfind("open: ")),
            "a.stl 0 ok\na.stl 1 too wide\na.stl 2 no pose\nb.stl 0 ok\nb.stl 0 misses\n"
            "open.stl 0 ");
  EXPECT_NEAR(std::stod(rows[0].at("width")), 0.045, 1e-9);
  EXPECT_NEAR(std::stod(rows[3].at("width")), 0.04, 1e-9);
  EXPECT_GT(std::stod(rows[3].at("epsilon")), 0.0);
  EXPECT_EQ(rows[4].at("epsilon"), "0");
  EXPECT_EQ(rows[1].at("epsilon") + rows[1].at("robust_quality") + rows[1].at("reachable"), "");
  EXPECT_EQ(rows[5].at("robust_quality"), "");
  ASSERT_EQ(report.summary.size(), 3U);
  EXPECT_TRUE(report.summary[0].starts_with(
      "6 grasps of 3 objects: 2 ok, 1 too wide, 1 no pose, 1 misses, 1 open: "))
      << report.summary[0];
  EXPECT_TRUE(report.summary[1].starts_with("mean robust quality 0.0")) << report.summary[1];
  EXPECT_TRUE(report.summary[1].ends_with("above 0: 66.7 %, the gripper gets to 100.0 %"))
      << report.summary[1];
  EXPECT_EQ(report.summary[2], "1 grasps of other objects are left out");
}

TEST_F(GivenObjects, AnOnlyObjectTakesRowsOfItsNameAndWithoutAny) {
  for (const char* name : {"a", "a.obj", "set/a.stl", ""}) {
    const std::string row = name + std::string(",0,0,0,1,0,0,\n");
    EXPECT_TRUE(Score(kHeader + row, {"a.stl"}).summary[0].ends_with("1 ok")) << name;
  }
  EXPECT_EQ(WhyNot(kHeader + "mug,0,0,0,1,0,0,\n", {"a.stl"}),
            "grasps of mug, no grasp of a.stl (" + (folder_ / "g.csv").string() +
                "): expected the names of the objects that are scored in the column object");
  EXPECT_NE(WhyNot(kHeader + "x,0,0,0,1,0,0,\ny,0,0,0,1,0,0,\nz,0,0,0,1,0,0,\n", {"a.stl"})
                .find("grasps of x, y and 1 more, no grasp of a.stl"),
            std::string::npos);
  EXPECT_TRUE(
      Score("p1x,p1y,p1z,p2x,p2y,p2z\n-20,0,0,20,0,0\n", {"a.stl"}).summary[0].ends_with("1 ok"));
  EXPECT_NE(WhyNot(kHeader + "mug,0,0,0,1,0,0,\n", {"a.stl", "b.stl"}).find("no grasp of a.stl"),
            std::string::npos);
}

// Boxes of millimetres at true size: 0.001 m a unit.
TEST_F(GivenObjects, ATableOfAnotherScaleIsRefusedInEitherFrame) {
  const std::string header =
      "center_x,center_y,center_z,axis_x,axis_y,axis_z,metres_per_unit,frame\n";
  for (const char* frame : {"metres", "mesh"}) {
    const auto row = [&](const std::string& scale) {
      return header + "0,0,0,1,0,0," + scale + "," + frame + "\n";
    };
    EXPECT_TRUE(Score(row("0.001"), {"a.stl"}).summary[0].ends_with("1 ok"));
    EXPECT_EQ(WhyNot(row("0.025"), {"a.stl"}),
              "grasps of a.stl at metres_per_unit 0.025, which is scored at 0.001 (" +
                  (folder_ / "g.csv").string() +
                  "): expected --units, --true-size and --object-min-extent as when it was "
                  "written");
  }
  EXPECT_TRUE(
      Score(header + "0,0,0,1,0,0,,mesh\n", {"a.stl"}).summary[0].ends_with("1 ok"));  // no number
}

TEST_F(GivenObjects, GraspsBesideTheirObjectAreCountedAndWarnedOf) {
  const GivenReport report = Score(kHeader + "a,0.0,0.2,0,1,0,0,\na,0,90,0,1,0,0,\n", {"a.stl"});
  EXPECT_TRUE(report.warnings.empty()) << report.warnings[0];
  const GivenReport none = Score(kHeader + "a,0,70,0,1,0,0,\na,0,90,0,1,0,0,\n", {"a.stl"});
  EXPECT_TRUE(none.summary[0].ends_with("2 misses")) << none.summary[0];
  ASSERT_EQ(none.warnings.size(), 1U);
  EXPECT_NE(none.warnings[0].find("unit and frame of the mesh"), std::string::npos);
  EXPECT_NE(
      WhyNot(kHeader + "open,0,0,0,1,0,0,\n", {"open.stl"}).find("no object scored; open.stl"),
      std::string::npos);
}

// Boxes of 40 mm, which a call without --true-size would rescale to 40 mm as well; the file says
// 0.9.
TEST_F(GivenObjects, AFileOfGraspsNamesItsMeshAndTheScaleThatItIsFor) {
  const auto file = [&](const std::string& object, double scale) {
    GraspSet set{
        object, scale, {}, {{"0", {0.0, 0.0, 0.0}, Vector3d::UnitX(), -Vector3d::UnitZ()}}};
    GraspFileAbout about;
    about.base = BaseOf("yumi");
    return folder_.Write("g.json", GraspGenJson(set, about)).string();
  };
  const auto score = [&](double min_extent) {
    metric_.object_min_extent = min_extent;
    GivenRequest request;
    request.inputs = {(folder_ / "b.stl").string(), (folder_ / "a.stl").string()};
    request.grasps = (folder_ / "g.json").string();
    request.output.about.base = BaseOf("yumi");
    SilentObserver observer;
    return ScoreGiven(request, metric_, metric_, options_, &observer);
  };
  file("meshes/a.stl", 0.0009);
  const GivenReport report = score(0.04);
  EXPECT_EQ(report.summary.back(),
            "1 objects scored at the scale that " + (folder_ / "g.json").string() + " says");
  const auto rows = CsvRows(folder_.Write("rows.csv", report.table));
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].at("object") + rows[0].at("status"), "a.stlok");
  EXPECT_NEAR(std::stod(rows[0].at("width")), 0.036, 1e-9);
  EXPECT_THROW(score(0.0), InputError);  // at true size, 0.001
  file("meshes/a.stl", 0.001);
  EXPECT_EQ(score(0.0).summary.size(), 2U);
  file("c.stl", 0.001);
  EXPECT_THROW(score(0.0), InputError);
}

TEST_F(GivenObjects, GivenGraspsAreWrittenAgainWithTheirLabels) {
  GivenRequest request;
  request.output.path = (folder_ / "g.h5").string();
  request.output.about.base = BaseOf("yumi");
  Score(kHeader + "a,0,0,0,0,1,0,\na,0,90,0,1,0,0,\na,nan,0,0,1,0,0,\n", {"a.stl"}, request);
  const auto tree = Hdf5Tree::Open(folder_ / "g.h5");
  const auto quality = tree->Numbers("/grasps/qualities/antigrasp/robust_quality")->values;
  ASSERT_EQ(quality.size(), 2U);  // what has no pose is left out
  EXPECT_GT(quality[0], 0.002);
  EXPECT_EQ(quality[1], 0.0);
  const auto held = tree->Numbers("/grasps/qualities/flex/object_in_gripper")->values;
  EXPECT_EQ(held, (std::vector<double>{1.0, 0.0}));
  EXPECT_NEAR(tree->Numbers("/grasps/qualities/antigrasp/width")->values[0], 0.045, 1e-9);
}

#ifdef ANTIGRASP_HAS_MUJOCO
// The label is the trial's, whatever the quality; both are kept.
TEST_F(GivenObjects, AFileOfTriedGraspsHasWhatWasHeld) {
  GivenRequest request;
  request.in_physics = true;
  request.output.path = (folder_ / "g.h5").string();
  request.output.about.base = BaseOf("yumi");
  request.output.about.success_quality = 1e9;
  request.output.about.protocol = "six-ways";
  metric_.object_translation_std = metric_.grasp_translation_std = 0.0;
  const std::string table =
      "center_x,center_y,center_z,axis_x,axis_y,axis_z,approach_x,approach_y,approach_z\n"
      "0,0,0,1,0,0,0,0,-1\n0,70,0,1,0,0,0,0,-1\n";
  Score(table, {"a.stl"}, request);
  const auto tree = Hdf5Tree::Open(folder_ / "g.h5");
  const auto of = [&](const std::string& name) {
    return tree->Numbers("/grasps/qualities/" + name)->values;
  };
  EXPECT_EQ(of("flex/object_in_gripper"), (std::vector<double>{1.0, 0.0}));
  EXPECT_EQ(of("antigrasp/executions"), (std::vector<double>{2.0, 2.0}));
  EXPECT_EQ(of("antigrasp/held"), (std::vector<double>{2.0, 0.0}));
  EXPECT_GT(of("antigrasp/robust_quality")[0], 0.0);
}

// A grasp across the box is held, one beside it is not touched, and one that comes from the corner
// is reached in no pose. Two executions each.
TEST_F(GivenObjects, InPhysicsEveryGraspHasItsOwnShareHeld) {
  GivenRequest request;
  request.in_physics = true;
  request.out = (folder_ / "out.csv").string();
  request.threads = 1;
  const std::string table =
      "object,center_x,center_y,center_z,axis_x,axis_y,axis_z,approach_x,approach_y,approach_z\n"
      "a,0,0,0,0,0,0,0,0,-1\n"
      "a,0,0,0,1,0,0,0,0,-1\n"
      "a,0,70,0,1,0,0,0,0,-1\n"
      "a,0,0,0,1,-1,0,-1,-1,-1\n"
      "b,500,0,0,1,0,0,0,0,-1\n";
  metric_.object_translation_std = metric_.grasp_translation_std = 0.0;
  const GivenReport report = Score(table, {"a.stl", "b.stl"}, request);
  EXPECT_EQ(report.table, "");
  const auto rows = CsvRows(folder_ / "out.csv");
  ASSERT_EQ(rows.size(), 5U);
  std::string text;
  for (const auto& row : rows) {
    text += row.at("trial") + "," + row.at("executions") + "," + row.at("held") + "\n";
  }
  EXPECT_EQ(text, "not scored,0,\nok,2,1\nok,2,0\nnot reachable,0,\nok,2,1\n");
  EXPECT_EQ(rows[0].at("pose") + rows[3].at("pose"), "");
  EXPECT_EQ(report.summary.back(),
            "in physics: 1 not scored, 3 executed, 1 not reachable; held 66.7 % of 6 executions");
  const std::string toml = ReadFile(folder_ / "out.csv.trial.toml");
  EXPECT_NE(toml.find("protocol = \"six-ways\""), std::string::npos) << toml;
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out.csv.metric.toml"));
  const std::string one = ReadFile(folder_ / "out.csv");
  request.threads = 3;
  Score(table, {"a.stl", "b.stl"}, request);
  EXPECT_EQ(ReadFile(folder_ / "out.csv"), one);
}
#endif

}  // namespace
}  // namespace antigrasp
