// Objects before and after a change, as a set to train on.
#include "antigrasp/judge/pair_dataset.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/datasets/object_names.h"
#include "antigrasp/judge/make_judge.h"
#include "antigrasp/judge/pair_split.h"
#include "antigrasp/judge/pair_tables.h"
#include "antigrasp/mesh/mesh_file.h"
#include "antigrasp/quality/given_grasps.h"
#include "tests/support/csv_rows.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using shapes::CsvRows;

std::map<std::string, int> CountsOf(const std::vector<std::string>& splits) {
  std::map<std::string, int> counts;
  for (const std::string& split : splits) ++counts[split];
  return counts;
}

TEST(SplitOf, SharesAreExactAndAnObjectKeepsItsPlaceInAnyOrder) {
  std::vector<std::string> names;
  std::vector<std::uint64_t> streams;
  for (int i = 0; i < 50; ++i) {
    names.push_back("object-" + std::to_string(i));
    streams.push_back(StreamOf(names.back()));
  }
  const std::vector<std::string> splits = SplitOf(names, streams, 0.7, 0.1, 5);
  EXPECT_EQ(CountsOf(splits),
            (std::map<std::string, int>{{"test", 10}, {"train", 35}, {"val", 5}}));
  EXPECT_NE(SplitOf(names, streams, 0.7, 0.1, 6), splits);
  std::reverse(names.begin(), names.end());
  std::reverse(streams.begin(), streams.end());
  std::vector<std::string> turned = SplitOf(names, streams, 0.7, 0.1, 5);
  std::reverse(turned.begin(), turned.end());
  EXPECT_EQ(turned, splits);
  const auto few = [&](std::size_t count, double train, double val) {
    return CountsOf(SplitOf({names.begin(), names.begin() + static_cast<std::ptrdiff_t>(count)},
                            {streams.begin(), streams.begin() + static_cast<std::ptrdiff_t>(count)},
                            train, val, 5));
  };
  using Count = std::map<std::string, int>;
  EXPECT_EQ(few(3, 0.8, 0.1), (Count{{"test", 1}, {"train", 1}, {"val", 1}}));
  // Of fewer than the splits: to train on first, then to test on.
  EXPECT_EQ(few(1, 0.8, 0.1), (Count{{"train", 1}}));
  EXPECT_EQ(few(2, 0.8, 0.1), (Count{{"test", 1}, {"train", 1}}));
  EXPECT_EQ(few(1, 0.0, 0.5), (Count{{"test", 1}}));
  EXPECT_EQ(few(4, 0.2, 0.4), (Count{{"test", 2}, {"train", 1}, {"val", 1}}));
  EXPECT_EQ(few(4, 1.0, 0.0), (Count{{"train", 4}}));
  EXPECT_EQ(few(4, 0.0, 0.0), (Count{{"test", 4}}));
  EXPECT_EQ(few(4, 0.9, 0.1), (Count{{"train", 3}, {"val", 1}}));
}

