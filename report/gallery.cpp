#include "antigrasp/report/gallery.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "antigrasp/core/rng.h"
#include "antigrasp/datasets/shape_set.h"
#include "antigrasp/report/report_settings.h"
#include "antigrasp/train/elites.h"
#include "antigrasp/train/sample_name.h"
#include "antigrasp/train/stage_samples.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;

std::vector<double> ValuesWithGaps(const std::vector<ScoreRow>& rows) {
  std::vector<double> values;
  for (const ScoreRow& row : rows) {
    values.push_back(row.score ? row.score->graspability : std::nan(""));
  }
  return values;
}

// The samples kept for the next episode, by the names in elites.h5; nullopt without the file.
std::optional<std::set<std::int64_t>> ElitesOf(const RunFolder& run, int stage) {
  const fs::path path = run.Elites(stage);
  if (stage < 0 || !fs::exists(path)) return std::nullopt;
  std::set<std::int64_t> elites;
  for (const std::string& name : ReadShapeNames(path)) {
    if (const auto index = SampleIndex(name)) elites.insert(*index);
  }
  return elites;
}

class Gallery {
 public:
  Gallery(const RunRecord& run, const RunConfig& config, const ShapeModelMaker& make,
          RunObserver* observer, Report* report)
      : run_(run),
        folder_(run.folder),
        config_(config),
        make_(make),
        observer_(observer),
        report_(report) {}

  void Add(const ReportStage& stage, int per_stage) {
    const int episode = stage.episode;
    const fs::path source = episode < 0 ? folder_.Prior() : folder_.EpisodeCheckpoint(episode);
    if (!fs::exists(source)) {
      report_->missing.push_back(stage.label + " has no " + source.filename().string() +
                                 ": its objects cannot be shown.");
      return;
    }
    const StageRecord* const record = run_.Find(episode);
    const std::vector<ScoreRow> rows =
        record != nullptr && record->scores ? *record->scores : std::vector<ScoreRow>();
    std::vector<std::string> prior_names;
    if (episode < 0) prior_names = ReadShapeNames(source);
    const int samples = episode < 0 ? static_cast<int>(prior_names.size()) : config_.cem.samples;
    const GalleryChoice choice = ChooseSamples(rows, samples, episode, per_stage, config_.seed);
    ScoredStage made;
    try {
      made = StageSamples(folder_, config_, episode, choice.indices, observer_, make_);
    } catch (const OtherShapeModel& other) {
      report_->missing.push_back(stage.label + ": " + other.what() +
                                 ": its objects cannot be shown.");
      return;
    }
    report_->groups.push_back({stage.id, stage.label, choice.note});
    const auto elites = ElitesOf(folder_, episode);
    int differ = 0;
    for (std::size_t j = 0; j < made.objects.size(); ++j) {
      const auto index = static_cast<std::size_t>(choice.indices[j]);
      ReportObject object = ObjectOf(made.objects[j], made.scores[j]);
      object.name = episode < 0 ? prior_names[index] : SampleName(choice.indices[j]);
      if (elites) object.elite = elites->contains(choice.indices[j]);
      AddNumbers(choice, j, rows, &object);
      const bool metric = config_.cem.score == kEpsilonScore;  // the page shows nobody else's
      if (metric && index < rows.size() && !SameScore(rows[index], object)) ++differ;
      report_->objects.push_back(std::move(object));
    }
    if (differ > 0) {
      report_->missing.push_back(
          stage.label + ": " + std::to_string(differ) + " of " +
          std::to_string(made.objects.size()) +
          " objects score otherwise than in the run's table; it was made on another device or by "
          "another version.");
    }
  }

 private:
  ReportObject ObjectOf(const RemeshResult& sample, const Graspability& score) const {
    ReportObject object;
    object.group = report_->groups.size() - 1;
    object.status = std::string(sample.ok() ? Name(score.status) : Name(sample.status));
    object.shape = ShapeOf(sample.mesh, score);
    return object;
  }

  static void AddNumbers(const GalleryChoice& choice, std::size_t j,
                         const std::vector<ScoreRow>& rows, ReportObject* object) {
    object->numbers.emplace_back("sample", std::to_string(choice.indices[j]));
    object->numbers.emplace_back("chosen", choice.least[j] ? "least graspable" : "at random");
    object->random = !choice.least[j];
    if (!object->shape.score || rows.empty()) return;
    const double own = object->shape.score->graspability;
    std::int64_t below = 0, usable = 0;
    for (const ScoreRow& row : rows) {
      if (!row.score) continue;
      ++usable;
      below += row.score->graspability < own ? 1 : 0;
    }
    object->numbers.emplace_back("rank, least graspable first",
                                 std::to_string(below + 1) + " of " + std::to_string(usable));
  }

  static bool SameScore(const ScoreRow& row, const ReportObject& object) {
    if (row.score.has_value() != object.shape.score.has_value()) return false;
    return !row.score || row.score->graspability == object.shape.score->graspability;
  }

  const RunRecord& run_;
  const RunFolder& folder_;
  const RunConfig& config_;
  const ShapeModelMaker& make_;
  RunObserver* observer_;
  Report* report_;
};

}  // namespace

GalleryChoice ChooseSamples(const std::vector<ScoreRow>& scores, int samples, int stage,
                            int per_stage, std::uint64_t seed) {
  std::vector<double> values = ValuesWithGaps(scores);
  if (scores.empty()) values.assign(static_cast<std::size_t>(std::max(samples, 0)), 0.0);
  const auto usable = static_cast<std::int64_t>(
      std::count_if(values.begin(), values.end(), [](double v) { return !std::isnan(v); }));
  const std::int64_t wanted = std::min<std::int64_t>(per_stage, usable);
  const std::int64_t least = scores.empty() ? 0 : (wanted + 1) / 2;
  RngStream rng(seed, "report", static_cast<std::uint64_t>(stage + 1));
  GalleryChoice choice;
  choice.indices = LeastGraspable(RandomOrder(values, &rng), wanted - least);
  for (const std::int64_t i : choice.indices) values[static_cast<std::size_t>(i)] = std::nan("");
  const std::vector<std::int64_t> worst = LeastGraspable(values, least);
  choice.indices.insert(choice.indices.end(), worst.begin(), worst.end());
  std::sort(choice.indices.begin(), choice.indices.end());
  for (const std::int64_t i : choice.indices) {
    choice.least.push_back(std::binary_search(worst.begin(), worst.end(), i));
  }
  choice.note = std::to_string(wanted - least) + " drawn at random of " +
                std::to_string(scores.empty() ? samples : usable) + " " +
                (scores.empty() ? "samples" : "usable objects");
  if (least > 0) {
    choice.note += " and the " + std::to_string(least) + " least graspable of the others";
  }
  return choice;
}

void AddGallery(const RunRecord& run, const RunConfig& config, int per_stage,
                const ShapeModelMaker& make, RunObserver* observer, Report* report) {
  if (per_stage == 0) return;
  Gallery gallery(run, config, make, observer, report);
  for (const ReportStage& stage : report->run->stages) {
    if (!stage.control) gallery.Add(stage, per_stage);
  }
}

}  // namespace antigrasp
