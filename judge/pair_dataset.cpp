#include "antigrasp/judge/pair_dataset.h"

#include <array>
#include <optional>
#include <utility>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/ordered_stream.h"
#include "antigrasp/datasets/objects.h"
#include "antigrasp/datasets/result_folder.h"
#include "antigrasp/judge/datasheet.h"
#include "antigrasp/judge/pair_split.h"
#include "antigrasp/judge/pair_tables.h"
#include "antigrasp/mesh/mesh_file.h"
#include "antigrasp/quality/object_size.h"

namespace antigrasp {
namespace {

constexpr std::array kSides = {"before", "after"};

const ResultFiles kPairFiles = {
    "objects.csv",
    {"grasps_before.csv", "grasps_after.csv", "datasheet.md", "metric.toml", "trial.toml"},
    {"before/NAME.obj", "after/NAME.obj"}};

struct Pair {
  std::array<LabelledObject, 2> sides;
  std::vector<std::string> notes;
};

class PairMaker {
 public:
  PairMaker(const PairRequest& request, const MetricOptions& metric,
            const MetricOptions& trial_metric, const PhysicsTrialOptions& trial)
      : request_(request), metric_(metric), trial_metric_(trial_metric), trial_(trial) {}

  LabelledObject Label(const InputObject& object, std::uint64_t stream, int threads) const {
    LabelledObject labelled;
    labelled.status = object.status;
    if (!object.ok()) return labelled;
    labelled.score = EvaluateGraspability(object.mesh, metric_, request_.seed, stream);
    if (labelled.score.status == GraspabilityStatus::kNotEvaluable) {
      labelled.status = Name(labelled.score.status);
      return labelled;
    }
    PhysicsTrials trials(trial_metric_, trial_, request_.seed, threads);
    labelled.trial = trials.Try(object.mesh, stream);
    labelled.summary = SummaryOf(object.name, labelled.trial, trials.protocol());
    if (!labelled.trial.tried) {
      labelled.status = labelled.summary.status;
      return labelled;
    }
    const TrialTable& table = trials.table();
    labelled.place = table.scale() * table.place();
    labelled.solid = Transformed(object.mesh, table.scale(), Eigen::Vector3d::Zero());
    if (!trials.protocol().table) return labelled;
    for (const StablePose& pose : table.poses()) {
      labelled.up.emplace_back(pose.table_from_object.row(2));
    }
    return labelled;
  }

