#include "antigrasp/judge/given_objects.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/format.h"
#include "antigrasp/core/shared_stream.h"
#include "antigrasp/datasets/objects.h"
#include "antigrasp/grasp_io/pass_grasps.h"
#include "antigrasp/judge/given_table.h"
#include "antigrasp/quality/given_grasps.h"
#include "antigrasp/quality/object_size.h"
#include "antigrasp/quality/pass_scores.h"

namespace antigrasp {
namespace {

// The grasps of every object, in the order of the table.
struct ByObject {
  std::vector<std::vector<GivenGrasp>> grasps;
  std::int64_t others = 0;  // of objects that are not scored
};

// "mug.stl, pot.stl and 3 more".
std::string Named(const std::set<std::string>& names) {
  std::string text;
  int left = 2;
  for (const std::string& name : names) {
    if (left-- == 0) return text + " and " + std::to_string(std::ssize(names) - 2) + " more";
    text += (text.empty() ? "" : ", ") + (name.empty() ? std::string("no object") : name);
  }
  return text;
}

ByObject Sort(GraspsRead read, const ObjectSource& objects, const std::string& table) {
  std::vector<GivenGrasp>& all = read.grasps;
  ByObject by;
  by.grasps.resize(static_cast<std::size_t>(objects.size()));
  std::set<std::string> named;
  for (const GivenGrasp& grasp : all) named.insert(grasp.object);
  // An only object takes rows without a name, and those of its name in whatever folder.
  const bool same = objects.size() == 1 && named.size() == 1 &&
                    (named.begin()->empty() || StreamOf(*named.begin()) == objects.stream(0));
  if (same) {
    by.grasps.front() = std::move(all);
    return by;
  }
  std::map<std::string, std::size_t> place;  // names are told apart by their file names
  for (std::int64_t i = 0; i < objects.size(); ++i) {
    place[FileNameOf(objects.name(i))] = static_cast<std::size_t>(i);
  }
  for (GivenGrasp& grasp : all) {
    auto found = place.find(FileNameOf(grasp.object));
    if (found == place.end() && read.of_mesh_files) {
      found = place.find(FileNameOf(std::filesystem::path(grasp.object).filename().string()));
    }
    if (found == place.end()) {
      ++by.others;
    } else {
      by.grasps[found->second].push_back(std::move(grasp));
    }
  }
  if (by.others == std::ssize(all)) {
    throw InputError("grasps of " + Named(named) + ", no grasp of " + objects.name(0), table,
                     read.of_mesh_files
                         ? "the mesh that it names among the objects that are scored"
                         : "the names of the objects that are scored in the column object");
  }
  return by;
}

constexpr double kScaleRounding = 1e-6;

bool SameScale(double a, double b) { return std::abs(a - b) <= kScaleRounding * b; }

// At the scale that a file of grasps says, where the object would be rescaled anyway.
MetricOptions AtScaleOf(const std::vector<GivenGrasp>& grasps, const Eigen::Vector3d& extent,
                        MetricOptions metric) {
  const auto said = std::find_if(grasps.begin(), grasps.end(),
                                 [](const GivenGrasp& grasp) { return grasp.says_scale; });
  if (said == grasps.end() || AtTrueSize(metric)) return metric;
  if (!SameScale(said->metres_per_unit, MetresPerUnit(metric, extent))) {
    metric.object_min_extent = said->metres_per_unit * extent.minCoeff();
  }
  return metric;
}

// A table says the size that its grasps were planned at: at another one they are not these grasps.
void RequireSameScale(const std::string& object, const TriangleMesh& mesh,
                      const std::vector<GivenGrasp>& grasps, const MetricOptions& metric,
                      const std::string& table) {
  const double scale = MetresPerUnit(metric, Bounds(mesh).Extent());
  for (const GivenGrasp& grasp : grasps) {
    if (!grasp.says_scale || SameScale(grasp.metres_per_unit, scale)) continue;
    throw InputError("grasps of " + object + " at metres_per_unit " +
                         FormatDouble(grasp.metres_per_unit) + ", which is scored at " +
                         FormatDouble(scale),
                     table, "--units, --true-size and --object-min-extent as when it was written");
  }
}

struct ScoredGrasps {
  std::string status, note;  // of the object
  Eigen::Vector3d extent = Eigen::Vector3d::Zero();
  std::vector<GivenScore> scores;
  std::vector<TriedGrasp> tried;
  bool at_scale_of_file = false;
  GraspSet set;  // where it is to be written
};

void PassFields(Passer& pass, ScoredGrasps& scored) {
  pass(scored.status, scored.note, scored.extent, scored.scores, scored.tried,
       scored.at_scale_of_file, scored.set);
}

// Of the grasps that could be scored.
GraspSet SetOf(const std::string& name, double scale, const std::vector<GivenGrasp>& grasps,
               const ScoredGrasps& scored) {
  GraspSet set;
  set.object = name;
  set.metres_per_unit = scale;
  for (std::size_t i = 0; i < grasps.size(); ++i) {
    const GivenScore& score = scored.scores[i];
    if (!score.scored()) continue;
    PosedGrasp grasp{grasps[i].id, grasps[i].center, score.grasp.axis, score.grasp.approach};
    if (grasps[i].frame == GraspFrame::kMesh) {
      grasp.center *= scale;
    } else if (grasps[i].metres_per_unit != scale) {
      grasp.center *= scale / grasps[i].metres_per_unit;
    }
    if (score.status == GivenScore::kOk) grasp.width = score.grasp.width;
    grasp.quality = score.robust_quality;
    grasp.candidate = grasps[i].candidate;
    if (!scored.tried.empty()) {
      grasp.executions = scored.tried[i].executions;
      grasp.held = scored.tried[i].held;
    }
    set.grasps.push_back(std::move(grasp));
  }
  return set;
}

void TryGrasps(const TriangleMesh& mesh, std::uint64_t stream,
               const std::vector<GivenGrasp>& grasps, PhysicsTrials* trials, ScoredGrasps* scored) {
  std::vector<ProposedGrasp> proposed;
  std::vector<std::size_t> place_of;
  for (std::size_t i = 0; i < grasps.size(); ++i) {
    scored->tried.push_back({"not scored"});
    if (!scored->scores[i].scored()) continue;
    proposed.push_back({scored->scores[i].grasp, grasps[i].candidate});
    place_of.push_back(i);
  }
  const PhysicsTrial trial = trials->Try(mesh, stream, proposed);
  for (const std::size_t place : place_of) {
    scored->tried[place].status = trial.tried ? "not reachable" : "no stable pose";
  }
  for (const ExecutedGrasp& grasp : trial.grasps) {
    TriedGrasp& tried = scored->tried[place_of[grasp.planned.place]];
    tried.status = "ok";
    if (trials->protocol().table) tried.pose = static_cast<std::int64_t>(grasp.planned.pose);
    for (const ExecutedDraw& draw : grasp.draws) {
      ++tried.executions;
      tried.held += draw.execution.stages > 0 ? 1 : 0;
    }
  }
}

std::string TrialToml(MetricOptions metric, PhysicsTrialOptions trial) {
  OptionTable table;
  Bind(&table, &metric);
  Bind(&table, &trial);
  return "engine = \"mujoco " + MujocoVersion() + "\"\nprotocol = \"" + ChoiceName(trial.protocol) +
         "\"\n\n" + table.Dump();
}

}  // namespace

GivenReport ScoreGiven(const GivenRequest& request, const MetricOptions& metric,
                       const MetricOptions& trial_metric, const PhysicsTrialOptions& trial,
                       RunObserver* observer) {
  const ObjectSource objects(request.inputs, GridUnit::kOfFiles, UnitToReadIn(metric));
  const bool sampled = request.grasps.empty(), helps = Helps(request.share);
  std::vector<GivenGrasp> given = request.sampled;
  if (sampled) TellAll(request.share, &given);
  if (sampled && given.empty()) {
    throw InputError("no grasp to execute", request.inputs.front(), "objects that can be grasped");
  }
  GraspsRead read = sampled ? GraspsRead{std::move(given), false}
                            : ReadGraspFiles(request.grasps, request.output.about.base, metric);
  const bool of_mesh_files = read.of_mesh_files;
  const ByObject by = Sort(std::move(read), objects, request.grasps);
  GraspFiles grasp_files(helps ? GraspOutput{} : request.output, objects);
  const bool makes_sets = !request.output.path.empty();
  GivenReport report;
  GivenTable table(request.in_physics);
  UnlikelySizes sizes(metric);
  std::string first;         // object that is not usable, and why
  int at_scale_of_file = 0;  // objects
  std::optional<AtomicFile> file;
  if (!request.out.empty() && !sampled && !helps) file.emplace(request.out);
  // Objects side by side where there are many, else the executions of one.
  const int threads = request.threads > 0 ? request.threads : HardwareThreads();
  const bool many = objects.size() >= 2 * threads * RanksOf(request.share);
  if (request.in_physics) PhysicsTrials(trial_metric, trial, request.seed, 1);  // refuses early
  StreamShared(
      request.share, objects.size(), many ? threads : 1,
      [&](std::int64_t i) {
        std::vector<GivenGrasp> grasps = by.grasps[static_cast<std::size_t>(i)];
        ScoredGrasps scored;
        if (grasps.empty()) return scored;
        const InputObject object = objects.Load(i);
        scored.status = object.status;
        if (!object.note.empty()) scored.note = object.name + ": " + object.note;
        if (!object.ok()) return scored;
        scored.extent = Bounds(object.mesh).Extent();
        const MetricOptions its = of_mesh_files ? AtScaleOf(grasps, scored.extent, metric) : metric;
        const double scale = MetresPerUnit(its, scored.extent);
        for (GivenGrasp& grasp : grasps) {
          if (of_mesh_files && !grasp.says_scale) grasp.metres_per_unit = scale;
        }
        scored.at_scale_of_file = its.object_min_extent != metric.object_min_extent;
        RequireSameScale(object.name, object.mesh, grasps, its, request.grasps);
        scored.scores = ScoreGivenGrasps(object.mesh, grasps, its, request.seed, objects.stream(i));
        if (request.in_physics) {
          MetricOptions its_trial = trial_metric;
          its_trial.object_min_extent = its.object_min_extent;
          PhysicsTrials trials(its_trial, trial, request.seed, many ? 1 : threads);
          TryGrasps(object.mesh, objects.stream(i), grasps, &trials, &scored);
        }
        if (makes_sets) scored.set = SetOf(object.name, scale, grasps, scored);
        return scored;
      },
      [&](std::int64_t i, const ScoredGrasps& scored) {
        const std::string& name = objects.name(i);
        table.Add(name, scored.status, by.grasps[static_cast<std::size_t>(i)], scored.scores,
                  scored.tried);
        if (!scored.set.object.empty()) grasp_files.Add(i, scored.set);
        at_scale_of_file += scored.at_scale_of_file ? 1 : 0;
        if (!scored.note.empty()) report.warnings.push_back(scored.note);
        if (!scored.extent.isZero()) sizes.Add(name, scored.extent);
        if (scored.scores.empty() && !scored.status.empty()) {
          if (first.empty()) first = name + ": " + scored.status;
          report.warnings.push_back(name + ": " + scored.status);
        }
        if (file) {
          file->Append(table.TakeText());
        } else if (const std::string rows = table.TakeText(); !sampled) {
          report.table += rows;
        }
      },
      observer->Phase("scoring grasps"));
  if (helps) return report;
  if (!table.any_scored() && !first.empty()) {
    throw InputError("no object scored; " + first, request.inputs.front(), "a closed solid");
  }
  report.summary = table.Summary();
  if (by.others > 0) {
    report.summary.push_back(std::to_string(by.others) + " grasps of other objects are left out");
  }
  if (at_scale_of_file > 0) {
    report.summary.push_back(std::to_string(at_scale_of_file) +
                             " objects scored at the scale that " + request.grasps + " says");
  }
  for (const std::string& text : sizes.Texts()) report.warnings.push_back(text);
  if (table.all_miss()) {
    report.warnings.emplace_back(
        "every grasp is beside its object: is the table in the unit and frame of the mesh?");
  }
  for (std::string& text : grasp_files.Commit()) report.warnings.push_back(std::move(text));
  if (file) {
    file->Commit();
    WriteFileAtomic(request.out + ".metric.toml", MetricToml(metric, request.seed));
  }
  if (request.in_physics && !request.out.empty()) {
    WriteFileAtomic(request.out + ".trial.toml", TrialToml(trial_metric, trial));
  }
  return report;
}

void AddGiven(const ScoredObject& scored, std::vector<GivenGrasp>* grasps) {
  for (std::size_t g = 0; g < scored.score.grasps.size(); ++g) {
    const auto& [grasp, quality, draws, candidate] = scored.score.grasps[g];
    GivenGrasp given;
    given.object = scored.name;
    given.id = std::to_string(g);
    given.frame = GraspFrame::kMetres;
    given.metres_per_unit = scored.score.scale;
    given.says_scale = given.of_a_candidate = true;
    given.center = grasp.center;
    given.axis = grasp.axis;
    given.approach = grasp.approach;
    given.width = grasp.width;
    given.candidate = candidate;
    grasps->push_back(std::move(given));
  }
}

}  // namespace antigrasp
