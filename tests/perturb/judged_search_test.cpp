#include "antigrasp/perturb/judged_search.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <functional>
#include <set>

#include "antigrasp/core/error.h"
#include "antigrasp/datasets/roughness.h"
#include "antigrasp/mesh/inspect.h"
#include "antigrasp/perturb/change_budget.h"
#include "antigrasp/perturb/mesh_change.h"
#include "antigrasp/perturb/scored_perturbation.h"
#include "antigrasp/perturb/search_choice.h"
#include "antigrasp/perturb/subdivide.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

// Says what a function says, and remembers what it was asked.
class Oracle : public Judge {
 public:
  explicit Oracle(std::function<Verdict(const TriangleMesh&)> says) : says_(std::move(says)) {}
  std::string Name() const override { return "oracle"; }
  std::vector<Verdict> Score(const std::vector<JudgedObject>& objects) override {
    std::vector<Verdict> verdicts;
    for (const JudgedObject& object : objects) {
      verdicts.push_back(says_(*object.mesh));
      streams.insert(object.stream);
      meshes.push_back(*object.mesh);
    }
    return verdicts;
  }
  std::string Stopped() const override { return stopped; }
  std::set<std::uint64_t> streams;
  std::vector<TriangleMesh> meshes;
  std::string stopped;

 private:
  std::function<Verdict(const TriangleMesh&)> says_;
};

double Height(const TriangleMesh& mesh) { return Bounds(mesh).Extent().z(); }
Oracle Flatter() {
  return Oracle([](const TriangleMesh& mesh) { return Verdict::Of(Height(mesh)); });
}

JudgedSearchOptions Quick() {
  JudgedSearchOptions options;
  options.starts = 2;
  options.descent_steps = 12;
  options.generations = 6;
  return options;
}

TriangleMesh FineCube() { return Subdivided(shapes::Cube(), {12.0}); }

PerturbResult Search(const JudgedSearchOptions& options, Judge* judge, std::uint64_t seed = 1,
                     int threads = 1) {
  RngStream rng(seed, "judged-test");
  MetricOptions metric;
  metric.friction = 0.25;
  return PerturbByJudge(FineCube(), metric, options, judge, threads, &rng);
}

TEST(PerturbByJudge, DescendsOnWhatTheJudgeSays) {
  Oracle judge = Flatter();
  const PerturbResult result = Search(Quick(), &judge);
  ASSERT_EQ(result.failure, "");
  EXPECT_GT(result.moved, 0);
  EXPECT_LT(Height(result.mesh), Height(result.start) - 0.03);
  // Every generation has draws of its own, and the last judgement too.
  EXPECT_EQ(judge.streams.size(), 2u + 6u + 4u);
}

TEST(PerturbByJudge, WhatItWritesAndWhatItAsksAboutNeverExceedsABudget) {
  JudgedSearchOptions options = Quick();
  options.generations = 2;
  for (const ChangeBudget& budget :
       {ChangeBudget{.hausdorff = 3, .volume = 20, .turn = 60, .roughness = 200},
        ChangeBudget{.hausdorff = 12, .volume = 2, .turn = 60, .roughness = 200},
        ChangeBudget{.hausdorff = 12, .volume = 50, .turn = 10, .roughness = 200},
        ChangeBudget{.hausdorff = 12, .volume = 50, .turn = 60, .roughness = 60}}) {
    options.budget = budget;
    Oracle judge([](const TriangleMesh& mesh) { return Verdict::Of(-Height(mesh)); });
    const PerturbResult result = Search(options, &judge);
    ASSERT_GT(result.moved, 0);
    for (const TriangleMesh& mesh : judge.meshes) {
      const MeshChange change = CompareMeshes(result.start, mesh, 500);
      EXPECT_LE(change.hausdorff, budget.hausdorff);
      EXPECT_LE(std::abs(change.volume_change), budget.volume);
      EXPECT_LE(CompareNormals(result.start, mesh).largest, budget.turn);
      EXPECT_LE(MeanDihedralAngle(mesh),
                (1 + budget.roughness / 100) * MeanDihedralAngle(result.start));
      EXPECT_TRUE(WhyNotPrintable(mesh).empty());
    }
  }
}

