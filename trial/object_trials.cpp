#include "antigrasp/trial/object_trials.h"

#include <malloc.h>

#include <cstdio>
#include <optional>

#include "antigrasp/core/error.h"
#include "antigrasp/core/format.h"
#include "antigrasp/core/rng.h"
#include "antigrasp/core/shared_stream.h"
#include "antigrasp/datasets/objects.h"
#include "antigrasp/quality/object_size.h"
#include "antigrasp/trial/pass_trials.h"
#include "antigrasp/trial/trial_results.h"

namespace antigrasp {
namespace {

std::uint64_t MeshHash(const TriangleMesh& mesh) {
  const auto bytes = [](const auto& items) {
    return std::string_view(reinterpret_cast<const char*>(items.data()),
                            items.size() * sizeof(items.front()));
  };
  return HashOf(bytes(mesh.vertices)) ^ (HashOf(bytes(mesh.faces)) >> 1);
}

// The objects of a call, or their originals in the same order and with the same draws.
struct Side {
  const char* name;  // "after", "before"
  const ObjectSource& source;
  std::vector<std::int64_t> places;  // in `source`
};

class Call {
 public:
  Call(const PhysicsTrialRequest& request, const ObjectSource& objects, const MetricOptions& metric,
       const PhysicsTrialOptions& options, RunObserver* observer, std::int64_t done,
       TrialResults* results, PhysicsTrialReport* report)
      : request_(request),
        objects_(objects),
        metric_(metric),
        options_(options),
        protocol_(ProtocolOf(options.protocol)),
        observer_(*observer),
        done_(done),
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
      if (both && !report_.interrupted) AtMass(sides, "equal", request_.equal_mass);
      if (report_.interrupted) break;
    }
    for (const std::string& text : sizes_.Texts()) report_.warnings.push_back(text);
    if (any_share_ || !results_.finished() || Helps(request_.share)) return;
    throw InputError("no object could be tried; " + first_, request_.inputs.front(),
                     "a closed solid that the gripper reaches");
  }

 private:
  // One object on one side, tried on any thread.
  struct Tried {
    TrialSummary summary;
    PhysicsTrial trial;
    std::vector<std::string> replays;
    std::string note;
    Eigen::Vector3d extent = Eigen::Vector3d::Zero();  // zero: not loaded
    std::uint64_t mesh = 0;                            // hash
    bool done = false;                                 // before this call: no summary
    friend void PassFields(Passer& pass, Tried& tried) {
      pass(tried.summary, tried.trial, tried.replays, tried.note, tried.extent, tried.mesh,
           tried.done);
    }
  };

  void AtMass(const std::vector<Side>& sides, const char* masses, double mass) {
    PhysicsTrialOptions options = options_;
    options.mass = mass;
    const auto side_count = std::ssize(sides), count = objects_.size() * side_count;
    // Objects side by side where there are many, else the grasps of one after another.
    const int threads = request_.threads > 0 ? request_.threads : HardwareThreads();
    const bool many = count >= 2 * threads * RanksOf(request_.share);
    std::vector<std::vector<TrialSummary>> found(sides.size());
    const auto run_of = [&](std::int64_t i) {
      const Side& side = sides[static_cast<std::size_t>(i % side_count)];
      return TrialRun{ChoiceName(options_.protocol), side.name, masses, metric_.friction};
    };
    const std::int64_t first = trials_;
    trials_ += count;
    try {
      StreamShared(
          request_.share, count, many ? threads : 1,
          [&](std::int64_t i) {
            return TryOne(sides[static_cast<std::size_t>(i % side_count)], i / side_count,
                          run_of(i), first + i, options, many ? 1 : threads);
          },
          [&](std::int64_t i, Tried tried) {
            if (tried.done) {
              TakeDone(results_.done()[static_cast<std::size_t>(first + i)],
                       objects_.name(i / side_count), run_of(i), &tried);
            }
            found[static_cast<std::size_t>(i % side_count)].push_back(tried.summary);
            Record(run_of(i), tried);
          },
          observer_.Phase("trials, " + std::string(masses) + " mass"));
    } catch (const Interrupted&) {
      report_.interrupted = true;
    }
    if (sides.size() > 1) found[0].resize(found[1].size());  // what has its pair
    if (!found[0].empty()) Tell(found, masses, mass);
  }

