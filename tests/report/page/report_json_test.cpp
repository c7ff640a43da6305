// Every field of the page's JSON by its name, another number in each.
#include "antigrasp/report/page/report_json.h"

#include <gtest/gtest.h>

#include "antigrasp/report/page/payload.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Json = nlohmann::json;

TEST(ReportJson, AScoreHasItsSixNumbersUnderTheirNames) {
  Graspability score;
  score.status = GraspabilityStatus::kOk;
  score.value = 0.4;
  score.ci_low = 0.3;
  score.ci_high = 0.5;
  score.mean = 0.2;
  score.fraction_nonzero = 0.9;
  score.grasps.resize(7);
  EXPECT_EQ(Json(ScoreJson(*SummaryOf(score))), Json::parse(R"({
      "graspability": 0.4, "ci_low": 0.3, "ci_high": 0.5, "mean": 0.2, "fraction_nonzero": 0.9,
      "num_grasps": 7})"));
  score.status = GraspabilityStatus::kNotEvaluable;
  EXPECT_FALSE(SummaryOf(score));
}

TEST(ReportJson, APrintCheckHasItsFieldsAndThePoseByRows) {
  ReportPrint print;
  print.size_mm = {60, 40, 38};
  print.wall_mm = 1.5;
  print.overhang = 0.25;
  print.pose_probability = 0.75;
  EXPECT_EQ(Json(PrintJson(print)), Json::parse(R"({
      "size_mm": [60, 40, 38], "wall_mm": 1.5, "watertight": false, "overhang": 0.25, "pose": null,
      "pose_probability": null, "notes": []})"));
  print.pose.emplace() << 1, 2, 3, 4, 5, 6, 7, 8, 9;
  EXPECT_EQ(Json(PrintJson(print))["pose"], Json::parse("[[1, 2, 3], [4, 5, 6], [7, 8, 9]]"));
  EXPECT_EQ(Json(PrintJson(print))["pose_probability"], 0.75);
}

TEST(ReportJson, TheMetricAndTheGripperAreInMetresAndTheNoiseInWords) {
  Report report;
  MetricOptions& m = report.metric.emplace();
  m.percentile = 71;
  m.friction = 0.7;
  m.num_grasps = 11;
  m.num_draws = 12;
  m.finger_radius = 0.006;
  m.object_translation_std = 0.0025;
  m.object_rotation_std = 0.01;
  m.grasp_translation_std = 0.0015;
  m.grasp_rotation_std = 0.02;
  m.friction_std = 0.125;
  m.jaw_opening = 0.08;
  m.object_min_extent = 0.0;
  m.units = LengthUnit::kIn;
  m.gripper = {.palm_distance = 0.01,
               .fingertip_overlap = 0.02,
               .finger_width = 0.03,
               .finger_thickness = 0.04,
               .palm_depth = 0.05,
               .palm_length = 0.06,
               .palm_width = 0.07};
  const Json json = HeadJson(report);
  EXPECT_EQ(json["metric"], Json::parse(R"j({
      "percentile": 71, "friction": 0.7, "num_grasps": 11, "num_draws": 12, "finger_radius": 0.006,
      "noise": "object 2.5 mm, 0.01 rad; grasp 1.5 mm, 0.02 rad; friction 0.125",
      "size": "at true size (in)"})j"));
  EXPECT_EQ(json["gripper"], Json::parse(R"({
      "palm_distance": 0.01, "fingertip_overlap": 0.02, "finger_width": 0.03,
      "finger_thickness": 0.04, "palm_depth": 0.05, "palm_length": 0.06, "palm_width": 0.07,
      "jaw_opening": 0.08})"));
}

TEST(ReportJson, AStageHasItsFieldsAndScoresOfSixDigits) {
  ReportStage stage;
  stage.id = "control-2";
  stage.label = "control, episode 2";
  stage.episode = 2;
  stage.control = true;
  stage.samples = 50;
  stage.statuses = {{"ok", 48}, {"gaps", 2}};
  stage.graspability = {.mean = 0.3, .half_width = 0.01, .count = 47};
  stage.elite_threshold = 0.11;
  stage.coverage = 0.22;
  stage.nna = 0.33;
  stage.duplicates = 0.44;
  stage.diversity = 0.55;
  stage.flat = 0.66;
  stage.crease = 0.077;
  stage.scores = {0.12345678, 2.0};
  Report report;
  report.run = ReportRun{{stage}, {{3, true, {{"step", {10}}, {"loss_generator", {0.7654321}}}}}};
  const Json json = HeadJson(report);
  EXPECT_EQ(json["run"]["stages"], Json::parse(R"([{
      "id": "control-2", "label": "control, episode 2", "episode": 2, "control": true,
      "samples": 50, "statuses": [["ok", 48], ["gaps", 2]],
      "graspability": {"mean": 0.3, "half_width": 0.01, "count": 47},
      "elite_threshold": 0.11, "coverage": 0.22, "nna": 0.33, "duplicates": 0.44,
      "diversity": 0.55, "flat_share": 0.66, "crease_share": 0.077, "scores": [0.123457, 2]}])"));
  EXPECT_EQ(json["run"]["losses"], Json::parse(R"([{
      "episode": 3, "control": true,
      "columns": {"step": [10], "loss_generator": [0.765432]}}])"));
}

TEST(ReportJson, AnObjectHasItsFieldsAndThoseOfItsOriginal) {
  Report report;
  report.groups = {{"a", "A", "first"}, {"b", "B"}};
  ReportObject& object = report.objects.emplace_back();
  object.name = "box";
  object.group = 1;
  object.elite = false;
  object.random = false;
  object.status = "few_grasps";
  object.shape.mesh = Transformed(shapes::Box({1.0, 2.0, 4.0}), 1.0, {10.0, 20.0, 30.0});
  object.shape.metres_per_unit = 0.25;
  object.shape.score = ScoreSummary{0.4, 0.3, 0.5, 0.2, 0.9, 7};
  object.original.emplace().label = "was";
  object.original->shape.metres_per_unit = 0.5;
  object.original->shape.score = ScoreSummary{0.8, 0.7, 0.9, 0.6, 1.0, 8};
  const Json json = Json::parse(EncodeReport(report, {}).json);
  EXPECT_EQ(json["groups"][1], Json::parse(R"({"id": "b", "label": "B", "note": ""})"));
  const Json& written = json["objects"][0];
  EXPECT_EQ(written["group"], 1);
  EXPECT_EQ(written["elite"], false);
  EXPECT_EQ(written["random"], false);
  EXPECT_EQ(written["status"], "few_grasps");
  EXPECT_EQ(written["metres_per_unit"], 0.25);
  EXPECT_EQ(written["score"]["graspability"], 0.4);
  EXPECT_EQ(written["mesh"]["min"], Json::parse("[9.5, 19, 28]"));
  EXPECT_EQ(written["mesh"]["extent"], 4.0);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(written["com"][k], 10.0 * (k + 1), 1e-9);
  EXPECT_EQ(written["pair"]["label"], "was");
  EXPECT_EQ(written["pair"]["metres_per_unit"], 0.5);
  EXPECT_EQ(written["pair"]["score"]["graspability"], 0.8);
}

}  // namespace
}  // namespace antigrasp
