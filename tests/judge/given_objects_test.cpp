// Tables of given grasps beside the objects of a command line.
#include "antigrasp/judge/given_objects.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/mesh/mesh_file.h"
#include "tests/support/csv_rows.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

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

#ifdef ANTIGRASP_HAS_MUJOCO
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
