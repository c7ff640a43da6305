#include "antigrasp/train/episode_loop.h"

#include <spdlog/spdlog.h>
#include <torch/types.h>

#include <chrono>
#include <cmath>
#include <optional>
#include <utility>

#include "antigrasp/checkpoints/checkpoint.h"
#include "antigrasp/checkpoints/pretrained.h"
#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/train/cem_loop.h"
#include "antigrasp/train/forecast.h"
#include "antigrasp/train/loss_table.h"
#include "antigrasp/train/run_output.h"
#include "antigrasp/train/scalar_log.h"
#include "antigrasp/train/statistics_table.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr int kRecordEvery = 10;  // updates between rows of losses.csv

// A CemLoop that keeps its state and what it found in a folder.
class FolderLoop {
 public:
  FolderLoop(const RunConfig& config, const RunFolder& folder, ShapeModel* model,
             const torch::Tensor& prior, StageScorer scorer, RunObserver* observer,
             EliteRefiner refine);
  std::vector<StageStatistics> Run(std::function<bool()> first_trained);

 private:
  void Restore();
  void Resume();
  void ScorePrior();
  void TrainEpisode();
  void FirstIsTrained();
  void TrainUpdates();
  void TrainStep();
  Episode FinishEpisode();
  void TimeStage(double seconds);
  void Record(const Episode& episode);
  void BeginNext(const Episode& episode);
  void Save(const fs::path& path, bool finished = false) const;
  int episode() const { return model_->episode(); }
  void LogScalars(const LossRow& row, double updates_per_second);

  const RunConfig& config_;
  RunConfig ahead_;  // the same, of what is left to do here
  const RunFolder& folder_;
  ShapeModel* model_;
  RunObserver* observer_;
  CemLoop loop_;
  LossTable losses_;                     // of this episode
  std::function<bool()> first_trained_;  // nullptr: nobody asked, or it was told
  std::optional<ScalarLog> log_;
  UpdateTimer timer_;
  Pace pace_;          // as far as this process knows it
  bool told_ = false;  // how long the run will take
  bool finished_ = false;
};

FolderLoop::FolderLoop(const RunConfig& config, const RunFolder& folder, ShapeModel* model,
                       const torch::Tensor& prior, StageScorer scorer, RunObserver* observer,
                       EliteRefiner refine)
    : config_(config),
      ahead_(config),
      folder_(folder),
      model_(model),
      observer_(observer),
      loop_(config, model, prior, std::move(scorer), observer, std::move(refine)),
      losses_{model->ScalarNames(), {}} {}

std::vector<StageStatistics> FolderLoop::Run(std::function<bool()> first_trained) {
  first_trained_ = std::move(first_trained);
  Restore();
  if (finished_) return loop_.rows();
  MakeFolder(folder_.Events().parent_path());
  log_.emplace(folder_.Events(), loop_.UpdatesSoFar());
  if (loop_.rows().empty()) ScorePrior();
  while (true) {
    TrainEpisode();
    const auto start = Clock::now();
    const Episode finished = FinishEpisode();
    Record(finished);
    TimeStage(std::chrono::duration<double>(Clock::now() - start).count());
    if (loop_.last()) {
      ExportLeastGraspable(finished.scored, config_, folder_);
      Save(folder_.Latest(), /*finished=*/true);
      return loop_.rows();
    }
    BeginNext(finished);
  }
}

void FolderLoop::Restore() {
  if (fs::exists(folder_.Latest())) {
    Resume();
    return;
  }
  if (!config_.start.empty()) {
    const fs::path networks = FindNetworks(config_.start);
    model_->LoadNetworks(ReadCheckpoint(networks).networks, networks.string());
  }
  loop_.Begin();
}

void FolderLoop::Resume() {
  const std::string path = folder_.Latest().string();
  const Checkpoint checkpoint = ReadCheckpoint(folder_.Latest());
  model_->Load(checkpoint.networks, path);
  loop_.GoOn(checkpoint.shapes, StatisticsFromCsv(checkpoint.statistics, path));
  finished_ = checkpoint.finished;
  losses_.rows = LossRows(checkpoint.losses, losses_.scalars.size(), path);
  if (!finished_) {
    spdlog::info("resuming {} at episode {}, update {} of {}", folder_.root.string(), episode(),
                 model_->step(), model_->iterations());
  }
}

void FolderLoop::ScorePrior() {
  const ScoredStage scored = loop_.ScorePrior(folder_.Prior().string());
  WriteFileAtomic(folder_.PriorScores(), StageScoresCsv(-1, scored));
  LogStage(loop_.rows().back(), loop_.rows());
}

void FolderLoop::TrainEpisode() {
  if (episode() > 0) FirstIsTrained();
  if (!loop_.trained()) TrainUpdates();
  MakeFolder(folder_.Episode(episode()));
  Save(folder_.EpisodeCheckpoint(episode()));
  Save(folder_.Latest());
  FirstIsTrained();
}

