#include "antigrasp/train/episode_loop.h"

#include <spdlog/spdlog.h>
#include <torch/cuda.h>
#include <torch/types.h>

#include <chrono>
#include <cmath>
#include <optional>

#include "antigrasp/checkpoints/checkpoint.h"
#include "antigrasp/checkpoints/pretrained.h"
#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/format.h"
#include "antigrasp/train/run_output.h"
#include "antigrasp/train/scalar_log.h"
#include "antigrasp/train/selection.h"
#include "antigrasp/train/torch_threads.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;

constexpr int kRecordEvery = 10;  // updates between rows of losses.csv

// The state of section V-B's loop between two lines of it.
class EpisodeLoop {
 public:
  EpisodeLoop(const RunConfig& config, const RunFolder& folder, RunObserver* observer);
  std::vector<StageStatistics> Run();

 private:
  void Restore();
  void ScorePrior();
  void TrainEpisode();
  void TrainUpdates();
  StepReport TrainStep();
  void TrainOn(const torch::Tensor& shapes);
  torch::Tensor SampleStage();
  Selection Select(const ScoredStage& scored) const;
  void Record(const ScoredStage& scored, const Selection& selection);
  void BeginEpisode(int episode, const ScoredStage& scored, const Selection& selection);
  void Save(const fs::path& path, bool finished = false) const;
  int episode() const { return trainer_.episode(); }
  std::int64_t UpdatesSoFar() const;  // over all episodes
  void LogScalars(const LossRow& row, double updates_per_second);

  const RunConfig& config_;
  const RunFolder& folder_;
  RunObserver* observer_;
  GanTrainer trainer_;
  torch::Tensor prior_;  // network values of the prior set, float16
  EliteSelector selector_;
  torch::Tensor shapes_;            // what the current episode trains on, float16
  torch::Tensor shapes_on_device_;  // the same where the networks are
  std::vector<LossRow> losses_;
  std::optional<ScalarLog> log_;
  std::vector<StageStatistics> rows_;
  bool finished_ = false;
};

EpisodeLoop::EpisodeLoop(const RunConfig& config, const RunFolder& folder, RunObserver* observer)
    : config_(config),
      folder_(folder),
      observer_(observer),
      trainer_(MakeTrainer(config)),
      prior_(NetworkValuesOf(ReadShapeSet(folder.Prior()), config.model, folder.Prior().string())),
      selector_(config, prior_) {
  TrainOn(prior_);
}

void EpisodeLoop::TrainOn(const torch::Tensor& shapes) {
  shapes_ = shapes;
  shapes_on_device_ = shapes.to(trainer_.device());
}

std::vector<StageStatistics> EpisodeLoop::Run() {
  Restore();
  if (finished_) return rows_;
  MakeFolder(folder_.Events().parent_path());
  log_.emplace(folder_.Events(), UpdatesSoFar());
  if (rows_.empty()) ScorePrior();
  while (true) {
    TrainEpisode();             // theta: the GAN on the shapes
    const ScoredStage scored =  // x ~ p_theta, g_gamma(x, Q)
        ScoreStage(SampleStage(), config_, StageName(episode(), "scoring"), observer_);
    const Selection selection = Select(scored);  // the rare event: lowest g
    Record(scored, selection);
    if (episode() == config_.cem.episodes) {
      ExportLeastGraspable(scored, config_, folder_);
      Save(folder_.Latest(), /*finished=*/true);
      return rows_;
    }
    BeginEpisode(episode() + 1, scored, selection);
  }
}

void EpisodeLoop::Restore() {
  if (!fs::exists(folder_.Latest())) {
    if (config_.start.empty()) {
      trainer_.BeginEpisode(0, config_.cem.prior_iterations, /*restart_networks=*/true);
    } else {
      ReadNetworks(FindNetworks(config_.start),
                   [&](auto* archive) { trainer_.LoadNetworks(archive); });
      if (config_.fine_tune) {
        trainer_.BeginEpisode(0, config_.cem.prior_iterations, /*restart_networks=*/false);
      } else {
        trainer_.BeginFixedEpisode(0, trainer_.latent());
      }
    }
    return;
  }
  const Checkpoint checkpoint = ReadCheckpoint(folder_.Latest());
  ReadNetworks(folder_.Latest(), [&](auto* archive) { trainer_.Load(archive); });
  TrainOn(checkpoint.shapes);
  rows_ = StatisticsFromCsv(checkpoint.statistics, folder_.Latest().string());
  finished_ = checkpoint.finished;
  const torch::Tensor losses = checkpoint.losses.contiguous();
  if (losses.dim() != 2 || losses.size(1) != static_cast<std::int64_t>(kLossColumns.size())) {
    throw InputError("losses of another shape", folder_.Latest().string(),
                     "a checkpoint of this version");
  }
  for (std::int64_t i = 0; i < losses.size(0); ++i) {
    LossRow row;
    std::copy_n(losses[i].data_ptr<double>(), row.size(), row.begin());
    losses_.push_back(row);
  }
  if (!finished_) {
    spdlog::info("resuming {} at episode {}, update {} of {}", folder_.root.string(), episode(),
                 trainer_.step(), trainer_.iterations());
  }
}

