#include "antigrasp/train/run_record.h"

#include <gtest/gtest.h>

#include <cmath>

#include "antigrasp/core/error.h"
#include "antigrasp/train/statistics_table.h"
#include "tests/support/temp_folder.h"

namespace antigrasp {
namespace {

using shapes::TempFolder;

const std::string kScores =
    "object,status,num_grasps,graspability,ci_low,ci_high,mean,fraction_nonzero\n";

std::string StatisticsOf(const std::vector<int>& stages) {
  std::vector<StageStatistics> rows;
  for (const int stage : stages) {
    StageStatistics row;
    row.stage = stage;
    row.samples = 10 + stage;
    rows.push_back(row);
  }
  return StatisticsToCsv(rows);
}

TEST(RunRecord, HoldsEveryTableOfARunByStage) {
  const TempFolder folder;
  folder.Write("run/config.toml", "[run]\nseed = 7\n[cem]\nepisodes = 4\n");
  folder.Write("run/provenance.toml", "[provenance]\ndevice = \"cpu\"\n");
  folder.Write("run/statistics.csv", StatisticsOf({0, -1, 1}));
  folder.Write("run/prior_scores.csv", kScores + "0,ok,5,0.5,0,1,0.5,1\n");
  folder.Write("run/episode_1/scores.csv", kScores + "0,disjoint,0,,,,,\n1,ok,5,0.25,0,1,0.5,1\n");
  folder.Write("run/episode_1/losses.csv", "step,radius\n10,3\n");
  folder.Write("run/episode_3/checkpoint.pt", "of an episode that was trained and not scored");
  folder.Write("run/episode_x/scores.csv", "of no episode");
  const RunRecord run = ReadRun(folder / "run");
  ASSERT_TRUE(run.config && run.provenance);
  EXPECT_EQ(run.config->seed, 7U);
  EXPECT_EQ(run.config_toml, "[run]\nseed = 7\n[cem]\nepisodes = 4\n");
  EXPECT_EQ(run.provenance->device, "cpu");
  EXPECT_TRUE(run.has_statistics);
  std::vector<int> episodes;
  for (const StageRecord& stage : run.stages) episodes.push_back(stage.episode);
  EXPECT_EQ(episodes, (std::vector<int>{-1, 0, 1, 3}));
  EXPECT_EQ(run.Find(0)->row->samples, 10);
  EXPECT_FALSE(run.Find(0)->scores || run.Find(0)->losses);
  EXPECT_EQ(run.Find(-1)->row->samples, 9);
  EXPECT_EQ(run.Find(1)->losses->scalars, std::vector<std::string>{"radius"});
  EXPECT_FALSE(run.Find(3)->row);
  EXPECT_EQ(run.Find(2), nullptr);
  EXPECT_EQ(GraspabilitiesOf(run.Find(-1)), std::vector<double>{0.5});
  const std::vector<double> values = GraspabilitiesOf(run.Find(1));
  ASSERT_EQ(values.size(), 2U);
  EXPECT_TRUE(std::isnan(values[0]));
  EXPECT_EQ(values[1], 0.25);
  EXPECT_TRUE(GraspabilitiesOf(run.Find(3)).empty() && GraspabilitiesOf(nullptr).empty());
}

TEST(RunRecord, OfAnEmptyFolderIsEmptyAndOfADamagedTableRefused) {
  const TempFolder folder;
  const RunRecord none = ReadRun(folder.path());
  EXPECT_FALSE(none.config || none.provenance || none.has_statistics);
  EXPECT_TRUE(none.stages.empty());
  folder.Write("episode_0/scores.csv", kScores + "1,ok,5,0.5,0,1,0.5,1\n");
  try {
    ReadRun(folder.path());
    FAIL() << "a table whose first row is not the first sample";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("scores.csv, row 1"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace antigrasp
