// `antigrasp evaluate --trial --grasps`: what was sampled, scored, executed and written in one
// call.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/mesh/mesh_file.h"
#include "tests/app/run_binary.h"
#include "tests/support/csv_rows.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using cli::Antigrasp;
using cli::Outcome;
using shapes::TempFolder;

TEST(TriedSamplesCli, OneCallWritesWhatSamplingAndThenTryingWrites) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  WriteMesh(folder / "box.stl", Transformed(shapes::Box({1.0, 1.5, 2.0}), 1.0, {5.0, 5.0, 5.0}));
  const std::string common = "evaluate " + dir + "box.stl --gripper panda --num-grasps 4" +
                             " --num-draws 2 --seed 5 --friction 0.3 ";
  const std::string trial = "--trial six-ways --draws 2 ";
  ASSERT_EQ(Antigrasp(common + "--grasps " + dir + "g.csv --out " + dir + "s2.csv").code, 0);
  ASSERT_EQ(
      Antigrasp(common + trial + "--grasps-in " + dir + "g.csv --grasps " + dir + "two.json").code,
      0);
  const Outcome one =
      Antigrasp(common + trial + "--grasps " + dir + "one.json --out " + dir + "s1.csv");
  ASSERT_EQ(one.code, 0) << one.text;
  EXPECT_EQ(ReadFile(folder / "one.json"), ReadFile(folder / "two.json"));
  // Scores are those of the call without a trial, but for the seconds that they took.
  const auto scores = shapes::CsvRows(folder / "s1.csv"),
             alone = shapes::CsvRows(folder / "s2.csv");
  ASSERT_EQ(scores.size(), 1U);
  EXPECT_EQ(scores[0].at("graspability"), alone.at(0).at("graspability"));
  EXPECT_TRUE(std::filesystem::exists(folder / "s1.csv.trial.toml"));
  EXPECT_TRUE(std::filesystem::exists(folder / "s1.csv.metric.toml"));
  const auto grasps = nlohmann::json::parse(ReadFile(folder / "one.json")).at("grasps");
  ASSERT_EQ(grasps.at("object_in_gripper").size(), 4U);
  EXPECT_EQ(grasps.at("robust_quality").size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    const double held = grasps.at("held").at(i).get<double>();
    EXPECT_EQ(grasps.at("object_in_gripper").at(i).get<bool>(), held >= 0.5) << held;
  }
}

}  // namespace
}  // namespace antigrasp