 private:
  const PairRequest& request_;
  const MetricOptions& metric_;
  const MetricOptions& trial_metric_;
  const PhysicsTrialOptions& trial_;
};

// A pair is in the set or it is not: what one side lacks, the other says, too.
void Agree(const std::string& name, const std::string& split, Pair* pair) {
  auto& [before, after] = pair->sides;
  const bool both = before.ok() && after.ok();
  for (std::size_t i = 0; i < 2; ++i) {
    LabelledObject& side = pair->sides[i];
    const LabelledObject& other = pair->sides[1 - i];
    side.object = name;
    side.side = kSides[i];
    if (both) {
      side.split = split;
      side.mesh = side.side + "/" + FileNameOf(name) + ".obj";
    } else if (side.ok()) {
      side.status = std::string("no ") + kSides[1 - i] + ": " + other.status;
    }
  }
}

std::string TomlOf(MetricOptions metric, PhysicsTrialOptions trial, std::uint64_t seed) {
  OptionTable table;
  Bind(&table, &metric);
  Bind(&table, &trial);
  return "engine = \"mujoco " + MujocoVersion() + "\"\nprotocol = \"" + ChoiceName(trial.protocol) +
         "\"\nseed = " + std::to_string(seed) + "\n\n" + table.Dump();
}

}  // namespace

PairReport WritePairDataset(const PairRequest& request, const MetricOptions& metric,
                            const MetricOptions& trial_metric, const PhysicsTrialOptions& trial,
                            RunObserver* observer) {
  if (!(request.train + request.val <= 1.0 + 1e-9)) {
    throw InputError("shares of more than the whole", "--train and --val", "a sum of at most 1");
  }
  const auto unit = UnitToReadIn(metric);
  const ObjectSource after({request.after}, GridUnit::kOfFiles, unit);
  const ObjectSource before({request.before}, GridUnit::kOfFiles, unit);
  const std::vector<std::int64_t> before_of = PairWithOriginals(after, before);
  std::vector<std::string> names;
  for (std::int64_t i = 0; i < after.size(); ++i) names.push_back(after.name(i));
  const std::vector<std::string> splits =
      SplitOf(names, after.streams(), request.train, request.val, request.seed);
  PhysicsTrials(trial_metric, trial, request.seed, 1);  // refuses what cannot be
  const std::filesystem::path out = request.out;
  for (const char* side : kSides) {
    before.RequireNotSearched(out / side);
    after.RequireNotSearched(out / side);
  }
  ResultFolder folder(out, kPairFiles, after, request.overwrite);
  for (const char* side : kSides) MakeFolder(folder.path() / side);
  PairObjects objects;
  std::array<PairGrasps, 2> grasps;
  std::array<AtomicFile, 2> grasp_files = {AtomicFile(folder.path() / "grasps_before.csv"),
                                           AtomicFile(folder.path() / "grasps_after.csv")};
  Datasheet sheet(request, metric, trial_metric, trial);
  PairReport report;
  std::string first;
  const PairMaker maker(request, metric, trial_metric, trial);
  // Objects side by side where there are many, else the executions of one.
  const int threads = request.threads > 0 ? request.threads : HardwareThreads();
  const bool many = after.size() >= 2 * threads;
  StreamInOrder(
      after.size(), many ? threads : 1,
      [&](std::int64_t i) {
        const auto slot = static_cast<std::size_t>(i);
        Pair pair;
        const std::array<InputObject, 2> inputs = {before.Load(before_of[slot]), after.Load(i)};
        for (std::size_t k = 0; k < 2; ++k) {
          pair.sides[k] = maker.Label(inputs[k], after.stream(i), many ? 1 : threads);
          if (inputs[k].note.empty()) continue;
          pair.notes.push_back(std::string(kSides[k]) + "/" + names[slot] + ": " + inputs[k].note);
        }
        Agree(names[slot], splits[slot], &pair);
        return pair;
      },
      [&](std::int64_t, const Pair& pair) {
        for (const std::string& note : pair.notes) report.warnings.push_back(note);
        sheet.Add(pair.sides[0], pair.sides[1]);
        for (std::size_t k = 0; k < 2; ++k) {
          const LabelledObject& side = pair.sides[k];
          objects.Add(side);
          if (!side.ok()) {
            const std::string why = side.side + "/" + side.object + ": " + side.status;
            if (first.empty()) first = why;
            report.warnings.push_back("left out: " + why);
            continue;
          }
          WriteMesh(folder.path() / side.mesh, side.solid);
          grasps[k].Add(side);
          grasp_files[k].Append(grasps[k].TakeText());
        }
        folder.AddToTable(objects.TakeText());
      },
      observer->Phase("labelling pairs"));
  if (sheet.pairs() == 0) {
    throw InputError("no pair; " + first, request.after, "closed solids on both sides");
  }
  for (AtomicFile& file : grasp_files) file.Commit();
  WriteFileAtomic(folder.path() / "metric.toml", MetricToml(metric, request.seed));
  WriteFileAtomic(folder.path() / "trial.toml", TomlOf(trial_metric, trial, request.seed));
  WriteFileAtomic(folder.path() / "datasheet.md", sheet.Text());
  folder.Commit("");
  for (const std::string& sentence : sheet.EmptySplits()) report.warnings.push_back(sentence);
  report.text = request.out + ": " + sheet.Summary();
  return report;
}

}  // namespace antigrasp
