#include "antigrasp/train/similarity.h"

#include <gtest/gtest.h>
#include <torch/types.h>

namespace antigrasp {
namespace {

torch::Tensor Cloud(int n, std::uint64_t seed) {
  auto generator = at::detail::createCPUGenerator(seed);
  return torch::randn({n, 1, 2, 2, 2}, generator, torch::kFloat);
}

TEST(CompareSets, FindsNothingNewInTheSameSet) {
  const torch::Tensor set = Cloud(100, 1);
  const SetSimilarity same = CompareSets(set, set.clone());
  EXPECT_DOUBLE_EQ(same.coverage, 1.0);
  EXPECT_DOUBLE_EQ(same.diversity, 1.0);
  EXPECT_LT(same.nna, 0.01);  // every shape's nearest is its copy in the other set
}

TEST(CompareSets, CannotTellTwoSamplesOfOneDistributionApart) {
  const SetSimilarity similar = CompareSets(Cloud(400, 1), Cloud(400, 2));
  EXPECT_NEAR(similar.nna, 0.5, 0.06);
  EXPECT_NEAR(similar.diversity, 1.0, 0.05);
  EXPECT_GT(similar.coverage, 0.4);
}

TEST(CompareSets, SeesCollapseToOneShape) {
  const torch::Tensor reference = Cloud(200, 1);
  const torch::Tensor collapsed =
      reference.slice(0, 0, 1).expand_as(reference) + 1e-3 * Cloud(200, 2);
  const SetSimilarity found = CompareSets(collapsed, reference);
  EXPECT_DOUBLE_EQ(found.duplicates, 1.0);
  EXPECT_LE(found.coverage, 0.01);
  EXPECT_LT(found.diversity, 0.01);
  EXPECT_GT(found.nna, 0.95);
}

TEST(CompareSets, SeesTwoShapesOnlyWhereTheMeanDistanceMissesIt) {
  const torch::Tensor reference = Cloud(200, 1);
  const torch::Tensor two = reference.slice(0, 0, 2).repeat({100, 1, 1, 1, 1});
  const SetSimilarity found = CompareSets(two, reference);
  EXPECT_DOUBLE_EQ(found.coverage, 0.01);
  EXPECT_DOUBLE_EQ(found.duplicates, 1.0);
  EXPECT_GT(found.diversity, 0.2);
}

}  // namespace
}  // namespace antigrasp
