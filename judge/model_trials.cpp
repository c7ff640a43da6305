#include "antigrasp/judge/model_trials.h"

#include <vector>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/quality/object_size.h"
#include "antigrasp/trial/model_table.h"

namespace antigrasp {
namespace {

std::vector<InputObject> LoadUsable(const PhysicsTrialRequest& request, const MetricOptions& metric,
                                    RunObserver* observer, const WarnFn& warn) {
  const ObjectSource source(request.inputs, GridUnit::kOfFiles, UnitToReadIn(metric));
  source.RequireNotRead({request.out});
  std::vector<InputObject> objects =
      LoadObjects(source, request.threads, observer->Phase("reading"));
  WarnOfNotes(objects, warn);
  const std::string first = objects.front().status;
  for (const InputObject& object : objects) {
    if (!object.ok()) warn(object.name + ": left out: " + object.status);
  }
  std::erase_if(objects, [](const InputObject& object) { return !object.ok(); });
  if (objects.empty()) throw InputError(first, request.inputs.front(), "a closed, oriented mesh");
  return objects;
}

}  // namespace

std::string TryByModel(const PhysicsTrialRequest& request, const MetricOptions& metric,
                       const TrialOptions& options, double friction_angle,
                       const std::string& reading, RunObserver* observer, const WarnFn& warn) {
  if (!request.out.empty()) const AtomicFile probe(request.out);  // refused before the work
  const std::vector<InputObject> objects = LoadUsable(request, metric, observer, warn);
  WarnOfSizes(objects, metric, warn);
  const std::vector<TrialReading> all =
      RunReadings(objects, FindChoice<FrictionReading>(reading), friction_angle, metric, options,
                  request.seed, request.threads, observer);
  std::vector<std::string> names;
  for (const InputObject& object : objects) names.push_back(object.name);
  if (!request.out.empty()) {
    WriteFileAtomic(request.out, TrialCsv(names, all));
    TrialOptions bound = options;
    MetricOptions bound_metric = metric;
    OptionTable table;
    Bind(&table, &bound);
    Bind(&table, &bound_metric);
    WriteFileAtomic(request.out + ".trial.toml",
                    ModelTrialToml(request.seed, friction_angle, reading) + table.Dump());
  }
  return TrialText(names, all, options.min_epsilon);
}

}  // namespace antigrasp
