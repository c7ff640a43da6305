#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "antigrasp/quality/metric_options.h"
#include "antigrasp/report/page/report.h"

namespace antigrasp {

// What the command line asks of a report.
struct ReportSettings {
  std::vector<std::string> inputs;
  MetricOptions metric;       // of objects that come without a metric of their own
  bool raise_effort = false;  // for few of them, as evaluate does (quality/sampling_effort.h)
  std::uint64_t seed = 1;
  int per_stage = 40;     // objects of every stage of a run
  std::size_t limit = 0;  // objects in all, of other inputs; 0 = all
  int threads = 0;
};

// The mesh with what EvaluateGraspability said about it, and the first kShownGrasps grasps: they
// are drawn alike, and a page has no room for more.
inline constexpr std::size_t kShownGrasps = 100;
ReportShape ShapeOf(TriangleMesh mesh, const Graspability& score);

// A number in a person's text: whole, or of four significant digits; "" for NaN.
std::string NumberText(double value);

// The seed and the metric's constants as `evaluate` and `perturb` write them beside their tables.
struct SavedMetric {
  std::uint64_t seed = 1;
  MetricOptions metric;
  std::string toml;        // all of it
  std::string judge = {};  // who else scored; "" = nobody

  std::string Constants() const { return toml.substr(0, toml.find("\n[judge]\n")); }
};
SavedMetric ReadSavedMetric(const std::string& path);  // InputError with file:line

}  // namespace antigrasp
