#include "antigrasp/report/report_settings.h"

#include <cmath>
#include <cstdio>

#include "antigrasp/core/atomic_file.h"

namespace antigrasp {

ReportShape ShapeOf(TriangleMesh mesh, const Graspability& score) {
  std::vector<ScoredGrasp> shown = score.grasps;
  if (shown.size() > kShownGrasps) shown.resize(kShownGrasps);
  return {SummaryOf(score), std::move(mesh), score.scale, std::move(shown)};
}

std::string NumberText(double value) {
  if (std::isnan(value)) return "";
  char text[32];
  const bool whole = value == std::floor(value) && std::abs(value) < 1e9;
  std::snprintf(text, sizeof text, whole ? "%.0f" : "%.4g", value);
  return text;
}

SavedMetric ReadSavedMetric(const std::string& path) {
  SavedMetric saved;
  saved.toml = ReadFile(path);
  OptionTable table;
  table.Add("seed", &saved.seed, "");
  table.Add("judge.name", &saved.judge, {}, "");
  Bind(&table, &saved.metric);
  table.ApplyKnown(saved.toml, path, "metric.");
  return saved;
}

}  // namespace antigrasp
