#include "antigrasp/train/latent_mixture.h"

#include <gtest/gtest.h>
#include <torch/torch.h>

#include "antigrasp/models/random_tensor.h"

namespace antigrasp {
namespace {

torch::Tensor Cloud(double centre, double deviation, std::int64_t count, std::uint64_t seed) {
  RngStream rng(seed, "cloud");
  return centre + deviation * NormalTensor({count, 3}, 1.0, &rng);
}

TEST(LatentMixture, OfStandardNormalsDrawsStandardNormals) {
  const LatentMixture mixture = StandardNormal(4, 3);
  std::vector<torch::Tensor> rows;
  for (std::uint64_t i = 0; i < 4000; ++i) {
    RngStream rng(1, "z", i);
    rows.push_back(DrawLatent(mixture, &rng));
  }
  const torch::Tensor z = torch::stack(rows);
  EXPECT_LT(z.mean(0).abs().max().item<double>(), 0.06);
  EXPECT_LT((z.std(0) - 1.0).abs().max().item<double>(), 0.05);
}

TEST(LatentMixture, DrawsEachComponentAsOftenAsItsWeight) {
  LatentMixture mixture = StandardNormal(3, 2);
  mixture.weights = torch::tensor({0.2F, 0.5F, 0.3F});
  mixture.means = torch::tensor({{-100.0F, 0.0F}, {0.0F, 0.0F}, {100.0F, 0.0F}});
  int low = 0, high = 0;
  for (std::uint64_t i = 0; i < 5000; ++i) {
    RngStream rng(1, "z", i);
    const float x = DrawLatent(mixture, &rng)[0].item<float>();
    low += x < -50.0F ? 1 : 0;
    high += x > 50.0F ? 1 : 0;
  }
  EXPECT_NEAR(low, 1000, 100);
  EXPECT_NEAR(high, 1500, 110);
}

TEST(FitToElites, OfOneComponentIsMeanAndDeviationOfTheElites) {
  const torch::Tensor elites = Cloud(2.0, 0.5, 200, 1);
  RngStream rng(1, "fit");
  const LatentMixture fit = FitToElites(StandardNormal(1, 3), elites, 1.0, 0.01, &rng);
  EXPECT_TRUE(torch::allclose(fit.means[0], elites.mean(0), 1e-4, 1e-4));
  EXPECT_TRUE(torch::allclose(fit.deviations[0], elites.std(0, /*unbiased=*/false), 1e-3, 1e-3));
}

TEST(FitToElites, FindsTwoFamilies) {
  const torch::Tensor elites = torch::cat({Cloud(-5.0, 0.5, 100, 1), Cloud(5.0, 0.5, 300, 2)});
  bool found = false;  // an unlucky start may put both components on one family
  for (std::uint64_t seed = 0; seed < 8 && !found; ++seed) {
    RngStream rng(seed, "fit");
    const LatentMixture fit = FitToElites(StandardNormal(2, 3), elites, 1.0, 0.01, &rng);
    const std::int64_t low = fit.means[0][0].item<float>() < 0 ? 0 : 1;
    found = std::abs(fit.means[low].mean().item<double>() + 5.0) < 0.2 &&
            std::abs(fit.means[1 - low].mean().item<double>() - 5.0) < 0.2 &&
            std::abs(fit.weights[low].item<double>() - 0.25) < 0.02;
  }
  EXPECT_TRUE(found);
}

TEST(FitToElites, GoesPartOfTheWayAndKeepsTheLeastDeviation) {
  const torch::Tensor elites = torch::full({20, 3}, 4.0);
  RngStream rng(1, "fit");
  const LatentMixture fit = FitToElites(StandardNormal(1, 3), elites, 0.5, 0.3, &rng);
  EXPECT_NEAR(fit.means[0][0].item<double>(), 2.0, 1e-5);
  EXPECT_NEAR(fit.deviations[0][0].item<double>(), 0.65, 1e-5);  // half way from 1 to 0.3
  RngStream again(1, "fit");
  const LatentMixture still = FitToElites(StandardNormal(1, 3), elites, 0.0, 0.3, &again);
  EXPECT_EQ(still.means.abs().max().item<double>(), 0.0);
}

TEST(FitToElites, SurvivesFewerElitesThanComponents) {
  RngStream rng(1, "fit");
  const LatentMixture fit =
      FitToElites(StandardNormal(8, 3), Cloud(1.0, 1.0, 2, 1), 1.0, 0.2, &rng);
  EXPECT_TRUE(fit.means.isfinite().all().item<bool>());
  EXPECT_NEAR(fit.weights.sum().item<double>(), 1.0, 1e-5);
  EXPECT_GE(fit.deviations.min().item<double>(), 0.2F - 1e-6);
}

}  // namespace
}  // namespace antigrasp