  // What the objects of one kind of mass come to.
  void Tell(const std::vector<std::vector<TrialSummary>>& found, const char* masses, double mass) {
    const bool paired = found.size() > 1;
    results_.means()->Add({ChoiceName(options_.protocol), "after", masses, metric_.friction},
                          protocol_, found[0], paired ? found[1] : std::vector<TrialSummary>{});
    if (!paired) {
      report_.text += TrialLines(found[0], protocol_, metric_) + TrialMeans(found[0], protocol_);
      return;
    }
    report_.text += std::string(masses) + " mass";
    if (mass > 0.0) report_.text += " " + FormatDouble(1000.0 * mass) + " g";
    report_.text += "\n  before  " + TrialMeans(found[1], protocol_) + "  after   " +
                    TrialMeans(found[0], protocol_) + "  difference  " +
                    TrialDifference(found[0], found[1], protocol_) + "\n";
  }

  // `number`: which trial of the call it is.
  Tried TryOne(const Side& side, std::int64_t i, const TrialRun& run, std::int64_t number,
               const PhysicsTrialOptions& options, int threads) const {
    const std::string& name = objects_.name(i);
    const InputObject object = side.source.Load(side.places[static_cast<std::size_t>(i)]);
    Tried tried;
    if (!object.note.empty()) tried.note = object.name + ": " + object.note;
    tried.mesh = MeshHash(object.mesh);
    tried.done = number < done_;
    if (object.ok()) tried.extent = Bounds(object.mesh).Extent();
    if (tried.done) return tried;
    tried.summary = NotTried(name, object.status, protocol_);
    if (!object.ok()) return tried;
    PhysicsTrials trials(metric_, options, request_.seed, threads);
    tried.trial = trials.Try(object.mesh, objects_.stream(i));
    tried.summary = SummaryOf(name, tried.trial, protocol_);
    // Of a comparison the replays at own mass are enough.
    if (request_.out.empty() || (run.masses == "equal" && options_.mass == 0.0)) return tried;
    for (const auto& [grasp, draw] : WorthAReplay(tried.trial, request_.replays)) {
      tried.replays.push_back(
          ReplayText(name, run.side, &trials, options_.physics.tip, tried.trial, grasp, draw));
    }
    return tried;
  }

  // What is in the folder already.
  static void TakeDone(const TrialRow& row, const std::string& name, const TrialRun& run,
                       Tried* tried) {
    if (row.summary.object != name || row.run != run) tried->mesh = 0;  // another object's
    tried->summary = row.summary;
  }

  void Record(const TrialRun& run, const Tried& tried) {
    const std::string& name = tried.summary.object;
    results_.Add(run, tried.summary, tried.done ? nullptr : &tried.trial, tried.replays,
                 tried.mesh);
    if (!tried.note.empty()) report_.warnings.push_back(tried.note);
    if (!tried.extent.isZero()) sizes_.Add(name, tried.extent);
    any_share_ = any_share_ || tried.summary.HasShare();
    if (tried.summary.status == "ok") return;
    report_.warnings.push_back(name + ": " + tried.summary.status);
    if (first_.empty()) first_ = report_.warnings.back();
  }

  const PhysicsTrialRequest& request_;
  const ObjectSource& objects_;
  MetricOptions metric_;
  PhysicsTrialOptions options_;
  Protocol protocol_;
  RunObserver& observer_;
  std::int64_t done_, trials_ = 0;  // before this call, and given out so far
  TrialResults& results_;
  PhysicsTrialReport& report_;
  UnlikelySizes sizes_;
  bool any_share_ = false;
  std::string first_;  // object that is not ok, and why
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
  const std::size_t masses = sides.size() > 1 && options.mass == 0.0 ? 2 : 1;
  const std::size_t of =
      request.frictions.size() * masses * sides.size() * static_cast<std::size_t>(objects.size());
  PhysicsTrialRequest written = request;
  if (Helps(request.share)) written.out.clear();
  TrialResults results(written, ProtocolOf(options.protocol), objects,
                       Constants(request, metric, options), of);
  std::int64_t done = std::ssize(results.done());
  TellAll(request.share, &done);
  Call(request, objects, metric, options, observer, done, &results, &report).Run(sides);
  if (Helps(request.share)) return report;
  if (!results.finished() && results.added() <= results.done().size()) throw Interrupted();
  results.Commit();
  report.interrupted = !results.finished();  // nothing is missing when it was the last one
  const bool kept = !request.out.empty();
  if (kept) {
    report.text +=
        request.out +
        ": trials.csv, means.csv, executions.csv, replays.json (`antigrasp report ... --trials " +
        request.out + "`)\n";
  }
  if (!results.finished()) {
    report.text += "stopped after " + std::to_string(results.added()) + " of " +
                   std::to_string(of) + " trials of an object" +
                   (kept ? "; the same call, without --overwrite, goes on\n"
                         : ", which are not kept: there is no --out\n");
  }
  return report;
}

}  // namespace antigrasp
