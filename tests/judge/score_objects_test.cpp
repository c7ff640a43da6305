// Objects of a command line scored by the metric and, beside it, by a judge.
#include "antigrasp/judge/score_objects.h"

#include <gtest/gtest.h>

#include "antigrasp/core/error.h"
#include "antigrasp/mesh/mesh_file.h"
#include "tests/support/shapes.h"
#include "tests/support/temp_folder.h"

namespace antigrasp {
namespace {

// Says the number of an object's triangles; stops when it is told to.
class Counts final : public Judge {
 public:
  std::string Name() const override { return "triangles"; }
  std::size_t BatchSize() const override { return 2; }
  std::vector<Verdict> Score(const std::vector<JudgedObject>& objects) override {
    batches_ += std::to_string(objects.size());
    std::vector<Verdict> verdicts;
    for (const JudgedObject& object : objects) {
      const auto faces = static_cast<double>(object.mesh->faces.size());
      names_ += object.name + " ";
      verdicts.push_back(faces > 60 ? Verdict::None("late") : Verdict::Of(faces));
    }
    return verdicts;
  }
  std::vector<std::string> Notes() const override { return {"a note"}; }
  std::string Stopped() const override { return stopped_; }
  std::string batches_, names_, stopped_;
};

TEST(ScoreObjects, AJudgeSeesEveryUsableObjectOnceInBatchesAndItsVerdictStandsInTheRow) {
  const shapes::TempFolder folder;
  WriteMesh(folder / "a.stl", shapes::Cylinder(1.0, 3.0, 3));
  WriteMesh(folder / "b.stl", shapes::FlatSquare());
  WriteMesh(folder / "c.stl", shapes::Cylinder(1.0, 3.0, 5));
  WriteMesh(folder / "d.stl", shapes::Cylinder(1.0, 3.0, 30));
  WriteMesh(folder / "e.stl", shapes::Cylinder(1.0, 3.0, 7));
  WriteMesh(folder / "f.stl", shapes::Cylinder(1.0, 3.0, 8));
  const ObjectSource objects({folder.path().string()});
  SilentObserver observer;
  std::string warnings, rows, plain;
  Scoring scoring;
  scoring.metric.num_grasps = 4;
  scoring.metric.num_draws = 1;
  scoring.threads = 3;
  scoring.observer = &observer;
  scoring.warn = [&](const std::string& text) { warnings += text + "\n"; };
  Counts judge;
  scoring.judge = &judge;
  ScoreTable table;
  const ScoredSet set = ScoreObjects(
      objects, "in", nullptr, {}, scoring, [&](const ScoredObject& scored, const ScoreRow& row) {
        EXPECT_EQ(scored.name, row.object);
        const auto& [name, value] = row.extras.back();
        EXPECT_EQ(name, "judge");
        rows += row.object + " " + (std::isnan(value) ? "-" : std::to_string(int(value))) + " " +
                row.texts.at(0).second.substr(0, 5) + "\n";
        table.Add(row);
      });
  EXPECT_EQ(rows,
            "a.stl 12 ok\nb.stl - open:\nc.stl 20 ok\nd.stl - late\ne.stl 28 ok\nf.stl 32 ok\n");
  EXPECT_EQ(judge.names_, "a.stl c.stl d.stl e.stl f.stl ");
  EXPECT_EQ(judge.batches_, "122");  // of two rows each, the second of which shows nothing
  EXPECT_EQ(set.Summary(true).back(), "judge triangles: 4 scored, 1 late, mean 23.00000 +-8.69203");
  EXPECT_NE(warnings.find("judge: a note\n"), std::string::npos) << warnings;
  EXPECT_NE(table.Csv().find(",judge,judge_status\na.stl,"), std::string::npos) << table.Csv();
  EXPECT_NE(table.Csv().find(",12,ok\nb.stl,"), std::string::npos) << table.Csv();
  RequireAVerdict(set, &judge);
}

// The metric's scores are written first: what is refused is a judge that said nothing.
TEST(RequireAVerdict, RefusesAJudgeThatScoredNothingAndNamesWhy) {
  ScoredSet set{MetricOptions()};
  Counts judge;
  for (const char* why : {"no score", "no score", "late"}) set.AddVerdict(Verdict::None(why));
  RequireAVerdict(set, nullptr);
  try {
    RequireAVerdict(set, &judge);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "the judge scored no object: 0 scored, 2 no score, 1 late (--judge triangles): "
                 "expected a finite score of at least one");
  }
  set.AddVerdict(Verdict::Of(0.5));
  RequireAVerdict(set, &judge);
  set.JudgeStopped("it died");
  EXPECT_THROW(RequireAVerdict(set, &judge), RuntimeFailure);
}

}  // namespace
}  // namespace antigrasp
