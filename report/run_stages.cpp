#include "antigrasp/report/run_stages.h"

#include <charconv>
#include <cmath>
#include <limits>
#include <set>
#include <string_view>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/csv_reader.h"
#include "antigrasp/core/error.h"
#include "antigrasp/train/run_output.h"
#include "antigrasp/train/sample_name.h"
#include "antigrasp/train/statistics.h"

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

// A stage's table: row i is sample i.
std::vector<ScoreRow> ReadStageScores(const fs::path& path) {
  std::vector<ScoreRow> rows = ReadScores(path);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (SampleIndex(rows[i].object) == static_cast<std::int64_t>(i)) continue;
    throw InputError("object = \"" + rows[i].object + "\"",
                     path.string() + ", row " + std::to_string(i + 1),
                     SampleName(static_cast<std::int64_t>(i)));
  }
  return rows;
}

ReportLosses ReadLosses(const fs::path& path, int episode, bool control) {
  ReportLosses losses{episode, control, {}};
  CsvReader csv(path);
  csv.RequiredColumn("step");
  for (const std::string& name : csv.names()) {  // beside it, whatever the model named
    losses.columns.emplace_back(name, std::vector<double>());
  }
  while (csv.Next()) {
    for (std::size_t c = 0; c < losses.columns.size(); ++c) {
      losses.columns[c].second.push_back(csv.NumberOrGap(c));
    }
  }
  return losses;
}

// The stages of a run or of its control, one after the other.
class StageReader {
 public:
  StageReader(const RunFolder& run, bool control, RunTables* tables,
              std::vector<std::string>* missing)
      : run_(run), control_(control), tables_(tables), missing_(missing) {
    if (fs::exists(run.Statistics())) {
      rows_ = StatisticsFromCsv(ReadFile(run.Statistics()), run.Statistics().string());
    } else {
      Miss("statistics.csv is not there: no episode was finished.");
    }
  }

  // Those that should be there, that statistics.csv tells of and that have a folder.
  std::set<int> Episodes(const RunConfig* config) const {
    std::set<int> episodes;
    for (int e = 0; config != nullptr && e <= config->cem.episodes; ++e) episodes.insert(e);
    for (const StageStatistics& row : rows_) episodes.insert(row.stage);
    for (const auto& entry : fs::directory_iterator(run_.root)) {
      constexpr std::string_view kPrefix = "episode_";
      const std::string name = entry.path().filename().string();
      int episode = -1;
      if (!name.starts_with(kPrefix)) continue;
      std::from_chars(name.data() + kPrefix.size(), name.data() + name.size(), episode);
      if (entry.path() == run_.Episode(episode)) episodes.insert(episode);
    }
    return episodes;
  }

  void Read(int episode) {
    const fs::path scores = episode < 0 ? run_.PriorScores() : run_.Episode(episode) / "scores.csv";
    const StageStatistics* row = FindStage(rows_, episode);
    const bool scored = fs::exists(scores);
    if (!scored && row == nullptr && (episode < 0 || !fs::exists(run_.Episode(episode)))) {
      Miss(EpisodeText(episode, control_) + " is not there.");
      return;
    }
    ReportStage stage = NewStage(episode, control_);
    if (scored) {
      std::vector<ScoreRow> of_stage = ReadStageScores(scores);
      stage.scores = Values(of_stage);
      FillFromScores(of_stage, &stage);
      if (row != nullptr && row->samples != stage.samples) {
        Miss(EpisodeText(episode, control_) + " has " + std::to_string(stage.samples) + " of " +
             std::to_string(row->samples) + " rows in " + scores.filename().string() + ".");
      }
      if (!control_) tables_->scores[episode] = std::move(of_stage);
    } else {
      Miss(EpisodeText(episode, control_) + " has no " + scores.filename().string() +
           (row == nullptr ? ": it was not scored." : "."));
    }
    if (row != nullptr) {
      stage.statuses.clear();
      FillFromStatistics(*row, &stage);
    }
    tables_->run.stages.push_back(std::move(stage));
    if (episode >= 0) ReadLossesOf(episode);
  }

 private:
  void ReadLossesOf(int episode) {
    const fs::path path = run_.Episode(episode) / "losses.csv";
    if (!fs::exists(path)) {
      Miss(EpisodeText(episode, control_) + " has no losses.csv.");
      return;
    }
    ReportLosses losses = ReadLosses(path, episode, control_);
    // An episode that trains nothing has a table without rows.
    if (!losses.columns[0].second.empty()) tables_->run.losses.push_back(std::move(losses));
  }

  void Miss(const std::string& sentence) {
    missing_->push_back(control_ && !sentence.starts_with("control") ? "control: " + sentence
                                                                     : sentence);
  }

  const RunFolder& run_;
  bool control_;
  RunTables* tables_;
  std::vector<std::string>* missing_;
  std::vector<StageStatistics> rows_;
};

}  // namespace

RunTables ReadRunTables(const RunFolder& run, const RunConfig* config,
                        std::vector<std::string>* missing) {
  RunTables tables;
  StageReader reader(run, /*control=*/false, &tables, missing);
  reader.Read(-1);
  for (const int episode : reader.Episodes(config)) {
    if (episode >= 0) reader.Read(episode);
  }
  const RunFolder control{run.Control()};
  if (fs::exists(control.root)) {
    StageReader of_control(control, /*control=*/true, &tables, missing);
    for (const int episode : of_control.Episodes(config)) {
      if (episode >= 1) of_control.Read(episode);
    }
  } else if (config != nullptr && config->cem.control) {
    missing->push_back("the control run is not there.");
  }
  return tables;
}

}  // namespace antigrasp
