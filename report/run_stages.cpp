#include "antigrasp/report/run_stages.h"

#include <limits>
#include <map>
#include <set>

#include "antigrasp/train/run_output.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::string EpisodeText(int episode, bool control) {
  return (control && episode >= 0 ? "control, " : "") + StageName(episode);
}

ReportStage NewStage(int episode, bool control) {
  ReportStage stage;
  stage.id = episode < 0 ? "prior" : (control ? "control-" : "episode-") + std::to_string(episode);
  stage.label = EpisodeText(episode, control);
  stage.episode = episode;
  stage.control = control;
  stage.graspability = {kNaN, kNaN, 0};
  stage.elite_threshold = stage.coverage = stage.nna = stage.duplicates = stage.diversity = kNaN;
  stage.flat = stage.crease = kNaN;
  return stage;
}

void FillFromStatistics(const StageStatistics& row, ReportStage* stage) {
  stage->samples = row.samples;
  for (int i = 0; i < kNumRemeshStatuses; ++i) {
    const int count = row.by_status[static_cast<std::size_t>(i)];
    if (count == 0) continue;
    stage->statuses.emplace_back(Name(static_cast<RemeshStatus>(i)), count);
  }
  stage->graspability = row.graspability;
  stage->elite_threshold = row.elite_threshold;
  stage->coverage = row.coverage;
  stage->nna = row.nna;
  stage->duplicates = row.duplicates;
  stage->diversity = row.diversity;
  stage->flat = row.flat;
  stage->crease = row.crease;
}

std::vector<double> Values(const std::vector<ScoreRow>& rows) {
  std::vector<double> values;
  for (const ScoreRow& row : rows) {
    if (row.score) values.push_back(row.score->graspability);
  }
  return values;
}

void FillFromScores(const std::vector<ScoreRow>& rows, ReportStage* stage) {
  stage->samples = static_cast<int>(rows.size());
  std::map<std::string, int> counts;
  for (const ScoreRow& row : rows) ++counts[row.score ? "ok" : row.status];
  stage->statuses.assign(counts.begin(), counts.end());
  stage->graspability = MeanWithInterval(Values(rows));
}

// By columns, "step" first, whatever the model named behind it.
ReportLosses LossesOf(const LossTable& table, int episode, bool control) {
  ReportLosses losses{episode, control, {{"step", {}}}};
  for (const std::string& name : table.scalars) losses.columns.push_back({name, {}});
  for (const LossRow& row : table.rows) {
    for (std::size_t c = 0; c < row.size(); ++c) losses.columns[c].second.push_back(row[c]);
  }
  return losses;
}

// The stages of a run or of its control, one after the other.
class StageTeller {
 public:
  StageTeller(const RunRecord& record, bool control, ReportRun* run,
              std::vector<std::string>* missing)
      : record_(record), control_(control), run_(run), missing_(missing) {
    if (!record.has_statistics) Miss("statistics.csv is not there: no episode was finished.");
  }

  // Those that should be there and those of which anything is.
  std::set<int> Episodes(const std::optional<RunConfig>& config) const {
    std::set<int> episodes;
    for (int e = 0; config && e <= config->cem.episodes; ++e) episodes.insert(e);
    for (const StageRecord& stage : record_.stages) episodes.insert(stage.episode);
    return episodes;
  }

  void Tell(int episode) {
    const StageRecord* const found = record_.Find(episode);
    if (found == nullptr) {
      Miss(EpisodeText(episode, control_) + " is not there.");
      return;
    }
    const std::string table = record_.folder.Scores(episode).filename().string();
    ReportStage stage = NewStage(episode, control_);
    if (found->scores) {
      stage.scores = Values(*found->scores);
      FillFromScores(*found->scores, &stage);
      if (found->row && found->row->samples != stage.samples) {
        Miss(EpisodeText(episode, control_) + " has " + std::to_string(stage.samples) + " of " +
             std::to_string(found->row->samples) + " rows in " + table + ".");
      }
    } else {
      Miss(EpisodeText(episode, control_) + " has no " + table +
           (found->row ? "." : ": it was not scored."));
    }
    if (found->row) {
      stage.statuses.clear();
      FillFromStatistics(*found->row, &stage);
    }
    run_->stages.push_back(std::move(stage));
    if (episode >= 0) TellLosses(*found);
  }

 private:
  void TellLosses(const StageRecord& stage) {
    if (!stage.losses) {
      Miss(EpisodeText(stage.episode, control_) + " has no losses.csv.");
    } else if (!stage.losses->rows.empty()) {  // an episode that trains nothing has none
      run_->losses.push_back(LossesOf(*stage.losses, stage.episode, control_));
    }
  }

  void Miss(const std::string& sentence) {
    missing_->push_back(control_ && !sentence.starts_with("control") ? "control: " + sentence
                                                                     : sentence);
  }

  const RunRecord& record_;
  bool control_;
  ReportRun* run_;
  std::vector<std::string>* missing_;
};

}  // namespace

ReportRun StagesOf(const RunRecord& run, std::vector<std::string>* missing) {
  ReportRun stages;
  StageTeller teller(run, /*control=*/false, &stages, missing);
  teller.Tell(-1);
  for (const int episode : teller.Episodes(run.config)) {
    if (episode >= 0) teller.Tell(episode);
  }
  if (std::filesystem::exists(run.folder.Control())) {
    const RunRecord control = ReadRun(run.folder.Control());
    StageTeller of_control(control, /*control=*/true, &stages, missing);
    for (const int episode : of_control.Episodes(run.config)) {
      if (episode >= 1) of_control.Tell(episode);
    }
  } else if (run.config && run.config->cem.control) {
    missing->push_back("the control run is not there.");
  }
  return stages;
}

}  // namespace antigrasp
