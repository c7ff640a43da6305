#pragma once

#include <torch/types.h>

#include <functional>
#include <string>
#include <vector>

#include "antigrasp/core/observer.h"
#include "antigrasp/train/run_config.h"
#include "antigrasp/train/selection.h"
#include "antigrasp/train/shape_model.h"
#include "antigrasp/train/stage.h"

namespace antigrasp {

// Scores network values [N, 1, n, n, n], value i as sample i; `name` is what a person waits for,
// empty: nothing is shown.
using StageScorer =
    std::function<ScoredStage(const torch::Tensor& values, const std::string& name)>;

// ScoreStage: the graspability of the paper.
StageScorer GraspabilityScorer(const RunConfig& config, RunObserver* observer);

// By a judge, which must stay as long as the scorer (ScoreStageBy).
StageScorer JudgedScorer(const RunConfig& config, Judge* judge, RunObserver* observer);

// A finished episode: its samples scored, what the next one would train on, its row of statistics.
struct Episode {
  ScoredStage scored;
  Selection selection;    // at least one elite
  torch::Tensor elites;   // network values [K, 1, n, n, n] that the next one would learn from
  torch::Tensor latents;  // latent mode: what they are drawn from, and the next is drawn around
  StageStatistics row;
};

// The loop of section V-B, a step at a time and without a file; RunEpisodes keeps it in a folder.
//   CemLoop loop(config, &model, prior, scorer, observer);
//   loop.Begin();
//   loop.ScorePrior("my prior set");
//   while (true) {
//     while (!loop.trained()) loop.TrainStep();
//     const Episode episode = loop.Finish();
//     if (loop.last()) break;
//     loop.Next(episode);
//   }
// Holds references: config, model, observer and what the scorer holds must stay. Of the
// configuration it takes seed, start (whether there is one), fine_tune, model, cem and threads.
class CemLoop {
 public:
  // `prior`: network values [N, 1, n, n, n] float16, N > 0; `refine`: for cem.refine_steps > 0.
  CemLoop(const RunConfig& config, ShapeModel* model, torch::Tensor prior, StageScorer scorer,
          RunObserver* observer, EliteRefiner refine = nullptr);

  // Episode 0. With config.start the model has those networks already: it trains them on when
  // config.fine_tune, and else samples them as they are.
  void Begin();
  // In place of Begin: goes on with a model that was loaded, on the training set and after the
  // stages that were saved with it.
  void GoOn(const torch::Tensor& shapes, std::vector<StageStatistics> rows);

  // Stage -1, the first config.cem.prior_scored shapes. InputError naming `origin` when none is
  // usable.
  ScoredStage ScorePrior(const std::string& origin);

  bool trained() const { return model_->step() >= model_->iterations(); }
  void TrainStep();  // theta: one update on the shapes
  Episode Finish();  // x ~ p_theta, g_gamma(x, Q); RuntimeFailure when no sample is usable
  bool last() const { return model_->episode() == config_.cem.episodes; }
  void Next(const Episode& episode);  // begins the next on what this one selected

  const std::vector<StageStatistics>& rows() const { return rows_; }  // of all stages so far
  const torch::Tensor& shapes() const { return shapes_; }  // what this episode trains on, float16
  std::int64_t UpdatesSoFar() const;                       // over all episodes

 private:
  void TrainOn(const torch::Tensor& shapes);
  torch::Tensor Sample();
  torch::Tensor EliteLatents(const Selection& selection) const;
  torch::Tensor WithRefinedParts(const torch::Tensor& latents);

  const RunConfig& config_;
  ShapeModel* model_;
  torch::Tensor prior_;
  StageScorer scorer_;
  RunObserver* observer_;
  EliteSelector selector_;
  torch::Tensor shapes_;
  torch::Tensor shapes_on_device_;  // the same where the model is
  std::vector<StageStatistics> rows_;
};

}  // namespace antigrasp