void FolderLoop::FirstIsTrained() {
  const auto tell = std::exchange(first_trained_, nullptr);
  if (tell && tell()) ahead_.cem.control = false;
}

void FolderLoop::TrainUpdates() {
  const ProgressFn progress = observer_->Phase(StageName(episode(), "training"));
  Clock::time_point recorded = Clock::now();
  while (!loop_.trained()) {
    TrainStep();
    if (timer_.Tick()) {
      pace_.update = timer_.seconds();
      observer_->Note(TrainingForecast(ahead_, pace_.update));
    }
    if (model_->step() % kRecordEvery == 0) {
      losses_.rows.push_back(RowOf(model_->step(), model_->Scalars()));
      observer_->Detail(model_->ScalarText());
      const std::chrono::duration<double> passed = Clock::now() - recorded;
      recorded = Clock::now();
      LogScalars(losses_.rows.back(), kRecordEvery / passed.count());
    }
    const bool stop = observer_->StopRequested();
    if (stop || model_->step() % config_.cem.checkpoint_every == 0) Save(folder_.Latest());
    if (stop) throw Interrupted();
    progress(model_->step(), model_->iterations());
  }
}

void FolderLoop::TrainStep() {
  try {
    loop_.TrainStep();
  } catch (const RuntimeFailure& failure) {
    if (!fs::exists(folder_.Latest())) throw;
    throw RuntimeFailure(std::string(failure.what()) + "; the last good state is in " +
                         folder_.Latest().string());
  }
}

Episode FolderLoop::FinishEpisode() {
  try {
    return loop_.Finish();
  } catch (const RuntimeFailure& failure) {
    throw RuntimeFailure(std::string(failure.what()) + "; the networks of that episode are in " +
                         folder_.Latest().string());
  }
}

// Says what is left as soon as that is known.
void FolderLoop::TimeStage(double seconds) {
  pace_.stage = seconds;
  if (told_ || loop_.last() || std::isnan(SecondsLeft(ahead_, pace_, episode() + 1))) return;
  told_ = true;
  observer_->Note(RunForecast(ahead_, pace_, episode() + 1));
}

void FolderLoop::Record(const Episode& finished) {
  const std::vector<StageStatistics>& rows = loop_.rows();
  const std::vector<std::int64_t>& elites = finished.selection.elites;
  const bool all_kept = config_.cem.keep == config_.cem.samples;
  if (std::ssize(elites) < config_.cem.keep && !all_kept &&
      config_.cem.variant != EliteRule::kStratified) {
    spdlog::warn("only {} of {} samples are usable: fewer elites than cem.keep = {}", elites.size(),
                 config_.cem.samples, config_.cem.keep);
  }
  WriteFileAtomic(folder_.Scores(episode()), StageScoresCsv(episode(), finished.scored));
  WriteFileAtomic(folder_.Losses(episode()), LossesCsv(losses_));
  WriteFileAtomic(folder_.Statistics(), StatisticsToCsv(rows));
  WriteElites(folder_.Elites(episode()), finished.elites, elites, episode(), config_);
  WriteSampleSheet(folder_.Episode(episode()) / "samples.png", finished.scored, config_);
  log_->Add(loop_.UpdatesSoFar(), StageScalars(finished.row, rows));
  LogStage(finished.row, rows);
  WarnIfCollapsed(finished.row, rows);
}

void FolderLoop::BeginNext(const Episode& finished) {
  losses_.rows.clear();
  loop_.Next(finished);
  Save(folder_.Latest());
}

void FolderLoop::LogScalars(const LossRow& row, double updates_per_second) {
  std::vector<std::pair<std::string, double>> scalars = {
      {"training/updates_per_second", updates_per_second}};
  for (std::size_t i = 0; i < losses_.scalars.size(); ++i) {
    scalars.emplace_back("training/" + losses_.scalars[i], row[i + 1]);
  }
  log_->Add(loop_.UpdatesSoFar(), scalars);
}

void FolderLoop::Save(const fs::path& path, bool finished) const {
  Checkpoint checkpoint;
  checkpoint.config = ToToml(config_);
  checkpoint.statistics = StatisticsToCsv(loop_.rows());
  checkpoint.shapes = loop_.shapes();
  checkpoint.finished = finished;
  checkpoint.losses = LossTensor(losses_);
  checkpoint.networks = model_->State();
  WriteCheckpoint(path, checkpoint);
}

}  // namespace

std::vector<StageStatistics> RunEpisodes(const RunConfig& config, const RunFolder& folder,
                                         ShapeModel* model, const torch::Tensor& prior,
                                         StageScorer scorer, RunObserver* observer,
                                         EliteRefiner refine,
                                         const std::function<bool()>& first_trained) {
  return FolderLoop(config, folder, model, prior, std::move(scorer), observer, std::move(refine))
      .Run(first_trained);
}

}  // namespace antigrasp
