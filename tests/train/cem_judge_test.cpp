// Runs whose samples another judge than the metric scores.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "antigrasp/core/error.h"
#include "antigrasp/quality/score_table.h"
#include "antigrasp/train/cem_run.h"
#include "antigrasp/train/statistics_table.h"
#include "tests/support/csv_rows.h"
#include "tests/support/temp_folder.h"
#include "tests/train/run_files.h"
#include "tests/train/tiny_run.h"

namespace antigrasp {
namespace {

using shapes::CsvRows;
using shapes::StoppingObserver;
using shapes::TempFolder;

// The more triangles the lower; has no score for the first object, and stops after so many batches.
class Triangles final : public Judge {
 public:
  explicit Triangles(int batches) : left_(batches) {}
  std::string Name() const override { return "triangles"; }
  std::size_t BatchSize() const override { return 3; }
  std::string Stopped() const override { return left_ < 0 ? "tired" : ""; }
  std::vector<Verdict> Score(const std::vector<JudgedObject>& objects) override {
    --left_;
    EXPECT_LE(objects.size(), 3U);
    std::vector<Verdict> verdicts;
    for (const JudgedObject& object : objects) {
      const auto faces = static_cast<double>(object.mesh->faces.size());
      EXPECT_EQ(object.name, "sample-00000" + std::to_string(object.stream));
      verdicts.push_back(object.stream == 0 ? Verdict::None("late") : Verdict::Of(-faces));
    }
    return verdicts;
  }

 private:
  int left_;
};

RunConfig Judged(const std::string& score = "judge:triangles") {
  RunConfig config = shapes::Tiny();
  config.cem.score = score;
  config.cem.prior_fraction = 0.0;
  config.cem.episodes = 1;
  return config;
}

JudgeMaker MakeTriangles(int batches) {
  return [batches](const RunConfig& config) {
    EXPECT_EQ(config.cem.score, "judge:triangles");
    return std::make_unique<Triangles>(batches);
  };
}

// Elites are those that the judge scores lowest: their threshold is the third of its scores.
TEST(CemJudge, TheJudgesScoresChooseTheElitesAndStandInEveryTable) {
  const TempFolder folder;
  StoppingObserver observer;
  const RunResult result =
      StartRun(Judged(), folder / "run", &observer, MakeGan, {MakeTriangles(100), {}});
  ASSERT_EQ(result.stages.size(), 3U);
  for (int episode = 0; episode < 2; ++episode) {
    const RunFolder run{folder / "run"};
    std::vector<double> scores;
    for (const ScoreRow& row : ReadScores(run.Scores(episode))) {
      if (!row.score) continue;
      EXPECT_NE(row.object, "sample-000000");
      scores.push_back(row.score->graspability);
      EXPECT_LT(scores.back(), -4.0);
    }
    const StageStatistics& stage = result.stages[static_cast<std::size_t>(episode) + 1];
    EXPECT_EQ(static_cast<int>(scores.size()), stage.scored);
    ASSERT_GE(scores.size(), 3U);
    std::sort(scores.begin(), scores.end());
    EXPECT_EQ(stage.elite_threshold, scores[2]);
  }
  for (const auto& row : CsvRows(folder / "run/stl/scores.csv")) {
    EXPECT_LT(std::stod(row.at("graspability")), -4.0);
    EXPECT_EQ(row.at("graspability_fresh_draws") + row.at("ci_low") + row.at("ci_high"), "");
    EXPECT_EQ(row.at("size_mm"), "60");
  }
}

TEST(CemJudge, AJudgeThatStopsEndsTheRunWhichGoesOnWithAnother) {
  const TempFolder folder;
  StoppingObserver observer;
  StartRun(Judged(), folder / "whole", &observer, MakeGan, {MakeTriangles(100), {}});
  EXPECT_THROW(StartRun(Judged(), folder / "run", &observer, MakeGan, {MakeTriangles(4), {}}),
               RuntimeFailure);
  ResumeRun(folder / "run", &observer, MakeGan, {MakeTriangles(100), {}});
  shapes::ExpectSameFiles(folder / "run", folder / "whole");
}

TEST(CemJudge, WithoutAJudgeOnlyTheMetricScores) {
  const TempFolder folder;
  StoppingObserver observer;
  EXPECT_THROW(StartRun(Judged(), folder / "run", &observer), InputError);
  EXPECT_THROW(
      StartRun(Judged("trail"), folder / "run", &observer, MakeGan, {MakeTriangles(9), {}}),
      InputError);
  EXPECT_FALSE(std::filesystem::exists(folder / "run"));
  const JudgeMaker never = [](const RunConfig&) -> std::unique_ptr<Judge> {
    ADD_FAILURE() << "asked for a judge";
    return nullptr;
  };
  RunConfig config = Judged("epsilon");
  config.cem.episodes = 0;
  StartRun(config, folder / "run", &observer, MakeGan, {never, {}});
  EXPECT_GT(ReadScores(RunFolder{folder / "run"}.Scores(0)).size(), 0U);
}

}  // namespace
}  // namespace antigrasp