#ifdef ANTIGRASP_HAS_MUJOCO
// Boxes far from the origin, in millimetres; the second loses an edge's worth, the third is open
// after the change.
class PairDataset : public testing::Test {
 protected:
  PairDataset() {
    for (const char* side : {"before", "after"}) std::filesystem::create_directory(folder_ / side);
    const Eigen::Vector3d far(500.0, -300.0, 80.0);
    TriangleMesh box = Transformed(shapes::Box({30.0, 36.0, 50.0}), 1.0, far);
    WriteMesh(folder_ / "before/a.obj", box);
    WriteMesh(folder_ / "before/b.obj", box);
    WriteMesh(folder_ / "before/c.obj", box);
    WriteMesh(folder_ / "after/a.obj", box);
    WriteMesh(folder_ / "after/b.obj", Transformed(shapes::Box({30.0, 40.0, 50.0}), 1.0, far));
    box.faces.pop_back();
    WriteMesh(folder_ / "after/c.obj", box);
    metric_.object_min_extent = 0.0;
    metric_.units = LengthUnit::kMm;
    metric_.num_grasps = 6;
    metric_.num_draws = 3;
    trial_ = AtEqualMass();
    trial_.draws = 2;
    request_.before = (folder_ / "before").string();
    request_.after = (folder_ / "after").string();
  }
  PairReport Write(const std::string& out) {
    request_.out = (folder_ / out).string();
    SilentObserver observer;
    return WritePairDataset(request_, metric_, metric_, trial_, &observer);
  }
  std::string WhyNot(const std::string& out) {
    try {
      Write(out);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  shapes::TempFolder folder_;
  MetricOptions metric_;
  PhysicsTrialOptions trial_;
  PairRequest request_;
};

TEST_F(PairDataset, HasBothJudgesLabelsOfBothSidesAndSaysWhatIsLeftOut) {
  const PairReport report = Write("set");
  EXPECT_NE(report.text.find("2 pairs ("), std::string::npos) << report.text;
  EXPECT_NE(report.text.find("left out: 1 open: "), std::string::npos) << report.text;
  const auto rows = CsvRows(folder_ / "set/objects.csv");
  ASSERT_EQ(rows.size(), 6U);
  JudgeOptions options{metric_, trial_, {}, request_.seed, 1, nullptr};
  const auto epsilon = MakeJudge("epsilon", options), held = MakeJudge("trial", options);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& row = rows[i];
    EXPECT_EQ(row.at("object"), i < 2 ? "a.obj" : "b.obj");
    EXPECT_EQ(row.at("side"), i % 2 == 0 ? "before" : "after");
    EXPECT_EQ(row.at("status"), "ok");
    const TriangleMesh given = ReadMesh(folder_ / row.at("side") / row.at("object"));
    const std::vector<JudgedObject> shown = {{"", &given, StreamOf(row.at("object"))}};
    EXPECT_EQ(std::stod(row.at("graspability")), epsilon->Score(shown)[0].score);
    EXPECT_EQ(std::stod(row.at("held")), held->Score(shown)[0].score);
    EXPECT_EQ(row.at("mass"), "0.05");
    const TriangleMesh mesh = ReadMesh(folder_ / "set" / row.at("mesh"));
    EXPECT_NEAR(Volume(mesh), i == 3 ? 6e-5 : 5.4e-5, 1e-12);  // 30 x 36 (40) x 50 mm
    EXPECT_NEAR(std::stod(row.at("volume")), Volume(mesh), 1e-15);
    EXPECT_NEAR(std::stod(row.at("extent_y")), i == 3 ? 0.04 : 0.036, 1e-12);
  }
  EXPECT_EQ(rows[0].at("split"), rows[1].at("split"));
  EXPECT_EQ(rows[2].at("split"), rows[3].at("split"));
  EXPECT_EQ(rows[0].at("graspability"), rows[1].at("graspability"));  // nothing changed, same draws
  EXPECT_NE(rows[2].at("graspability"), rows[3].at("graspability"));
  EXPECT_TRUE(rows[4].at("status").starts_with("no after: open: ")) << rows[4].at("status");
  EXPECT_TRUE(rows[5].at("status").starts_with("open: "));
  EXPECT_EQ(rows[4].at("split") + rows[4].at("mesh") + rows[5].at("graspability"), "");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "set/before/c.obj"));
  const std::string sheet = ReadFile(folder_ / "set/datasheet.md");
  EXPECT_NE(sheet.find("Not stated: fill in"), std::string::npos);
  EXPECT_NE(sheet.find("Left out, with a row in objects.csv that says so: 1 open: "),
            std::string::npos)
      << sheet;
}

// The grasps lie on the meshes beside them, wherever the objects that were given lay: scored there
// they have the same qualities, to the rounding of the moved mesh.
TEST_F(PairDataset, GraspsBelongToTheMeshesBesideThem) {
  Write("set");
  MetricOptions metres = metric_;
  metres.units = LengthUnit::kM;
  for (const std::string side : {"before", "after"}) {
    const auto path = folder_ / ("set/grasps_" + side + ".csv");
    const auto rows = CsvRows(path);
    const std::vector<GivenGrasp> grasps = ReadGivenGrasps(path);
    ASSERT_EQ(rows.size(), 12U);
    std::map<std::string, std::vector<GivenGrasp>> of;
    std::map<std::string, std::vector<double>> quality;
    for (std::size_t i = 0; i < 12; ++i) {
      of[grasps[i].object].push_back(grasps[i]);
      quality[grasps[i].object].push_back(std::stod(rows[i].at("robust_quality")));
      EXPECT_EQ(rows[i].at("executions"), "2");
      const Eigen::Vector3d up(std::stod(rows[i].at("up_x")), std::stod(rows[i].at("up_y")),
                               std::stod(rows[i].at("up_z")));
      EXPECT_NEAR(up.cwiseAbs().maxCoeff(), 1.0, 1e-6);  // a box rests on a face
      EXPECT_LT(up.dot(grasps[i].approach), -0.7);       // from above, within 45 degrees
    }
    for (const auto& [object, given] : of) {
      const TriangleMesh mesh = ReadMesh(folder_ / "set" / side / object);
      const auto scores = ScoreGivenGrasps(mesh, given, metres, request_.seed, StreamOf(object));
      for (std::size_t i = 0; i < given.size(); ++i) {
        EXPECT_EQ(scores[i].status, "ok");
        EXPECT_NEAR(scores[i].robust_quality, quality[object][i], 1e-9);
      }
    }
  }
}

