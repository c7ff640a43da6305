#include "antigrasp/train/elite_niches.h"

#include <gtest/gtest.h>
#include <torch/types.h>

#include <cstdint>
#include <limits>
#include <vector>

#include "antigrasp/train/refined_latents.h"

namespace antigrasp {
namespace {

constexpr double kNoScore = std::numeric_limits<double>::quiet_NaN();

torch::Tensor OnALine(const std::vector<float>& places) {
  return torch::tensor(places).unsqueeze(1);
}

// Shapes at 0, 10, 20 and 30, each of which has a niche with room for one; near-duplicates are
// nearer than 5.5.
EliteNiches FourNiches(double admits = 100.0) {
  return EliteNiches(OnALine({0, 10, 20, 30}), 4, 4, RngStream(1, "elite_niches_test"), admits);
}

using Takes = std::vector<std::int64_t>;

TEST(EliteNiches, LetTrialsIntoNichesWithRoomWhateverTheyScore) {
  EliteNiches niches = FourNiches();
  niches.Set({{1, 2, 3, 4}, OnALine({0, 1, 2, 3})});
  EXPECT_EQ(niches.Filled(), 1);
  EXPECT_EQ(niches.Take({{9, 9, 9, 9}, OnALine({10, 20, 30, 3})}), (Takes{0, 1, 2, -1}));
  EXPECT_EQ(niches.Filled(), 4);
}

// Of 1, 2, 3 and 8 half are at most 2, three quarters at most 3.
TEST(EliteNiches, LetTrialsIntoNichesWithRoomUpToTheAdmittedPercentileOfTheScores) {
  const JudgedLatents elites({1, 2, 3, 8}, OnALine({0, 1, 2, 3}));
  const auto taken = [&](double admits, double score) {
    EliteNiches niches = FourNiches(admits);
    niches.Set(elites);
    const JudgedLatents trials({score, 9, 9, 9}, OnALine({10, 1, 2, 3}));
    const bool promising = niches.Promising(trials) == Takes{0};
    EXPECT_EQ(niches.Take(trials), (Takes{promising ? 0 : -1, -1, -1, -1}));
    return niches.Filled() == 2;
  };
  EXPECT_TRUE(taken(75, 3));
  EXPECT_FALSE(taken(75, 3.1));
  EXPECT_TRUE(taken(50, 2));
  EXPECT_FALSE(taken(50, 2.1));
  EXPECT_TRUE(taken(0, 0.9)) << "what scores lower than what has to go comes in";
  EXPECT_FALSE(taken(0, 1.1));
  EXPECT_TRUE(taken(100, 50));
}

TEST(EliteNiches, AdmitByThoseElitesThatHaveAScore) {
  EliteNiches niches = FourNiches(50);
  niches.Set({{1, 2, kNoScore, kNoScore}, OnALine({0, 1, 2, 3})});
  EXPECT_EQ(niches.Promising({{1, 9, 9, 9}, OnALine({10, 1, 2, 3})}), (Takes{0, 2, 3}));
  niches.Set({{kNoScore, kNoScore, kNoScore, kNoScore}, OnALine({0, 1, 2, 3})});
  EXPECT_EQ(niches.Take({{9, kNoScore, kNoScore, kNoScore}, OnALine({10, 1, 2, 3})}),
            (Takes{0, -1, -1, -1}));
}

TEST(EliteNiches, GiveRoomToTheTrialOfAnotherNicheInPlaceOfTheHighestScoreWhereThereAreTooMany) {
  EliteNiches niches = FourNiches();
  niches.Set({{1, 2, 1, 1}, OnALine({0, 4, 20, 30})});
  EXPECT_EQ(niches.Take({{8, 8, 8, 8}, OnALine({0, 4, 12, 30})}), (Takes{-1, 2, -1, -1}));
  EXPECT_EQ(niches.Filled(), 4);
  niches.Set({{kNoScore, 2, 1, 1}, OnALine({0, 4, 20, 30})});
  EXPECT_EQ(niches.Take({{8, 8, 8, 8}, OnALine({0, 4, 12, 30})}), (Takes{2, -1, -1, -1}))
      << "what has no score goes first";
}

TEST(EliteNiches, LetATrialIntoAFullNicheOnlyWhereItScoresLowerThanTheHighestThere) {
  EliteNiches niches = FourNiches();
  niches.Set({{1, 5, 1, 1}, OnALine({0, 10, 20, 30})});
  EXPECT_EQ(niches.Take({{3, 9, 4, kNoScore}, OnALine({11, 10, 9, 12})}), (Takes{-1, 0, -1, -1}));
  EXPECT_EQ(niches.Take({{1, 1, 2, 1}, OnALine({0, 30, 11, 30})}), (Takes{-1, 2, -1, -1}))
      << "the score of what came is known, and equal ones stay";
}

TEST(EliteNiches, LetNothingInThatIsNearToAnotherElite) {
  EliteNiches niches = FourNiches();
  niches.Set({{1, 1, 1, 1}, OnALine({0, 10, 20, 30})});
  EXPECT_EQ(niches.Take({{9, 0.1, 0.1, 9}, OnALine({0, 14.9F, 17, 30})}), (Takes{-1, -1, 2, -1}));
  EXPECT_EQ(niches.Take({{9, 0.1, 9, 9}, OnALine({0, 12, 17, 30})}), (Takes{-1, -1, -1, -1}))
      << "the elite that came is where it came to";
}

// Three of four shapes are at one place, and the niche of one of them holds all three.
EliteNiches ThreeAndOne() {
  return EliteNiches(OnALine({0, 0, 0, 40}), 4, 4, RngStream(1, "elite_niches_test"), 100.0);
}

TEST(EliteNiches, HoldAsManyEachAsTheirShareOfThePriorSet) {
  EliteNiches niches = ThreeAndOne();
  niches.Set({{1, 1, 1, 1}, OnALine({38, 40, 42, 44})});
  EXPECT_EQ(niches.Take({{2, 2, 2, 2}, OnALine({0, 2, 4, 6})}), (Takes{0, 1, 2, -1}));
  EXPECT_EQ(niches.Filled(), 2);
}

TEST(EliteNiches, LeaveATrialThatStaysInItsNicheToItsParent) {
  EliteNiches niches = ThreeAndOne();
  niches.Set({{5, 3, 1, 1}, OnALine({0, 2, 40, 41})});
  EXPECT_EQ(niches.Take({{6, 2, 2, 2}, OnALine({1, 3, 41, 42})}), (Takes{-1, 1, -1, -1}));
}

TEST(EliteNiches, KnowTheMeanOfAllThatWasSaidOfAnElite) {
  EliteNiches niches = FourNiches();
  const torch::Tensor places = OnALine({0, 10, 20, 30});
  niches.Set({{4, 4, kNoScore, 4}, places});
  niches.JudgeAgain({1, kNoScore, 7, 4});
  niches.JudgeAgain({1, 1, 7, 4});  // means 2, 2.5, 7, 4
  EXPECT_EQ(niches.Promising({{1.9, 2.4, 6.9, 3.9}, places}), (Takes{0, 1, 2, 3}));
  EXPECT_EQ(niches.Promising({{2.1, 2.6, 7.1, 4.1}, places}), (Takes{}));
  EXPECT_EQ(niches.Take({{1, 9, 9, 9}, places}), (Takes{0, -1, -1, -1}));
  niches.JudgeAgain({2, 9, 9, 9});  // what came is judged for itself: 1.5
  EXPECT_EQ(niches.Promising({{1.4, 9, 9, 9}, places}), (Takes{0}));
  EXPECT_EQ(niches.Promising({{1.6, 9, 9, 9}, places}), (Takes{}));
}

// A score that is low at the first look alone is not kept.
TEST(EliteNiches, LetNothingInThatScoresLowOnlyOnce) {
  EliteNiches niches = FourNiches();
  const torch::Tensor elites = torch::cat({torch::zeros({4, 1}), OnALine({0, 10, 20, 30})}, 1);
  int calls = 0;
  const LatentJudge judge = [&](const torch::Tensor& latents) {
    const double score = ++calls == 2 ? 1.0 : 5.0;  // the elites, the first trial, and those again
    return JudgedLatents(std::vector<double>(std::size_t(latents.size(0)), score),
                         latents.slice(1, 1));
  };
  RngStream rng(1, "elite_niches_test");
  const torch::Tensor refined =
      RefineLatents(elites, {.trials = 1, .first = 1, .step = 0.3}, judge, &rng, nullptr, &niches);
  EXPECT_EQ(calls, 3);
  EXPECT_TRUE(torch::equal(refined, elites));
}

// Nothing but the niches keeps elites from the least score, which is in the middle.
TEST(EliteNiches, KeepWhatIsRefinedSpreadAsThePriorSet) {
  std::vector<float> places;
  for (int i = 0; i < 9; ++i) places.push_back(static_cast<float>(i - 4));
  const torch::Tensor prior = OnALine(places);
  const LatentJudge judge = [](const torch::Tensor& latents) {
    const torch::Tensor values = latents.slice(1, 1);
    const torch::Tensor squared = values.square().sum(1).to(torch::kDouble).contiguous();
    const double* const data = squared.data_ptr<double>();
    return JudgedLatents({data, data + squared.numel()}, values);
  };
  const torch::Tensor elites = torch::cat({torch::zeros({9, 1}), prior}, 1);
  const LatentTrials trials{.trials = 200, .first = 1, .step = 0.5};
  RngStream alone(1, "alone"), apart(1, "apart");
  const std::vector<double> gathered = judge(RefineLatents(elites, trials, judge, &alone)).scores;
  for (const double score : gathered) EXPECT_LT(score, 1.0);
  EliteNiches niches(prior, 9, 9, RngStream(1, "niches"), 100.0);
  const torch::Tensor refined = RefineLatents(elites, trials, judge, &apart, nullptr, &niches);
  const JudgedLatents spread = judge(refined);
  niches.Set(spread);
  EXPECT_EQ(niches.Filled(), 9);
  for (std::size_t i = 0; i < 9; ++i) {
    EXPECT_LE(spread.scores[i], double(places[i]) * double(places[i]) + 1e-6);
  }
  EXPECT_LT(spread.scores[0], 14.0);  // from 16, as far as the niche's edge at 12.25
}

}  // namespace
}  // namespace antigrasp
