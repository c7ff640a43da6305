#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "antigrasp/core/options.h"
#include "antigrasp/datasets/prior_set.h"
#include "antigrasp/models/model_options.h"
#include "antigrasp/quality/metric_options.h"
#include "antigrasp/train/gan_options.h"

namespace antigrasp {

// What an episode adapts to the elites. kGan: the networks, trained on them. kLatent: the
// distribution of z, drawn around the elites' z under the generator of episode 0
// (latent_mixture.h); minutes.
enum class EpisodeMode { kGan, kLatent };
constexpr auto ChoicesOf(EpisodeMode) {
  return std::to_array<Choice<EpisodeMode>>(
      {{EpisodeMode::kGan, "gan"}, {EpisodeMode::kLatent, "latent"}});
}

// Where elites are looked for (selection.h): among all samples, shared out like the prior set, or
// among those that are unlike what beats them.
enum class EliteRule { kPaper, kStratified, kDiverse };
constexpr auto ChoicesOf(EliteRule) {
  return std::to_array<Choice<EliteRule>>({{EliteRule::kPaper, "paper"},
                                           {EliteRule::kStratified, "stratified"},
                                           {EliteRule::kDiverse, "diverse"}});
}

// By what they are picked. kRandom: the control run.
enum class EliteOrder { kGraspability, kRandom };
constexpr auto ChoicesOf(EliteOrder) {
  return std::to_array<Choice<EliteOrder>>(
      {{EliteOrder::kGraspability, "graspability"}, {EliteOrder::kRandom, "random"}});
}

inline constexpr const char* kEpsilonScore = "epsilon";

// The cross-entropy loop of V-B and VI-C.
struct CemOptions {
  EpisodeMode mode = EpisodeMode::kGan;
  int episodes = 3;              // resampling rounds after episode 0, the GAN of the prior set
  int prior_iterations = 16000;  // GAN updates in episode 0
  int iterations = 16000;        // GAN updates in every later episode
  int samples = 2500;            // objects drawn from the generator per episode
  int keep = 500;                // elites: the least graspable of them
  EliteRule variant = EliteRule::kPaper;
  int cells = 100;      // of the stratified variant
  int neighbours = 20;  // of the diverse variant
  // A sample that is farther from its nearest prior shape than this percentage of prior shapes are
  // from theirs is not kept. 0 = any distance will do.
  double spread = 0.0;
  double step = 0.5;  // latent mode: how far z strays from an elite's (latent_mixture.h)
  // Latent mode of networks that draw parts: how far the numbers of the parts themselves are moved
  // in a refining trial (refined_latents.h). Samples stray `step` times as far. 0 = not at all.
  double part_step = 0.0;
  EliteOrder select = EliteOrder::kGraspability;
  // Who scores the samples, lower = kept: "epsilon" (graspability), "settled", "trial",
  // "trial:PROTOCOL" or "judge:COMMAND" (docs/judges.md).
  std::string score = kEpsilonScore;
  bool restart = false;  // fresh networks each episode instead of going on
  // Elites are learnt from as the exact distances to their meshes, not as what the generator drew.
  bool redistance = false;
  // Steps of a descent on the share of grasps that hold, at the metric's friction, which every
  // elite is changed by before it is learnt from (refined_elites.h). Latent mode: trials that move
  // the parts of every elite by the score of the loop (refined_latents.h). 0 = none.
  int refine_steps = 0;
  // Latent mode: of how many shapes of the prior set, drawn anew in every episode, the niches are
  // by which elites compete in these trials (elite_niches.h). 0 = each elite is on its own.
  int refine_niches = 0;
  // The percentile of the elites' scores up to which a niche with room takes what falls into it,
  // beyond it only what scores lower than what has to go.
  double refine_admits = 100.0;   // 100 = whatever it scores
  double refine_hausdorff = 5.0;  // how far its surface may move, percent of its diagonal
  double prior_fraction = 0.0;    // prior shapes mixed into the elites, as a share of `keep`
  bool check_self_intersection = true;
  bool control = false;        // also run the random-keep control from the same episode 0
  int prior_scored = 500;      // prior shapes scored for kappa; 0 = all
  int compared = 500;          // shapes per side behind coverage and near-duplicates
  int checkpoint_every = 500;  // GAN updates between checkpoints
};
void Bind(OptionTable* table, CemOptions* options);  // keys "cem.*"

// Whether elites are changed as meshes (refined_elites.h), and whether as what z and the numbers of
// the parts draw (refined_latents.h).
inline bool RefinesMeshes(const CemOptions& cem) {
  return cem.refine_steps > 0 && cem.mode == EpisodeMode::kGan;
}
inline bool RefinesParts(const CemOptions& cem) {
  return cem.refine_steps > 0 && cem.mode == EpisodeMode::kLatent;
}

// Everything a run depends on. Saved resolved as RUN/config.toml and inside every checkpoint.
struct RunConfig {
  std::uint64_t seed = 1;
  int threads = 0;             // of all else; 0 = all; no result depends on it
  int torch_threads = 0;       // of training and sampling; 0 = threads
  std::string device = "cpu";  // cpu, cuda, cuda:1
  std::string start;  // networks to begin with: checkpoint or name of pretrained ones; no episode 0
  bool fine_tune = false;  // but they are trained on in episode 0
  std::string prior_file;  // an SDF file instead of a synthetic set
  PriorSetOptions prior;
  int stl_count = 10;         // least graspable objects exported at the end
  double stl_size_mm = 60.0;  // their largest extent
  ModelOptions model;
  GanOptions gan;
  CemOptions cem;
  MetricOptions metric;
};
void Bind(OptionTable* table, RunConfig* config);

// The resolved configuration as TOML, and back. InputError names `origin`.
std::string ToToml(const RunConfig& config);
RunConfig FromToml(const std::string& toml, const std::string& origin);
// For sampling from a checkpoint that another version may have written: keys that this version does
// not know are left out, but for those of the networks.
RunConfig NetworksFromToml(const std::string& toml, const std::string& origin);

// InputError for what no single range can refuse (keep > samples, a resolution of 48, ...).
void Validate(const RunConfig& config, const std::string& origin);

}  // namespace antigrasp