void EpisodeLoop::ScorePrior() {
  const std::int64_t all = prior_.size(0);
  const std::int64_t scored_count =
      config_.cem.prior_scored == 0 ? all : std::min<std::int64_t>(all, config_.cem.prior_scored);
  const ScoredStage scored =
      ScoreStage(prior_.slice(0, 0, scored_count), config_, "scoring the prior set", observer_);
  rows_.push_back(Summarize(-1, scored, prior_, config_));
  if (rows_[0].graspability.count == 0) {
    throw InputError("no usable shape in the prior set", folder_.Prior().string(),
                     "shapes that remesh to one closed solid");
  }
  WriteFileAtomic(folder_.PriorScores(), StageScoresCsv(scored));
  LogStage(rows_.back(), rows_);
}

void EpisodeLoop::TrainEpisode() {
  if (trainer_.step() < trainer_.iterations()) TrainUpdates();
  MakeFolder(folder_.Episode(episode()));
  Save(folder_.EpisodeCheckpoint(episode()));
  Save(folder_.Latest());
}

void EpisodeLoop::TrainUpdates() {
  using Clock = std::chrono::steady_clock;
  const ProgressFn progress = observer_->Phase(StageName(episode(), "training"));
  Clock::time_point recorded = Clock::now();
  while (trainer_.step() < trainer_.iterations()) {
    const StepReport report = TrainStep();
    if (trainer_.step() % kRecordEvery == 0) {
      losses_.push_back(RowOf(trainer_.step(), report, trainer_.LargestSigma()));
      observer_->Detail(LossText(report));
      const std::chrono::duration<double> passed = Clock::now() - recorded;
      recorded = Clock::now();
      LogScalars(losses_.back(), kRecordEvery / passed.count());
    }
    const bool stop = observer_->StopRequested();
    if (stop || trainer_.step() % config_.cem.checkpoint_every == 0) Save(folder_.Latest());
    if (stop) throw Interrupted();
    progress(trainer_.step(), trainer_.iterations());
  }
}

StepReport EpisodeLoop::TrainStep() {
  try {
    return trainer_.Step(shapes_on_device_);
  } catch (const RuntimeFailure& failure) {
    if (!fs::exists(folder_.Latest())) throw;
    throw RuntimeFailure(std::string(failure.what()) + "; the last good state is in " +
                         folder_.Latest().string());
  }
}

torch::Tensor EpisodeLoop::SampleStage() {
  constexpr std::int64_t kChunk = 64;
  const ProgressFn progress = observer_->Phase(StageName(episode(), "sampling"));
  const std::int64_t count = config_.cem.samples;
  std::vector<torch::Tensor> chunks;
  for (std::int64_t first = 0; first < count; first += kChunk) {
    chunks.push_back(
        trainer_.Sample(StageSeed(config_, episode()), first, std::min(kChunk, count - first)));
    progress(std::min(first + kChunk, count), count);
  }
  return torch::cat(chunks);
}

Selection EpisodeLoop::Select(const ScoredStage& scored) const {
  Selection selection = selector_.Select(scored, episode());
  const std::size_t usable = selection.elites.size();
  if (usable == 0) {
    throw RuntimeFailure("episode " + std::to_string(episode()) + ": none of " +
                         std::to_string(config_.cem.samples) +
                         " samples is a usable object; the networks of that episode are in " +
                         folder_.Latest().string());
  }
  if (static_cast<std::int64_t>(usable) < config_.cem.keep && config_.cem.variant == "paper") {
    spdlog::warn("only {} of {} samples are usable: fewer elites than cem.keep = {}", usable,
                 config_.cem.samples, config_.cem.keep);
  }
  return selection;
}

