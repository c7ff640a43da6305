#include "antigrasp/trial/object_trials.h"

#include <malloc.h>

#include <cstdio>
#include <optional>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/format.h"
#include "antigrasp/core/ordered_stream.h"
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
  // One object on one side, tried on any thread.
  struct Tried {
    TrialSummary summary;
    PhysicsTrial trial;
    std::vector<std::string> replays;
    std::string note;
    Eigen::Vector3d extent = Eigen::Vector3d::Zero();  // zero: not loaded
  };

  void AtMass(const std::vector<Side>& sides, const char* masses, double mass) {
    PhysicsTrialOptions options = options_;
    options.mass = mass;
    const auto side_count = std::ssize(sides), count = objects_.size() * side_count;
    // Objects side by side where there are many, else the grasps of one after another.
    const int threads = request_.threads > 0 ? request_.threads : HardwareThreads();
    const bool many = count >= 2 * threads;
    std::vector<std::vector<TrialSummary>> found(sides.size());
    const auto run_of = [&](std::int64_t i) {
      const Side& side = sides[static_cast<std::size_t>(i % side_count)];
      return TrialRun{ChoiceName(options_.protocol), side.name, masses, metric_.friction};
    };
    StreamInOrder(
        count, many ? threads : 1,
        [&](std::int64_t i) {
          PhysicsTrials trials(metric_, options, request_.seed, many ? 1 : threads);
          return TryOne(sides[static_cast<std::size_t>(i % side_count)], i / side_count, run_of(i),
                        &trials);
        },
        [&](std::int64_t i, const Tried& tried) {
          found[static_cast<std::size_t>(i % side_count)].push_back(tried.summary);
          Record(run_of(i), tried);
        },
        observer_.Phase("trials, " + std::string(masses) + " mass"));
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

  Tried TryOne(const Side& side, std::int64_t i, const TrialRun& run, PhysicsTrials* trials) const {
    const std::string& name = objects_.name(i);
    const InputObject object = side.source.Load(side.places[static_cast<std::size_t>(i)]);
    Tried tried;
    if (!object.note.empty()) tried.note = object.name + ": " + object.note;
    tried.summary = NotTried(name, object.status, protocol_);
    if (!object.ok()) return tried;
    tried.extent = Bounds(object.mesh).Extent();
    tried.trial = trials->Try(object.mesh, objects_.stream(i));
    tried.summary = SummaryOf(name, tried.trial, protocol_);
    // Of a comparison the replays at own mass are enough.
    if (!results_.replays_file || (run.masses == "equal" && options_.mass == 0.0)) return tried;
    for (const auto& [grasp, draw] : WorthAReplay(tried.trial, request_.replays)) {
      tried.replays.push_back(
          ReplayText(name, run.side, trials, options_.physics.tip, tried.trial, grasp, draw));
    }
    return tried;
  }

  void Record(const TrialRun& run, const Tried& tried) {
    const std::string& name = tried.summary.object;
    results_.trials.Add(run, tried.summary);
    if (!tried.note.empty()) report_.warnings.push_back(tried.note);
    if (!tried.extent.isZero()) sizes_.Add(name, tried.extent);
    if (tried.summary.status != "ok") {
      const std::string why = name + ": " + tried.summary.status;
      if (results_.first.empty()) results_.first = why;
      report_.warnings.push_back(why);
      return;
    }
    results_.any = true;
    if (!results_.executions_file) return;
    results_.executions.Add(run, name, tried.trial);
    results_.executions_file->Append(results_.executions.TakeText());
    for (const std::string& replay : tried.replays) results_.replays.Add(replay);
    results_.replays_file->Append(results_.replays.TakeText());
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

// Arrays of megabytes come and go with every object. After the first ones glibc takes such from its
// heap, where what outlives an object then lies between them: memory would grow with the set.
void KeepLargeArraysOffTheHeap() {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 64 * 1024);
#endif
}

}  // namespace

PhysicsTrialReport TryInPhysics(const PhysicsTrialRequest& request, const MetricOptions& metric,
                                const PhysicsTrialOptions& options, RunObserver* observer) {
  KeepLargeArraysOffTheHeap();
  PhysicsTrialReport report;
  const ObjectSource objects(request.inputs, GridUnit::kOfFiles, UnitToReadIn(metric));
  std::optional<ObjectSource> originals;
  std::vector<Side> sides = {{"after", objects, InOrder(objects.size())}};
  if (!request.baseline.empty()) {
    originals.emplace(request.baseline, GridUnit::kOfFiles, UnitToReadIn(metric));
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
