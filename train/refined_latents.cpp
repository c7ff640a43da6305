#include "antigrasp/train/refined_latents.h"

#include <torch/utils.h>

#include <cmath>

#include "antigrasp/core/check.h"
#include "antigrasp/models/random_tensor.h"

namespace antigrasp {
namespace {

constexpr int kJudgedAgain = 4;             // trials between that
constexpr double kMany = 0.4, kFew = 0.15;  // of the numbers

// Moves in a share of the numbers, nothing in the others.
torch::Tensor Moves(torch::IntArrayRef sizes, double share, double step, RngStream* rng) {
  torch::Tensor moves = NormalTensor(sizes, step, rng);
  float* const data = moves.data_ptr<float>();
  for (std::int64_t i = 0; i < moves.numel(); ++i) {
    if (rng->Uniform() >= share) data[i] = 0.0F;
  }
  return moves;
}

// Row i is judged in the place of row i + turn.
std::vector<double> JudgedInTurn(const torch::Tensor& latents, std::int64_t turn,
                                 const LatentJudge& judge) {
  const std::vector<double> scores = judge(latents.roll(turn, 0));
  const auto n = static_cast<std::int64_t>(scores.size());
  AG_CHECK(n == latents.size(0), "a score for every latent");
  std::vector<double> own;
  for (std::int64_t i = 0; i < n; ++i) own.push_back(scores[std::size_t((i + turn) % n)]);
  return own;
}

}  // namespace

torch::Tensor RefineLatents(const torch::Tensor& elites, const LatentTrials& how,
                            const LatentJudge& judge, RngStream* rng, const ProgressFn& progress) {
  const torch::NoGradGuard no_grad;
  AG_CHECK(elites.dim() == 2 && elites.size(1) > how.first, "numbers that can be moved");
  torch::Tensor best = elites.clone();
  const std::int64_t n = best.size(0), numbers = best.size(1) - how.first;
  std::vector<double> least;
  for (int trial = 0; trial < how.trials; ++trial) {
    const std::int64_t turn = trial / kJudgedAgain;
    if (trial % kJudgedAgain == 0) least = JudgedInTurn(best, turn, judge);
    torch::Tensor moved = best.clone();
    moved.narrow(1, how.first, numbers)
        .add_(Moves({n, numbers}, trial % 2 == 0 ? kMany : kFew, how.step, rng));
    const std::vector<double> scores = JudgedInTurn(moved, turn, judge);
    for (std::int64_t i = 0; i < n; ++i) {
      double& own = least[static_cast<std::size_t>(i)];
      const double score = scores[static_cast<std::size_t>(i)];
      if (std::isnan(score) || score >= own) continue;  // anything is better than none
      own = score;
      best[i].copy_(moved[i]);
    }
    if (progress) progress(trial + 1, how.trials);
  }
  return best;
}

}  // namespace antigrasp