void EpisodeLoop::Record(const ScoredStage& scored, const Selection& selection) {
  StageStatistics row = Summarize(episode(), scored, prior_, config_);
  for (const std::int64_t i : selection.elites) {
    const double value = scored.graspabilities[static_cast<std::size_t>(i)];
    row.elite_threshold = std::fmax(row.elite_threshold, value);
  }
  rows_.push_back(row);
  WriteFileAtomic(folder_.Episode(episode()) / "scores.csv", StageScoresCsv(scored));
  WriteFileAtomic(folder_.Episode(episode()) / "losses.csv", LossesCsv(losses_));
  WriteFileAtomic(folder_.Statistics(), StatisticsToCsv(rows_));
  WriteElites(folder_.Episode(episode()) / "elites.h5", scored, selection.elites, episode(),
              config_);
  WriteSampleSheet(folder_.Episode(episode()) / "samples.png", scored, config_);
  log_->Add(UpdatesSoFar(), StageScalars(row, rows_));
  LogStage(row, rows_);
  WarnIfCollapsed(row, rows_);
}

void EpisodeLoop::BeginEpisode(int episode, const ScoredStage& scored, const Selection& selection) {
  losses_.clear();
  if (config_.cem.mode == "latent") {
    const torch::Tensor z =
        trainer_.Latents(StageSeed(config_, trainer_.episode()), 0, config_.cem.samples)
            .index_select(0, torch::tensor(selection.elites, torch::kLong));
    trainer_.BeginFixedEpisode(episode,
                               AroundElites(z, config_.cem.step, config_.cem.prior_fraction));
  } else {
    TrainOn(selector_.TrainingSet(scored, selection));
    trainer_.BeginEpisode(episode, config_.cem.iterations, config_.cem.restart);
  }
  Save(folder_.Latest());
}

std::int64_t EpisodeLoop::UpdatesSoFar() const {
  const bool trained = config_.start.empty() || config_.fine_tune;
  const std::int64_t first = trained ? config_.cem.prior_iterations : 0;
  const std::int64_t later = config_.cem.mode == "latent" ? 0 : config_.cem.iterations;
  return (episode() == 0 ? 0 : first + (episode() - 1LL) * later) + trainer_.step();
}

void EpisodeLoop::LogScalars(const LossRow& row, double updates_per_second) {
  std::vector<std::pair<std::string, double>> scalars = {
      {"training/updates_per_second", updates_per_second}};
  for (std::size_t i = 1; i < row.size(); ++i) {
    scalars.emplace_back("training/" + std::string(kLossColumns[i]), row[i]);
  }
  log_->Add(UpdatesSoFar(), scalars);
}

void EpisodeLoop::Save(const fs::path& path, bool finished) const {
  Checkpoint checkpoint;
  checkpoint.config = ToToml(config_);
  checkpoint.statistics = StatisticsToCsv(rows_);
  checkpoint.shapes = shapes_;
  checkpoint.finished = finished;
  const auto columns = static_cast<std::int64_t>(kLossColumns.size());
  checkpoint.losses =
      torch::zeros({static_cast<std::int64_t>(losses_.size()), columns}, torch::kDouble);
  for (std::size_t i = 0; i < losses_.size(); ++i) {
    double* row = checkpoint.losses[static_cast<std::int64_t>(i)].data_ptr<double>();
    std::copy(losses_[i].begin(), losses_[i].end(), row);
  }
  WriteCheckpoint(path, checkpoint, [&](auto* archive) { trainer_.Save(archive); });
}

}  // namespace

std::vector<StageStatistics> RunEpisodes(const RunConfig& config, const RunFolder& folder,
                                         RunObserver* observer) {
  return EpisodeLoop(config, folder, observer).Run();
}

GanTrainer MakeTrainer(const RunConfig& config) {
  const int threads = config.torch_threads > 0 ? config.torch_threads : config.threads;
  SetTorchThreads(threads > 0 ? threads : HardwareThreads());
  const std::string expected = "a device this LibTorch offers: cpu" +
                               std::string(torch::cuda::is_available() ? ", cuda" : " only");
  try {
    const torch::Device device(config.device);
    if (device.is_cuda() && !torch::cuda::is_available()) {
      throw InputError("run.device = " + config.device, "--device", expected);
    }
    // Every step convolves the same shapes: trying cuDNN's algorithms once pays.
    if (device.is_cuda()) at::globalContext().setBenchmarkCuDNN(true);
    return GanTrainer(config.model, config.gan, config.seed, device);
  } catch (const c10::Error&) {
    throw InputError("run.device = " + config.device, "--device", expected);
  }
}

}  // namespace antigrasp