TEST(PerturbByJudge, KeepsTheOriginalWhenNothingIsBetterAndSaysWhenNothingHasAScore) {
  const TriangleMesh cube = FineCube();
  const auto is_cube = [&](const TriangleMesh& mesh) { return mesh.vertices == cube.vertices; };
  Oracle likes_cubes([&](const TriangleMesh& mesh) { return Verdict::Of(is_cube(mesh) ? 0 : 1); });
  Oracle sees_cubes([&](const TriangleMesh& mesh) {
    return is_cube(mesh) ? Verdict::Of(1.0) : Verdict::None("never seen");
  });
  Oracle equal([](const TriangleMesh&) { return Verdict::Of(0.5); });
  Oracle blind([](const TriangleMesh&) { return Verdict::None("blind"); });
  EXPECT_EQ(Search(Quick(), &blind).failure, "no score by the judge: blind");
  for (Oracle* judge : {&likes_cubes, &sees_cubes, &equal}) {
    const PerturbResult result = Search(Quick(), judge);
    EXPECT_EQ(result.failure, "");
    EXPECT_EQ(result.moved, 0);
    EXPECT_EQ(result.mesh.vertices, result.start.vertices);
  }
}

TEST(PerturbByJudge, DependsOnTheSeedAndNotOnTheThreads) {
  Oracle a = Flatter(), b = Flatter(), c = Flatter();
  const PerturbResult one = Search(Quick(), &a, 1, 1), four = Search(Quick(), &b, 1, 4);
  EXPECT_EQ(one.mesh.vertices, four.mesh.vertices);
  EXPECT_NE(one.mesh.vertices, Search(Quick(), &c, 2, 1).mesh.vertices);
}

TEST(PerturbByJudge, EndsWithTheJudge) {
  Oracle judge = Flatter();
  judge.stopped = "died too often";
  EXPECT_EQ(Search(Quick(), &judge).failure, "judge stopped: died too often");
}

TEST(PerturbByJudge, ADescentAloneMakesACubeHarderToHold) {
  JudgedSearchOptions options;
  options.starts = 1;
  options.descent_steps = 60;
  options.generations = 0;
  Oracle judge([](const TriangleMesh& mesh) {
    MetricOptions metric;
    metric.friction = 0.25;
    metric.num_grasps = 200;
    const Graspability score = EvaluateGraspability(mesh, metric, 7, 7);
    return Verdict::Of(score.fraction_nonzero * score.mean);
  });
  const PerturbResult result = Search(options, &judge);
  EXPECT_GT(result.moved, 0);
}

TEST(SearchChoice, JudgesBothMeshesUnderTheObjectsOwnDraws) {
  Oracle* seen = nullptr;
  PerturbSettings settings;
  settings.method = [](const TriangleMesh& mesh, const PairLimits&, const PerturbOptions&,
                       RngStream*, const ProgressFn&) {
    PerturbResult result;
    result.start = mesh;
    result.mesh = Transformed(mesh, 2.0, Vector3d::Zero());
    result.iterations = result.moved = 1;
    return result;
  };
  settings.judges = std::make_shared<JudgePool>([&] {
    auto judge = std::make_unique<Oracle>(Flatter());
    seen = judge.get();
    return judge;
  });
  const ScoredPerturbation scored = PerturbAndScore(shapes::Cube(), settings, 41);
  EXPECT_EQ(scored.judge, "oracle");
  EXPECT_DOUBLE_EQ(scored.judge_before, 1.0);
  EXPECT_DOUBLE_EQ(scored.judge_after, 2.0);
  EXPECT_EQ(seen->streams, std::set<std::uint64_t>{41});
}

TEST(SearchChoice, RefusesWhatItsObjectiveMakesNoUseOf) {
  const auto typed = [](const std::string& what) {
    return [what](const std::string& key) { return key == what ? what + " 1" : std::string(); };
  };
  SearchChoice choice;
  EXPECT_NO_THROW(RequireUsed(choice, typed("search.alpha")));
  EXPECT_THROW(RequireUsed(choice, typed("search.hausdorff")), InputError);
  choice.objective = "trial";
  EXPECT_NO_THROW(RequireUsed(choice, typed("search.hausdorff")));
  EXPECT_NO_THROW(RequireUsed(choice, typed("search.objective")));
  EXPECT_THROW(RequireUsed(choice, typed("search.alpha")), InputError);
}

TEST(SearchChoice, SettingsOfTheSearchOnTheMetricAreAsTheyWere) {
  SearchChoice choice;
  OptionTable used, alone;
  BindUsed(&used, &choice);
  Bind(&alone, &choice.descent);
  EXPECT_EQ(used.Dump(), alone.Dump());
}

}  // namespace
}  // namespace antigrasp
