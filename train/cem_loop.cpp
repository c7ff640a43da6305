#include "antigrasp/train/cem_loop.h"

#include <torch/types.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "antigrasp/core/error.h"
#include "antigrasp/train/elite_niches.h"
#include "antigrasp/train/refined_latents.h"
#include "antigrasp/train/run_output.h"

namespace antigrasp {
namespace {

constexpr const char* kRefining = "refining the elites";

// By niche, what lies beyond this share of the limit of cem.spread has no score, so that what is
// drawn around elites, all of which goes on, stays within the limit too: a sample that is left out
// leaves its place to a second one of another elite, and two of one elite are near-duplicates.
constexpr double kWithin = 0.97;

}  // namespace

StageScorer GraspabilityScorer(const RunConfig& config, RunObserver* observer) {
  return [&config, observer](const torch::Tensor& values, const std::string& name) {
    return ScoreStage(values, config, name, observer);
  };
}

StageScorer JudgedScorer(const RunConfig& config, Judge* judge, RunObserver* observer) {
  return [&config, judge, observer](const torch::Tensor& values, const std::string& name) {
    return ScoreStageBy(judge, values, config, PhaseOf(observer, name));
  };
}

CemLoop::CemLoop(const RunConfig& config, ShapeModel* model, torch::Tensor prior,
                 StageScorer scorer, RunObserver* observer, EliteRefiner refine)
    : config_(config),
      model_(model),
      prior_(std::move(prior)),
      scorer_(std::move(scorer)),
      observer_(observer),
      selector_(config, prior_, std::move(refine)) {
  TrainOn(prior_);
}

void CemLoop::TrainOn(const torch::Tensor& shapes) {
  shapes_ = shapes;
  shapes_on_device_ = shapes.to(model_->device());
}

void CemLoop::Begin() {
  if (config_.start.empty() || config_.fine_tune) {
    model_->BeginEpisode(0, config_.cem.prior_iterations, /*restart=*/config_.start.empty());
  } else {
    model_->BeginFixedEpisode(0, model_->latent());
  }
}

void CemLoop::GoOn(const torch::Tensor& shapes, std::vector<StageStatistics> rows) {
  TrainOn(shapes);
  rows_ = std::move(rows);
}

ScoredStage CemLoop::ScorePrior(const std::string& origin) {
  const std::int64_t all = prior_.size(0);
  const std::int64_t count =
      config_.cem.prior_scored == 0 ? all : std::min<std::int64_t>(all, config_.cem.prior_scored);
  ScoredStage scored = scorer_(prior_.slice(0, 0, count), "scoring the prior set");
  const StageStatistics row = Summarize(-1, scored, prior_, config_);
  if (row.graspability.count == 0) {
    const bool solids = row.rejected() < row.samples;
    throw InputError(
        solids ? "no score for any shape of the prior set by cem.score = " + config_.cem.score
               : "no usable shape in the prior set",
        origin,
        solids ? "a score that judges some of them" : "shapes that remesh to one closed solid");
  }
  rows_.push_back(row);
  return scored;
}

void CemLoop::TrainStep() { model_->Step(shapes_on_device_); }

torch::Tensor CemLoop::Sample() {
  constexpr std::int64_t kChunk = 256;  // a second; several processes share it
  const int episode = model_->episode();
  const ProgressFn progress = observer_->Phase(StageName(episode, "sampling"));
  const std::int64_t count = config_.cem.samples;
  std::vector<torch::Tensor> chunks;
  for (std::int64_t first = 0; first < count; first += kChunk) {
    chunks.push_back(
        model_->Sample(StageSeed(config_, episode), first, std::min(kChunk, count - first)));
    progress(std::min(first + kChunk, count), count);
  }
  return torch::cat(chunks);
}

// Where parts can be moved, with their numbers.
torch::Tensor CemLoop::EliteLatents(const Selection& selection) const {
  const torch::Tensor latents =
      model_->Latents(StageSeed(config_, model_->episode()), 0, config_.cem.samples)
          .index_select(0, torch::tensor(selection.elites, torch::kLong));
  const std::int64_t lacking = config_.cem.part_step > 0.0
                                   ? config_.model.latent + model_->PartNumbers() - latents.size(1)
                                   : 0;
  return lacking > 0 ? torch::constant_pad_nd(latents, {0, lacking}) : latents;
}

torch::Tensor CemLoop::WithRefinedParts(const torch::Tensor& latents) {
  const int number = model_->episode();
  const LatentTrials trials{.trials = config_.cem.refine_steps,
                            .first = config_.model.latent,
                            .step = config_.cem.part_step};
  const auto episode = static_cast<std::uint64_t>(number);
  std::optional<EliteNiches> niches;
  if (config_.cem.refine_niches > 0 && prior_.size(0) > 1) {
    niches.emplace(prior_, latents.size(0), config_.cem.refine_niches,
                   RngStream(config_.seed, "niches", episode), config_.cem.refine_admits);
  }
  const LatentJudge judge = [&](const torch::Tensor& tried) {
    torch::Tensor values = model_->Draw(tried);
    ScoredStage scored = scorer_(selector_.WithoutOutside(values, niches ? kWithin : 1.0), "");
    return JudgedLatents(std::move(scored.graspabilities), std::move(values));
  };
  RngStream rng(config_.seed, "refine", episode);
  return RefineLatents(latents, trials, judge, &rng, observer_->Phase(StageName(number, kRefining)),
                       niches ? &*niches : nullptr);
}

Episode CemLoop::Finish() {
  const int number = model_->episode();
  Episode episode;
  episode.scored = scorer_(Sample(), StageName(number, "scoring"));
  episode.selection = selector_.Select(episode.scored, number);  // the rare event: lowest g
  const std::int64_t outside = episode.selection.outside;
  if (episode.selection.elites.empty()) {
    throw RuntimeFailure("episode " + std::to_string(number) + ": none of " +
                         std::to_string(config_.cem.samples) + " samples is a usable object" +
                         (outside > 0 ? " within cem.spread of the prior set: raise it" : ""));
  }
  if (outside > 0) {
    observer_->Note("episode " + std::to_string(number) + ": " + std::to_string(outside) + " of " +
                    std::to_string(config_.cem.samples) +
                    " beyond cem.spread of the prior set and not kept");
  }
  if (config_.cem.mode == EpisodeMode::kLatent) episode.latents = EliteLatents(episode.selection);
  if (RefinesParts(config_.cem)) {
    episode.latents = WithRefinedParts(episode.latents);
    episode.elites = model_->Draw(episode.latents);
  } else {
    episode.elites = selector_.Elites(
        episode.scored, episode.selection, number,
        PhaseOf(observer_, RefinesMeshes(config_.cem) ? StageName(number, kRefining) : ""));
  }
  episode.row = Summarize(number, episode.scored, prior_, config_);
  for (const std::int64_t i : episode.selection.elites) {
    const double value = episode.scored.graspabilities[static_cast<std::size_t>(i)];
    episode.row.elite_threshold = std::fmax(episode.row.elite_threshold, value);
  }
  rows_.push_back(episode.row);
  return episode;
}

void CemLoop::Next(const Episode& episode) {
  const int number = model_->episode();
  if (config_.cem.mode == EpisodeMode::kLatent) {
    const CemOptions& cem = config_.cem;
    model_->BeginFixedEpisode(number + 1,
                              AroundElites(episode.latents, config_.model.latent, cem.step,
                                           cem.step * cem.part_step, cem.prior_fraction));
  } else {
    TrainOn(selector_.TrainingSet(episode.elites, episode.selection));
    model_->BeginEpisode(number + 1, config_.cem.iterations, config_.cem.restart);
  }
}

std::int64_t CemLoop::UpdatesSoFar() const {
  const bool trained = config_.start.empty() || config_.fine_tune;
  const std::int64_t first = trained ? config_.cem.prior_iterations : 0;
  const std::int64_t later = config_.cem.mode == EpisodeMode::kLatent ? 0 : config_.cem.iterations;
  const int episode = model_->episode();
  return (episode == 0 ? 0 : first + (episode - 1LL) * later) + model_->step();
}

}  // namespace antigrasp
