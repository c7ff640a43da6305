#include "antigrasp/trial/object_trials.h"

#include <cstdio>
#include <optional>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/format.h"
#include "antigrasp/datasets/objects.h"
#include "antigrasp/datasets/result_folder.h"
#include "antigrasp/quality/object_size.h"
#include "antigrasp/trial/replay_file.h"
#include "antigrasp/trial/trials_csv.h"

namespace antigrasp {
namespace {

const ResultFiles kTrialFiles = {
    "trials.csv", {"executions.csv", "means.csv", "replays.json", "trial.toml"}, {}};

// What all trials of a call write to.
struct Results {
  explicit Results(const Protocol& protocol) : trials(protocol) {}
  TrialsTable trials;
  ExecutionsTable executions;
  MeansTable means;
  ReplayFile replays;
  std::optional<AtomicFile> executions_file, replays_file;  // which grow with every object
  bool any = false;
  std::string first;  // object that could not be tried, and why
};

// The objects of a call, or their originals in the same order and with the same draws.
struct Side {
  const char* name;  // "after", "before"
  const ObjectSource& source;
  std::vector<std::int64_t> places;  // in `source`
};

class Call {
 public:
  Call(const PhysicsTrialRequest& request, const ObjectSource& objects, const MetricOptions& metric,
       const PhysicsTrialOptions& options, RunObserver* observer, Results* results,
       PhysicsTrialReport* report)
      : request_(request),
        objects_(objects),
        metric_(metric),
        options_(options),
        protocol_(ProtocolOf(options.protocol)),
        observer_(*observer),
        results_(*results),
        report_(*report),
        sizes_(metric) {}

  void Run(const std::vector<Side>& sides) {
    for (const double friction : request_.frictions) {
      metric_.friction = friction;
      report_.text += ChoiceName(options_.protocol) + ", friction " + FormatDouble(friction) +
                      ", MuJoCo " + MujocoVersion() + "\n";
      // Lighter is no harder: a comparison is one at equal mass, too.
      const bool own = options_.mass == 0.0, both = sides.size() > 1 && own;
      AtMass(sides, own ? "own" : "equal", options_.mass);
      if (both) AtMass(sides, "equal", request_.equal_mass);
    }
    for (const std::string& text : sizes_.Texts()) report_.warnings.push_back(text);
  }

 private:
  void AtMass(const std::vector<Side>& sides, const char* masses, double mass) {
    PhysicsTrialOptions options = options_;
    options.mass = mass;
    PhysicsTrials trials(metric_, options, request_.seed, request_.threads);
    std::vector<std::vector<TrialSummary>> found(sides.size());
    const ProgressFn progress = observer_.Phase("trials, " + std::string(masses) + " mass");
    const auto count = objects_.size();
    for (std::int64_t i = 0; i < count; ++i) {
      for (std::size_t side = 0; side < sides.size(); ++side) {
        const TrialRun run = {ChoiceName(options_.protocol), sides[side].name, masses,
                              metric_.friction};
        found[side].push_back(TryOne(sides[side], i, run, &trials));
        results_.trials.Add(run, found[side].back());
      }
      progress(i + 1, count);
    }
    results_.means.Add({ChoiceName(options_.protocol), "after", masses, metric_.friction},
                       protocol_, found[0],
                       sides.size() > 1 ? found[1] : std::vector<TrialSummary>{});
    if (sides.size() == 1) {
      report_.text += TrialLines(found[0], protocol_) + TrialMeans(found[0], protocol_);
      return;
    }
    report_.text += std::string(masses) + " mass";
    if (mass > 0.0) report_.text += " " + FormatDouble(1000.0 * mass) + " g";
    report_.text += "\n  before  " + TrialMeans(found[1], protocol_) + "  after   " +
                    TrialMeans(found[0], protocol_) + "  difference  " +
                    TrialDifference(found[0], found[1], protocol_) + "\n";
  }

