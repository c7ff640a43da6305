#include "antigrasp/train/run_output.h"

#include <gtest/gtest.h>
#include <torch/types.h>

#include <cmath>
#include <functional>
#include <map>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/rng.h"
#include "antigrasp/mesh/mesh_file.h"
#include "antigrasp/train/gan_model.h"
#include "antigrasp/train/loss_table.h"
#include "antigrasp/train/sample_name.h"
#include "tests/support/csv_rows.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;
using shapes::CsvRows;
using shapes::TempFolder;

StageStatistics Row(int stage, double mean, double half_width) {
  StageStatistics row;
  row.stage = stage;
  row.samples = 50;
  row.by_status[0] = 40;
  row.graspability = {mean, half_width, 40};
  return row;
}

const std::vector<StageStatistics>& Stages() {
  static const std::vector<StageStatistics> stages = {Row(-1, 0.004, 0.0004), Row(0, 0.005, 0.001),
                                                      Row(1, 0.002, 0.0002)};
  return stages;
}

// What is logged: the default logger writes to standard output.
std::string Logged(const std::function<void()>& work) {
  testing::internal::CaptureStdout();
  work();
  return testing::internal::GetCapturedStdout();
}

TEST(LossesCsv, HasEveryNumberOfAnUpdateUnderItsOwnName) {
  StepReport report;
  report.loss_discriminator = 1.5;
  report.loss_generator = 2.5;
  report.gradient_discriminator = 3.5;
  report.gradient_generator = 4.5;
  report.rate_discriminator = 5.5;
  report.rate_generator = 6.5;
  EXPECT_EQ(LossesCsv({GanScalarNames(),
                       {RowOf(20, GanScalars(report, 7.5)),
                        RowOf(30, GanScalars(report, std::nan("")))}}),
            "step,loss_discriminator,loss_generator,gradient_discriminator,gradient_generator,"
            "rate_discriminator,rate_generator,largest_sigma\n"
            "20,1.5,2.5,3.5,4.5,5.5,6.5,7.5\n"
            "30,1.5,2.5,3.5,4.5,5.5,6.5,\n");
  EXPECT_EQ(GanScalarText(report), "L_D 1.50  L_G +2.50");
}

TEST(StageName, OfAnyStage) {
  EXPECT_EQ(StageName(-1), "prior set");
  EXPECT_EQ(StageName(0), "episode 0");
  EXPECT_EQ(StageName(2, "scoring"), "episode 2: scoring");
}

TEST(StageScalars, AreNamedAndKappaIsRelativeToThePriorSet) {
  StageStatistics row = Stages()[2];
  row.coverage = 0.125;
  row.nna = 0.375;
  row.duplicates = 0.625;
  row.diversity = 0.875;
  row.flat = 0.0625;
  row.crease = 0.03125;
  const auto list = StageScalars(row, Stages());
  const std::map<std::string, double> scalars(list.begin(), list.end());
  const std::map<std::string, double> expected = {
      {"stage/graspability", 0.002},    {"stage/rejected", 0.2},         {"stage/coverage", 0.125},
      {"stage/near_duplicates", 0.625}, {"stage/diversity", 0.875},      {"stage/1-NNA", 0.375},
      {"stage/flat_share", 0.0625},     {"stage/crease_share", 0.03125}, {"stage/kappa", 0.5}};
  EXPECT_EQ(scalars, expected);
  EXPECT_EQ(StageScalars(row, {row}).size(), 8U);  // no prior set, no kappa
}

TEST(LogStage, SaysKappaByThePriorSetAndNoneOfThePriorItself) {
  const std::string later = Logged([] { LogStage(Stages()[2], Stages()); });
  // 0.5 +- hypot(0.05, 0.5 x 0.1)
  EXPECT_NE(later.find("episode 1: 50 objects, 10 rejected, graspability 0.00200 +-0.00020, "
                       "0.50 +-0.07 of the prior set\n"),
            std::string::npos)
      << later;
  const std::string prior = Logged([] { LogStage(Stages()[0], Stages()); });
  EXPECT_NE(prior.find("prior set: 50 objects, 10 rejected, graspability 0.00400 +-0.00040\n"),
            std::string::npos)
      << prior;
}

TEST(WarnIfCollapsed, ComparesWithHalfOfEpisodeZeroAndAFifthOfDuplicates) {
  std::vector<StageStatistics> rows = Stages();
  rows[0].coverage = 0.9;  // nobody's measure
  rows[1].coverage = 0.5;
  StageStatistics row = Row(1, 0.002, 0);
  const auto warned = [&](double coverage, double duplicates) {
    row.coverage = coverage;
    row.duplicates = duplicates;
    return Logged([&] { WarnIfCollapsed(row, rows); });
  };
  EXPECT_EQ(warned(0.26, 0.19), "");
  EXPECT_NE(warned(0.24, 0.0).find("coverage 24 % of the prior set, 50 % in episode 0"),
            std::string::npos);
  EXPECT_NE(warned(0.5, 0.21).find("21 % of its samples are near-duplicates"), std::string::npos);
}

