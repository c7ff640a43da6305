#include "antigrasp/report/page/report_json.h"

#include <charconv>
#include <cmath>

#include "antigrasp/core/format.h"
#include "antigrasp/quality/object_size.h"

namespace antigrasp {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kVersion = 2;

// Six significant digits: more than a chart shows, half the bytes.
double Rounded(double value) {
  if (!std::isfinite(value)) return value;
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, 6);
  std::from_chars(text, end.ptr, value);
  return value;
}

Json RoundedJson(const std::vector<double>& values) {
  Json json = Json::array();
  for (const double value : values) json.push_back(Rounded(value));
  return json;
}

std::string NoiseText(const MetricOptions& m) {
  return "object " + FormatDouble(1e3 * m.object_translation_std) + " mm, " +
         FormatDouble(m.object_rotation_std) + " rad; grasp " +
         FormatDouble(1e3 * m.grasp_translation_std) + " mm, " +
         FormatDouble(m.grasp_rotation_std) + " rad; friction " + FormatDouble(m.friction_std);
}

Json MetricJson(const MetricOptions& m) {
  return {{"percentile", m.percentile}, {"friction", m.friction},
          {"num_grasps", m.num_grasps}, {"num_draws", m.num_draws},
          {"noise", NoiseText(m)},      {"finger_radius", m.finger_radius},
          {"size", SizeText(m)}};
}

Json GripperJson(const MetricOptions& m) {
  const GripperModel& g = m.gripper;
  return {{"palm_distance", g.palm_distance}, {"fingertip_overlap", g.fingertip_overlap},
          {"finger_width", g.finger_width},   {"finger_thickness", g.finger_thickness},
          {"palm_depth", g.palm_depth},       {"palm_length", g.palm_length},
          {"palm_width", g.palm_width},       {"jaw_opening", m.jaw_opening}};
}

Json StageJson(const ReportStage& stage) {
  Json json = {{"id", stage.id},           {"label", stage.label},     {"episode", stage.episode},
               {"control", stage.control}, {"samples", stage.samples}, {"statuses", Json::array()}};
  for (const auto& [status, count] : stage.statuses) {
    json["statuses"].push_back(Json::array({status, count}));
  }
  json["graspability"] = {{"mean", stage.graspability.mean},
                          {"half_width", stage.graspability.half_width},
                          {"count", stage.graspability.count}};
  json["elite_threshold"] = stage.elite_threshold;
  json["coverage"] = stage.coverage;
  json["nna"] = stage.nna;
  json["duplicates"] = stage.duplicates;
  json["diversity"] = stage.diversity;
  json["flat_share"] = stage.flat;
  json["crease_share"] = stage.crease;
  json["scores"] = stage.scores ? RoundedJson(*stage.scores) : Json();
  return json;
}

Json LossesJson(const ReportLosses& losses) {
  Json json = {{"episode", losses.episode}, {"control", losses.control}};
  Json& columns = json["columns"] = Json::object();
  for (const auto& [name, values] : losses.columns) columns[name] = RoundedJson(values);
  return json;
}

Json RunJson(const ReportRun& run) {
  Json json = {{"stages", Json::array()}, {"losses", Json::array()}};
  for (const ReportStage& stage : run.stages) json["stages"].push_back(StageJson(stage));
  for (const ReportLosses& losses : run.losses) json["losses"].push_back(LossesJson(losses));
  return json;
}

}  // namespace

Json VectorJson(const Eigen::Vector3d& v) { return Json::array({v.x(), v.y(), v.z()}); }

Json PairsJson(const std::vector<LabelledText>& pairs) {
  Json json = Json::array();
  for (const auto& [label, text] : pairs) json.push_back(Json::array({label, text}));
  return json;
}

Json ScoreJson(const ScoreSummary& score) {
  return {{"graspability", score.graspability},
          {"ci_low", score.ci_low},
          {"ci_high", score.ci_high},
          {"mean", score.mean},
          {"fraction_nonzero", score.fraction_nonzero},
          {"num_grasps", score.num_grasps}};
}

Json PrintJson(const ReportPrint& print) {
  Json json = {{"size_mm", VectorJson(print.size_mm)},
               {"wall_mm", print.wall_mm},
               {"watertight", print.watertight},
               {"overhang", print.overhang}};
  Json& pose = json["pose"] = nullptr;
  if (print.pose) {
    pose = Json::array();
    for (int row = 0; row < 3; ++row) pose.push_back(VectorJson(print.pose->row(row)));
  }
  json["pose_probability"] = print.pose ? Json(print.pose_probability) : Json();
  json["notes"] = print.notes;
  return json;
}

Json TrialsJson(const ReportTrials& trials) {
  Json json = {{"series", Json::array()}, {"grasps", Json::array()}, {"replays", Json::array()}};
  for (const ReportTrialSeries& series : trials.series) {
    json["series"].push_back({{"protocol", series.protocol},
                              {"side", series.before ? "before" : "after"},
                              {"masses", series.masses},
                              {"friction", series.friction},
                              {"held", Rounded(series.held)},
                              {"low", Rounded(series.low)},
                              {"high", Rounded(series.high)}});
  }
  for (const ReportTrialGrasp& grasp : trials.grasps) {
    Json outcomes = Json::array();
    for (const auto& [word, count] : grasp.outcomes) outcomes.push_back(Json::array({word, count}));
    json["grasps"].push_back({{"series", grasp.series},
                              {"grasp", grasp.grasp},
                              {"quality", Rounded(grasp.quality)},
                              {"held", grasp.held},
                              {"executions", grasp.executions},
                              {"outcomes", outcomes}});
  }
  for (const ReportReplay& replay : trials.replays) {
    json["replays"].push_back(Json::parse(replay.keys));
  }
  return json;
}

Json HeadJson(const Report& report) {
  Json json = {{"format", "antigrasp.report"},
               {"version", kVersion},
               {"title", report.title},
               {"kind", report.kind},
               {"missing", report.missing},
               {"provenance", PairsJson(report.provenance)},
               {"config", report.config ? Json(*report.config) : Json()},
               {"metric", report.metric ? MetricJson(*report.metric) : Json()},
               {"gripper", report.metric ? GripperJson(*report.metric) : Json()},
               {"run", report.run ? RunJson(*report.run) : Json()},
               {"groups", Json::array()}};
  for (const auto& [id, label, note] : report.groups) {
    json["groups"].push_back({{"id", id}, {"label", label}, {"note", note}});
  }
  return json;
}

}  // namespace antigrasp