  TrialSummary TryOne(const Side& side, std::int64_t i, const TrialRun& run,
                      PhysicsTrials* trials) {
    const std::string& name = objects_.name(i);
    const InputObject object = side.source.Load(side.places[static_cast<std::size_t>(i)]);
    if (!object.note.empty()) report_.warnings.push_back(object.name + ": " + object.note);
    if (!object.ok()) return Refused(name, object.status);
    sizes_.Add(object.name, Bounds(object.mesh).Extent());
    const PhysicsTrial trial = trials->Try(object.mesh, objects_.stream(i));
    TrialSummary summary = SummaryOf(name, trial, protocol_);
    if (summary.status != "ok") return Refused(name, summary.status, summary);
    results_.any = true;
    if (!results_.executions_file) return summary;
    results_.executions.Add(run, name, trial);
    results_.executions_file->Append(results_.executions.TakeText());
    if (run.masses == "equal" && options_.mass == 0.0) return summary;  // one replay is enough
    for (const auto& [grasp, draw] : WorthAReplay(trial, request_.replays)) {
      results_.replays.Add(name, run.side, trials, options_.physics.tip, trial, grasp, draw);
    }
    results_.replays_file->Append(results_.replays.TakeText());
    return summary;
  }

  TrialSummary Refused(const std::string& name, const std::string& status) {
    return Refused(name, status, NotTried(name, status, protocol_));
  }
  TrialSummary Refused(const std::string& name, const std::string& status, TrialSummary summary) {
    if (results_.first.empty()) results_.first = name + ": " + status;
    report_.warnings.push_back(name + ": " + status);
    return summary;
  }

  const PhysicsTrialRequest& request_;
  const ObjectSource& objects_;
  MetricOptions metric_;
  PhysicsTrialOptions options_;
  Protocol protocol_;
  RunObserver& observer_;
  Results& results_;
  PhysicsTrialReport& report_;
  UnlikelySizes sizes_;
};

std::string Constants(const PhysicsTrialRequest& request, MetricOptions metric,
                      PhysicsTrialOptions options) {
  OptionTable table;
  Bind(&table, &metric);
  Bind(&table, &options);
  std::string frictions;
  for (const double friction : request.frictions) {
    frictions += (frictions.empty() ? "" : ", ") + FormatDouble(friction);
  }
  return "engine = \"mujoco " + MujocoVersion() + "\"\nprotocol = \"" +
         ChoiceName(options.protocol) + "\"\nseed = " + std::to_string(request.seed) +
         "\nfrictions = [" + frictions + "]\nequal_mass = " + FormatDouble(request.equal_mass) +
         "\n# metric.friction below is not used: frictions above are.\n\n" + table.Dump();
}

std::vector<std::int64_t> InOrder(std::int64_t count) {
  std::vector<std::int64_t> places;
  for (std::int64_t i = 0; i < count; ++i) places.push_back(i);
  return places;
}

}  // namespace

PhysicsTrialReport TryInPhysics(const PhysicsTrialRequest& request, const MetricOptions& metric,
                                const PhysicsTrialOptions& options, RunObserver* observer) {
  PhysicsTrialReport report;
  const ObjectSource objects(request.inputs);
  std::optional<ObjectSource> originals;
  std::vector<Side> sides = {{"after", objects, InOrder(objects.size())}};
  if (!request.baseline.empty()) {
    originals.emplace(request.baseline);
    sides.push_back({"before", *originals, PairWithOriginals(objects, *originals)});
  }
  std::optional<ResultFolder> folder;
  Results results(ProtocolOf(options.protocol));
  if (!request.out.empty()) {
    folder.emplace(request.out, kTrialFiles, objects, request.overwrite);
    results.executions_file.emplace(folder->path() / "executions.csv");
    results.replays_file.emplace(folder->path() / "replays.json");
  }
  Call(request, objects, metric, options, observer, &results, &report).Run(sides);
  if (!results.any) {
    throw InputError("no object could be tried; " + results.first, request.inputs.front(),
                     "a closed solid that the gripper reaches");
  }
  if (!folder) return report;
  results.executions_file->Commit();
  results.replays_file->Append(results.replays.EndText());
  results.replays_file->Commit();
  WriteFileAtomic(folder->path() / "means.csv", results.means.text());
  WriteFileAtomic(folder->path() / "trial.toml", Constants(request, metric, options));
  folder->Commit(results.trials.text());
  report.text +=
      request.out +
      ": trials.csv, means.csv, executions.csv, replays.json (`antigrasp report ... --trials " +
      request.out + "`)\n";
  return report;
}

}  // namespace antigrasp