TEST(WriteElites, KeepsTheirNumbersTheirGridsAndHowTheyWereChosen) {
  const TempFolder folder;
  RunConfig config;
  config.seed = 5;
  const torch::Tensor values = torch::zeros({2, 1, 32, 32, 32});
  for (int k = 0; k < 2; ++k) values[k][0][3][2][1] = 0.2 * (k + 1);
  WriteElites(folder / "elites.h5", values, {1, 3}, 2, config);
  ShapeSet set = ReadShapeSet(folder / "elites.h5");
  EXPECT_EQ(set.kind, "elites");
  EXPECT_EQ(set.seed, 5U);
  EXPECT_EQ(set.truncation, 0.1);
  EXPECT_EQ(set.provenance, "antigrasp train, episode 2, least graspable samples");
  EXPECT_EQ(set.names, (std::vector<std::string>{"sample-000001", "sample-000003"}));
  const std::size_t node = set.grids[0].Index(1, 2, 3);
  EXPECT_NEAR(set.grids[0].values[node], 0.02F, 1e-7);  // 0.2 and 0.4 of the truncation
  EXPECT_NEAR(set.grids[1].values[node], 0.04F, 1e-7);
  config.cem.select = EliteOrder::kRandom;
  WriteElites(folder / "elites.h5", values, {1, 3}, 2, config);
  EXPECT_EQ(ReadShapeSet(folder / "elites.h5").provenance,
            "antigrasp train, episode 2, random samples");
}

// Three boxes, of which the second and the third are hard to grasp, and a rejected sample.
ScoredStage Boxes() {
  ScoredStage scored;
  for (const double height : {3.0, 4.0, 5.0, 6.0}) {
    scored.objects.emplace_back();
    scored.objects.back().mesh = shapes::Box({1.0, 2.0, height});
  }
  scored.graspabilities = {0.3, 0.2, 0.1, std::nan("")};
  return scored;
}

TEST(ExportLeastGraspable, WritesTheHardestFirstAtTheAskedSize) {
  const TempFolder folder;
  const RunFolder run{folder.path()};
  RunConfig config;
  config.stl_count = 2;
  config.stl_size_mm = 50.0;
  config.metric.num_grasps = 10;
  ExportLeastGraspable(Boxes(), config, run);
  const auto rows = CsvRows(run.Stl() / "scores.csv");
  ASSERT_EQ(rows.size(), 2U);
  const double widths[] = {20.0, 25.0};  // 2 of 5 and 2 of 4, where the largest is 50
  for (std::size_t i = 0; i < 2; ++i) {
    auto row = rows[i];
    EXPECT_EQ(row["file"], i == 0 ? "adversarial_01.stl" : "adversarial_02.stl");
    EXPECT_EQ(row["object"], i == 0 ? "sample-000002" : "sample-000001");
    EXPECT_EQ(row["graspability"], i == 0 ? "0.1" : "0.2");
    EXPECT_EQ(row["size_mm"], "50");
    const Eigen::Vector3d extent = Bounds(ReadMesh(run.Stl() / row["file"])).Extent();
    EXPECT_NEAR(extent.z(), 50.0, 1e-4);
    EXPECT_NEAR(extent.y(), widths[i], 1e-4);
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(run.Stl()), {}), 3);
}

TEST(ExportLeastGraspable, ScoresAgainWithDrawsThatNobodySelectedBy) {
  const TempFolder folder;
  const RunFolder run{folder.path()};
  RunConfig config;
  config.seed = 3;
  config.stl_count = 2;
  config.metric.num_grasps = 10;
  const ScoredStage scored = Boxes();
  ExportLeastGraspable(scored, config, run);
  const std::uint64_t fresh = RngStream(3, "rescore").NextU64();
  for (auto row : CsvRows(run.Stl() / "scores.csv")) {
    const auto object = static_cast<std::uint64_t>(SampleIndex(row["object"]).value());
    const TriangleMesh& mesh = scored.objects[object].mesh;
    const Graspability again = EvaluateGraspability(mesh, config.metric, fresh, object);
    const double score = std::stod(row["graspability_fresh_draws"]);
    EXPECT_EQ(score, again.value);
    EXPECT_EQ(std::stod(row["ci_low"]), again.ci_low);
    EXPECT_EQ(std::stod(row["ci_high"]), again.ci_high);
    EXPECT_LT(again.ci_low, again.ci_high);
    EXPECT_NE(score, EvaluateGraspability(mesh, config.metric, 3, object).value);
  }
}

TEST(RunFolder, HasTheNamesThatTheManualPromises) {
  const RunFolder run{"r"};
  EXPECT_EQ(run.Config(), "r/config.toml");
  EXPECT_EQ(run.Provenance(), "r/provenance.toml");
  EXPECT_EQ(run.Prior(), "r/prior.h5");
  EXPECT_EQ(run.PriorScores(), "r/prior_scores.csv");
  EXPECT_EQ(run.Latest(), "r/checkpoint.pt");
  EXPECT_EQ(run.Statistics(), "r/statistics.csv");
  EXPECT_EQ(run.Stl(), "r/stl");
  EXPECT_EQ(run.Control(), "r/control");
  EXPECT_EQ(run.Episode(2), "r/episode_2");
  EXPECT_EQ(run.EpisodeCheckpoint(2), "r/episode_2/checkpoint.pt");
}

TEST(RunFolder, RemovesARunAndNothingElse) {
  const TempFolder folder;
  const RunFolder run{folder / "run"};
  for (const fs::path& file :
       {run.Config(), run.Provenance(), run.Prior(), run.PriorScores(), run.Latest(),
        run.Statistics(), run.Events(), run.Stl() / "a.stl", RunFolder{run.Control()}.Config(),
        run.EpisodeCheckpoint(0), run.EpisodeCheckpoint(12), run.root / "thesis.tex"}) {
    fs::create_directories(file.parent_path());
    WriteFileAtomic(file, "bytes");
  }
  run.Remove();
  EXPECT_EQ(std::distance(fs::directory_iterator(run.root), {}), 1);
  EXPECT_EQ(ReadFile(run.root / "thesis.tex"), "bytes");
}

}  // namespace
}  // namespace antigrasp
