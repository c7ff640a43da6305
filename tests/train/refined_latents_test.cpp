#include "antigrasp/train/refined_latents.h"

#include <gtest/gtest.h>
#include <torch/types.h>

#include <cmath>
#include <limits>
#include <vector>

namespace antigrasp {
namespace {

// The squared length of the numbers behind the first two.
std::vector<double> SquaredLengths(const torch::Tensor& latents) {
  const torch::Tensor squared = latents.slice(1, 2).square().sum(1).to(torch::kDouble).contiguous();
  const double* const data = squared.data_ptr<double>();
  return {data, data + squared.numel()};
}

torch::Tensor Elites() {  // z of two numbers, five of parts
  return torch::cat({torch::full({6, 2}, 9.0), torch::full({6, 5}, 1.0)}, 1);
}

torch::Tensor Refined(int trials, const LatentJudge& judge) {
  RngStream rng(1, "refined_latents_test");
  return RefineLatents(Elites(), {.trials = trials, .first = 2, .step = 0.3}, judge, &rng);
}

TEST(RefineLatents, ComesNearTheLeastScoreAndLeavesZAlone) {
  const torch::Tensor refined = Refined(150, SquaredLengths);
  EXPECT_TRUE(torch::equal(refined.slice(1, 0, 2), Elites().slice(1, 0, 2)));
  for (const double squared : SquaredLengths(refined)) EXPECT_LT(squared, 0.5);  // of 5
}

TEST(RefineLatents, NeverKeepsWhatScoresHigherOrIsNotToBeHad) {
  std::vector<double> before = SquaredLengths(Elites());
  for (const int trials : {1, 2, 3, 7, 12}) {
    const std::vector<double> after = SquaredLengths(Refined(trials, SquaredLengths));
    for (std::size_t i = 0; i < after.size(); ++i) EXPECT_LE(after[i], before[i]) << trials;
    before = after;  // the first trials of more are those of fewer
  }
  const LatentJudge beyond_half = [](const torch::Tensor& latents) {
    std::vector<double> scores = SquaredLengths(latents);
    for (double& score : scores) {
      if (score < 2.5) score = std::numeric_limits<double>::quiet_NaN();
    }
    return scores;
  };
  for (const double squared : SquaredLengths(Refined(150, beyond_half))) EXPECT_GE(squared, 2.5);
}

TEST(RefineLatents, TakesAnythingForAnEliteThatIsNotToBeHad) {
  const LatentJudge only_moved = [](const torch::Tensor& latents) {
    std::vector<double> scores = SquaredLengths(latents);
    for (double& score : scores) {
      if (score == 5.0) score = std::numeric_limits<double>::quiet_NaN();
    }
    return scores;
  };
  const torch::Tensor refined = Refined(12, only_moved);
  EXPECT_EQ((refined != Elites()).any(1).sum().item<int>(), 6);
}

// Noise that belongs to a place: without a change of places the elite there would never move.
TEST(RefineLatents, JudgesElitesAgainInOtherPlaces) {
  int judged = 0;
  std::vector<std::vector<std::int64_t>> elites_at;  // by call, what was judged in every place
  torch::Tensor elites = Elites();
  for (int i = 0; i < 6; ++i) elites[i].fill_(static_cast<float>(i));
  const LatentJudge judge = [&](const torch::Tensor& latents) {
    ++judged;
    std::vector<std::int64_t> who;
    for (int i = 0; i < 6; ++i) who.push_back(std::llround(latents[i][0].item<double>()));
    elites_at.push_back(who);
    return std::vector<double>(6, 1.0);  // nothing is better than anything
  };
  RngStream rng(1, "refined_latents_test");
  const torch::Tensor refined =
      RefineLatents(elites, {.trials = 9, .first = 2, .step = 0.3}, judge, &rng);
  EXPECT_TRUE(torch::equal(refined, elites));
  ASSERT_EQ(judged, 12);  // 9 trials, and the elites before the first, fifth and ninth
  EXPECT_EQ(elites_at[0], (std::vector<std::int64_t>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(elites_at[5], (std::vector<std::int64_t>{5, 0, 1, 2, 3, 4}));
  EXPECT_EQ(elites_at[10], (std::vector<std::int64_t>{4, 5, 0, 1, 2, 3}));
  for (const auto& who : elites_at) EXPECT_EQ(who.size(), 6U);
}

TEST(RefineLatents, AScoreBelongsToTheEliteThatWasJudgedWhereverThatWas) {
  // Elite 3 alone can be improved, and only its own scores say so.
  torch::Tensor elites = Elites();
  elites[3].slice(0, 2).fill_(8.0);
  const LatentJudge judge = [](const torch::Tensor& latents) {
    std::vector<double> scores = SquaredLengths(latents);
    for (double& score : scores) score = score > 100.0 ? score : 1.0;
    return scores;
  };
  RngStream rng(1, "refined_latents_test");
  const torch::Tensor refined =
      RefineLatents(elites, {.trials = 20, .first = 2, .step = 0.3}, judge, &rng);
  const torch::Tensor moved = (refined != elites).any(1);
  EXPECT_TRUE(moved[3].item<bool>());
  EXPECT_EQ(moved.sum().item<int>(), 1);
  EXPECT_LT(SquaredLengths(refined)[3], 320.0);
}

}  // namespace
}  // namespace antigrasp
