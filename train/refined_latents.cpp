#include "antigrasp/train/refined_latents.h"

#include <torch/utils.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "antigrasp/core/check.h"
#include "antigrasp/models/random_tensor.h"

namespace antigrasp {
namespace {

constexpr int kJudgedAgain = 4;             // trials between that
constexpr double kMany = 0.4, kFew = 0.15;  // of the numbers
constexpr double kLine = 0.5;               // deviation along a line, of its length

// Moves in a share of the numbers, nothing in the others.
torch::Tensor Moves(torch::IntArrayRef sizes, double share, double step, RngStream* rng) {
  torch::Tensor moves = NormalTensor(sizes, step, rng);
  float* const data = moves.data_ptr<float>();
  for (std::int64_t i = 0; i < moves.numel(); ++i) {
    if (rng->Uniform() >= share) data[i] = 0.0F;
  }
  return moves;
}

// Along the line to another elite, which chance chooses for each, to either side of its own.
torch::Tensor TowardsOthers(const torch::Tensor& parts, double step, RngStream* rng) {
  const std::int64_t n = parts.size(0);
  const torch::Tensor factors = NormalTensor({n, 1}, kLine, rng);
  torch::Tensor others = torch::empty({n}, torch::kLong);
  std::int64_t* const data = others.data_ptr<std::int64_t>();
  for (std::int64_t i = 0; i < n; ++i)
    data[i] = static_cast<std::int64_t>(rng->Uniform() * double(n));
  return factors * (parts.index_select(0, others) - parts) +
         Moves(parts.sizes(), kFew, 0.5 * step, rng);
}

// Row i is judged in the place of row i + turn.
JudgedLatents JudgedInTurn(const torch::Tensor& latents, std::int64_t turn,
                           const LatentJudge& judge) {
  JudgedLatents judged = judge(latents.roll(turn, 0));
  AG_CHECK(std::ssize(judged.scores) == latents.size(0), "a score for every latent");
  std::rotate(judged.scores.begin(), judged.scores.begin() + turn % latents.size(0),
              judged.scores.end());
  if (judged.values.defined()) judged.values = judged.values.roll(-turn, 0);
  return judged;
}

// Those that would take a place are judged once more; only the second score counts, and the others
// have none.
void LookAgain(const torch::Tensor& latents, const EliteNiches& niches, const LatentJudge& judge,
               JudgedLatents* trials) {
  const std::vector<std::int64_t> promising = niches.Promising(*trials);
  trials->scores.assign(trials->scores.size(), std::numeric_limits<double>::quiet_NaN());
  if (promising.empty()) return;
  // Last first: nearly all of them in other places than before.
  const torch::Tensor rows = torch::tensor(promising, torch::kLong).flip(0);
  const std::vector<double> scores = judge(latents.index_select(0, rows)).scores;
  AG_CHECK(scores.size() == promising.size(), "a score for every latent");
  for (std::size_t i = 0; i < scores.size(); ++i) {
    trials->scores[static_cast<std::size_t>(promising[promising.size() - 1 - i])] = scores[i];
  }
}

// For every elite the trial that takes its place, or -1: its own, where that scores lower.
std::vector<std::int64_t> TakeOwn(const std::vector<double>& scores, std::vector<double>* least) {
  std::vector<std::int64_t> takes(scores.size(), -1);
  for (std::size_t i = 0; i < scores.size(); ++i) {
    double& own = (*least)[i];
    if (std::isnan(scores[i]) || scores[i] >= own) continue;  // anything is better than none
    own = scores[i];
    takes[i] = static_cast<std::int64_t>(i);
  }
  return takes;
}

}  // namespace

torch::Tensor RefineLatents(const torch::Tensor& elites, const LatentTrials& how,
                            const LatentJudge& judge, RngStream* rng, const ProgressFn& progress,
                            EliteNiches* niches) {
  const torch::NoGradGuard no_grad;
  AG_CHECK(elites.dim() == 2 && elites.size(1) > how.first, "numbers that can be moved");
  torch::Tensor best = elites.clone();
  const std::int64_t numbers = best.size(1) - how.first;
  std::vector<double> least;
  for (int trial = 0; trial < how.trials; ++trial) {
    const std::int64_t turn = trial / kJudgedAgain;
    if (trial % kJudgedAgain == 0) {
      const JudgedLatents judged = JudgedInTurn(best, turn, judge);
      least = judged.scores;
      if (niches != nullptr && trial == 0) niches->Set(judged);
      if (niches != nullptr && trial > 0) niches->JudgeAgain(judged.scores);
    }
    torch::Tensor moved = best.clone();
    torch::Tensor parts = moved.narrow(1, how.first, numbers);
    const bool on_a_line = niches != nullptr && trial % 2 == 1;
    parts.add_(on_a_line ? TowardsOthers(parts, how.step, rng)
                         : Moves(parts.sizes(), trial % 2 == 0 ? kMany : kFew, how.step, rng));
    JudgedLatents judged = JudgedInTurn(moved, turn, judge);
    if (niches != nullptr) LookAgain(moved, *niches, judge, &judged);
    const std::vector<std::int64_t> takes =
        niches != nullptr ? niches->Take(judged) : TakeOwn(judged.scores, &least);
    for (std::int64_t i = 0; i < std::ssize(takes); ++i) {
      const std::int64_t taker = takes[static_cast<std::size_t>(i)];
      if (taker >= 0) best[i].copy_(moved[taker]);
    }
    if (progress) progress(trial + 1, how.trials);
  }
  return best;
}

}  // namespace antigrasp
