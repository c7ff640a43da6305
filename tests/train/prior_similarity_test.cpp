#include "antigrasp/train/prior_similarity.h"

#include <gtest/gtest.h>
#include <torch/types.h>

namespace antigrasp {
namespace {

torch::Tensor Cloud(int n, std::uint64_t seed) {
  auto generator = at::detail::createCPUGenerator(seed);
  return torch::randn({n, 1, 2, 2, 2}, generator, torch::kFloat);
}

// Shapes on a line.
torch::Tensor Line(std::vector<float> places) {
  return torch::tensor(places).reshape({-1, 1, 1, 1, 1});
}

TEST(CompareWithPrior, TellsTheSamplesFromTheReference) {
  // Nearest reference shapes of the samples 0.1, 0.3, 2: 0, 0, 1. The other way round all three
  // samples would be covered (0 -> 0.1, 1 -> 0.3, 10 -> 2). The fourth shape is cut off.
  const torch::Tensor samples = Line({0.1F, 0.3F, 2.0F});
  const torch::Tensor reference = Line({0.0F, 1.0F, 10.0F, 0.3F});
  const PriorSimilarity found = CompareWithPrior(samples, reference);
  EXPECT_DOUBLE_EQ(found.coverage, 2.0 / 3);
  // Own nearest: 0.2, 0.2, 1.7 and 1, 1, 9; of the other set: 0.1, 0.3, 1 and 0.1, 0.7, 8. Only
  // 0.3's nearest is of its own set.
  EXPECT_DOUBLE_EQ(found.nna, 1.0 / 6);
  // Nearer than half of the reference's median, 0.5: two of the samples, none of the reference.
  EXPECT_DOUBLE_EQ(found.duplicates, 2.0 / 3);
  // Pairs: 0.2, 1.9, 1.7 by 1, 10, 9.
  EXPECT_NEAR(found.diversity, 3.8 / 20.0, 1e-6);
  const PriorSimilarity turned = CompareWithPrior(reference, samples);
  EXPECT_DOUBLE_EQ(turned.coverage, 1.0);
  EXPECT_DOUBLE_EQ(turned.duplicates, 0.0);
  EXPECT_NEAR(turned.diversity, 20.0 / 3.8, 1e-5);
}

TEST(CompareWithPrior, FindsNothingNewInTheSameSet) {
  const torch::Tensor set = Cloud(100, 1);
  const PriorSimilarity same = CompareWithPrior(set, set.clone());
  EXPECT_DOUBLE_EQ(same.coverage, 1.0);
  EXPECT_DOUBLE_EQ(same.diversity, 1.0);
  EXPECT_LT(same.nna, 0.01);  // every shape's nearest is its copy in the other set
}

TEST(CompareWithPrior, CannotTellTwoSamplesOfOneDistributionApart) {
  const PriorSimilarity similar = CompareWithPrior(Cloud(400, 1), Cloud(400, 2));
  EXPECT_NEAR(similar.nna, 0.5, 0.06);
  EXPECT_NEAR(similar.diversity, 1.0, 0.05);
  EXPECT_GT(similar.coverage, 0.4);
}

TEST(CompareWithPrior, SeesCollapseToOneShape) {
  const torch::Tensor reference = Cloud(200, 1);
  const torch::Tensor collapsed =
      reference.slice(0, 0, 1).expand_as(reference) + 1e-3 * Cloud(200, 2);
  const PriorSimilarity found = CompareWithPrior(collapsed, reference);
  EXPECT_DOUBLE_EQ(found.duplicates, 1.0);
  EXPECT_LE(found.coverage, 0.01);
  EXPECT_LT(found.diversity, 0.01);
  EXPECT_GT(found.nna, 0.95);
}

TEST(CompareWithPrior, SeesTwoShapesOnlyWhereTheMeanDistanceMissesIt) {
  const torch::Tensor reference = Cloud(200, 1);
  const torch::Tensor two = reference.slice(0, 0, 2).repeat({100, 1, 1, 1, 1});
  const PriorSimilarity found = CompareWithPrior(two, reference);
  EXPECT_DOUBLE_EQ(found.coverage, 0.01);
  EXPECT_DOUBLE_EQ(found.duplicates, 1.0);
  EXPECT_GT(found.diversity, 0.2);
}

}  // namespace
}  // namespace antigrasp
