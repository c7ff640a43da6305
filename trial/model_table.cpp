#include "antigrasp/trial/model_table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "antigrasp/core/csv_writer.h"
#include "antigrasp/core/format.h"

namespace antigrasp {
namespace {

double ShareOf(int count, int total) { return static_cast<double>(count) / total; }

std::string ShareText(const Share& share) {
  char text[64];
  std::snprintf(text, sizeof text, "%5.1f [%5.1f, %5.1f]", 100.0 * share.value,
                100.0 * share.interval.low, 100.0 * share.interval.high);
  return std::isnan(share.value) ? "" : text;
}

std::string Padded(const std::string& text, std::size_t width) {
  return text + std::string(text.size() < width ? width - text.size() : 0, ' ');
}

std::string Line(const TrialReading& reading, const TrialResult& result) {
  char text[256];
  std::snprintf(text, sizeof text, "  %-10s  %8.4f  %5.1f  %15.1f  %s  %s\n",
                ChoiceName(reading.reading).c_str(), reading.friction,
                100.0 * ShareOf(result.found, result.grasps),
                100.0 * ShareOf(result.holds_planned, result.grasps),
                ShareText(result.force_closure).c_str(), ShareText(result.held).c_str());
  return text;
}

}  // namespace

std::vector<TrialReading> RunReadings(const std::vector<InputObject>& objects,
                                      std::optional<FrictionReading> chosen, double angle_degrees,
                                      MetricOptions metric, const TrialOptions& options,
                                      std::uint64_t seed, int threads, RunObserver* observer) {
  std::vector<TriangleMesh> meshes;
  std::vector<std::uint64_t> streams;
  for (const InputObject& object : objects) {
    meshes.push_back(object.mesh);
    streams.push_back(object.stream);
  }
  std::vector<TrialReading> all;
  for (const auto [reading, name] : ChoicesOf(FrictionReading{})) {
    if (chosen && chosen != reading) continue;
    metric.friction = FrictionCoefficient(angle_degrees, reading);
    all.push_back({reading, metric.friction,
                   RunTrials(meshes, metric, options, seed, threads,
                             observer->Phase("trials, " + std::string(name)), streams)});
  }
  return all;
}

std::string TrialCsv(const std::vector<std::string>& objects,
                     const std::vector<TrialReading>& readings) {
  CsvWriter csv({"object", "reading", "friction", "poses", "grasps", "found", "holds_planned",
                 "confidence", "force_closure", "force_closure_low", "force_closure_high", "held",
                 "held_low", "held_high"});
  for (std::size_t i = 0; i < objects.size(); ++i) {
    for (const TrialReading& reading : readings) {
      const TrialResult& result = reading.results[i];
      csv.Text(objects[i]).Text(ChoiceName(reading.reading)).Number(reading.friction);
      csv.Count(result.poses).Count(result.grasps).Count(result.found).Count(result.holds_planned);
      csv.Number(result.confidence);
      for (const Share* share : {&result.force_closure, &result.held}) {
        csv.Numbers({share->value, share->interval.low, share->interval.high});
      }
      csv.EndRow();
    }
  }
  return csv.text();
}

std::string ModelTrialToml(std::uint64_t seed, double friction_angle, const std::string& reading) {
  return "seed = " + std::to_string(seed) + "\nfriction_angle = " + FormatDouble(friction_angle) +
         "\nreading = \"" + reading +
         "\"\n# Not used below: metric.friction, which the friction angle sets, and "
         "metric.percentile.\n\n";
}

std::string TrialText(const std::vector<std::string>& objects,
                      const std::vector<TrialReading>& readings, double min_epsilon) {
  std::size_t width = 6;
  for (const std::string& object : objects) width = std::max(width, object.size());
  char limit[32];
  std::snprintf(limit, sizeof limit, "epsilon > %g", min_epsilon);
  std::string text = "% of the grasps     " + std::string(width + 3, ' ') +
                     " planned             executed under noise [95 %]\n";
  text += Padded("object", width) + "  reading     friction  found  " + limit +
          "  force closure         " + limit + "\n";
  for (std::size_t i = 0; i < objects.size(); ++i) {
    for (const TrialReading& reading : readings) {
      text += Padded(objects[i], width) + Line(reading, reading.results[i]);
    }
  }
  return text;
}

}  // namespace antigrasp
