#include "antigrasp/train/run_record.h"

#include <charconv>
#include <cmath>
#include <map>
#include <string_view>

#include "antigrasp/checkpoints/checkpoint.h"
#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/train/sample_name.h"
#include "antigrasp/train/statistics_table.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;

// The table of a stage, in which row i is sample i.
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

// The episodes that have a folder.
std::vector<int> EpisodesIn(const RunFolder& run) {
  constexpr std::string_view kPrefix = "episode_";
  std::vector<int> episodes;
  for (const fs::path& folder : run.Episodes()) {
    const std::string name = folder.filename().string();
    int episode = -1;
    std::from_chars(name.data() + kPrefix.size(), name.data() + name.size(), episode);
    if (folder == run.Episode(episode)) episodes.push_back(episode);
  }
  return episodes;
}

}  // namespace

std::vector<double> GraspabilitiesOf(const StageRecord* stage) {
  std::vector<double> values;
  if (stage == nullptr || !stage->scores) return values;
  for (const ScoreRow& row : *stage->scores) {
    values.push_back(row.score ? row.score->graspability : std::nan(""));
  }
  return values;
}

const StageRecord* RunRecord::Find(int episode) const {
  for (const StageRecord& stage : stages) {
    if (stage.episode == episode) return &stage;
  }
  return nullptr;
}

RunRecord ReadRun(const fs::path& folder) {
  const RunFolder run{folder};
  RunRecord record;
  record.folder = run;
  record.provenance = ReadProvenance(run);
  if (run.HoldsARun()) {
    record.config_toml = ReadFile(run.Config());
    record.config = NetworksFromToml(record.config_toml, run.Config().string());
  }
  std::map<int, StageRecord> stages;
  record.has_statistics = fs::exists(run.Statistics());
  if (record.has_statistics) {
    for (const StageStatistics& row : ReadStatistics(run.Statistics())) {
      stages[row.stage].row = row;
    }
  }
  for (const int episode : EpisodesIn(run)) stages[episode];
  if (fs::exists(run.PriorScores())) stages[-1];
  for (auto& [episode, stage] : stages) {
    stage.episode = episode;
    if (fs::exists(run.Scores(episode))) stage.scores = ReadStageScores(run.Scores(episode));
    if (episode >= 0 && fs::exists(run.Losses(episode))) {
      stage.losses = ReadLosses(run.Losses(episode));
    }
    record.stages.push_back(std::move(stage));
  }
  return record;
}

std::vector<StageStatistics> LatestStatistics(const RunFolder& run) {
  if (fs::exists(run.Latest())) {
    return StatisticsFromCsv(ReadCheckpoint(run.Latest()).statistics, run.Latest().string());
  }
  if (!fs::exists(run.Statistics())) return {};
  return ReadStatistics(run.Statistics());
}

}  // namespace antigrasp