TEST_F(PairDataset, HasTheSameBytesForAnyNumberOfThreadsAndIsNotWrittenOver) {
  request_.threads = 1;
  request_.license = "CC0";
  Write("one");
  request_.threads = 3;
  Write("three");
  const auto one = shapes::FileContents(folder_ / "one");
  EXPECT_EQ(one.size(), 10U);  // 4 meshes, 3 tables, the sheet, constants of two judges
  EXPECT_TRUE(one == shapes::FileContents(folder_ / "three"));
  EXPECT_NE(one.at("datasheet.md").find("## Licence\n\nCC0\n"), std::string::npos);
  EXPECT_NE(WhyNot("one").find("holds objects.csv already"), std::string::npos) << WhyNot("one");
  request_.overwrite = true;
  request_.seed = 2;
  Write("one");
  EXPECT_FALSE(one == shapes::FileContents(folder_ / "one"));
}

// Of two objects one is to train on and one to test on; one that no grasp reaches keeps its place,
// without a share held.
TEST_F(PairDataset, SaysWhichSplitIsEmptyAndWhatHasNoShareHeld) {
  for (const char* side : {"before", "after"}) std::filesystem::remove(folder_ / side / "c.obj");
  WriteMesh(folder_ / "after/b.obj", shapes::Box({90.0, 90.0, 90.0}));
  const PairReport report = Write("set");
  ASSERT_EQ(report.warnings.size(), 1U);
  EXPECT_EQ(report.warnings[0], "no pair to validate on (split val) among 2");
  EXPECT_NE(report.text.find("Without a share held, and in no mean of it: 1 no reachable grasp "
                             "after.\n"),
            std::string::npos)
      << report.text;
  const auto rows = CsvRows(folder_ / "set/objects.csv");
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[3].at("status"), "ok");
  EXPECT_EQ(rows[3].at("held") + rows[3].at("held_low") + rows[3].at("held_high"), "");
  EXPECT_NE(rows[0].at("split"), rows[2].at("split"));
  const std::string text = PairFolderText(folder_ / "set");
  EXPECT_TRUE(text.starts_with((folder_ / "set").string() + ": pairs of objects, 2 (1 ")) << text;
  EXPECT_NE(text.find("  graspability  0.0"), std::string::npos) << text;
  const std::string sheet = ReadFile(folder_ / "set/datasheet.md");
  EXPECT_NE(sheet.find("There is no pair to validate on"), std::string::npos) << sheet;
}

TEST_F(PairDataset, RefusesWhatIsNoSetAndWritesNothing) {
  request_.train = 0.9;
  request_.val = 0.2;
  EXPECT_NE(WhyNot("set").find("a sum of at most 1"), std::string::npos);
  request_.val = 0.1;
  request_.before = request_.before + "/c.obj";
  request_.after = request_.after + "/c.obj";
  EXPECT_NE(WhyNot("set").find("no pair; before/c.obj: no after: open"), std::string::npos)
      << WhyNot("set");
  request_.before = (folder_ / "before/a.obj").string();
  request_.after = (folder_ / "after").string();
  EXPECT_NE(WhyNot("set").find("expected exactly one object"), std::string::npos) << WhyNot("set");
  request_.before = (folder_ / "before").string();
  const std::string searched = "meshes written there would be read by the next call";
  EXPECT_NE(WhyNot("before/set").find(searched), std::string::npos) << WhyNot("before/set");
  EXPECT_NE(WhyNot("after").find(searched), std::string::npos) << WhyNot("after");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "set"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "before/set"));
}
#endif

}  // namespace
}  // namespace antigrasp
