#include "antigrasp/train/latent_mixture.h"

#include <gtest/gtest.h>
#include <torch/types.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "antigrasp/models/random_tensor.h"
#include "antigrasp/train/averaged_generator.h"

namespace antigrasp {
namespace {

torch::Tensor Cloud(double centre, double deviation, std::int64_t count, std::uint64_t seed) {
  RngStream rng(seed, "cloud");
  return centre + deviation * NormalTensor({count, 3}, 1.0, &rng);
}

torch::Tensor Draws(const LatentMixture& mixture, std::uint64_t count) {
  std::vector<torch::Tensor> rows;
  for (std::uint64_t i = 0; i < count; ++i) {
    RngStream rng(1, "z", i);
    rows.push_back(DrawLatent(mixture, (static_cast<double>(i) + 0.5) / double(count), &rng));
  }
  return torch::stack(rows);
}

TEST(LatentMixture, OfStandardNormalsDrawsStandardNormals) {
  const torch::Tensor z = Draws(StandardNormal(3), 4000);
  EXPECT_LT(z.mean(0).abs().max().item<double>(), 0.06);
  EXPECT_LT((z.std(0) - 1.0).abs().max().item<double>(), 0.05);
}

TEST(LatentMixture, DrawsEachComponentAsOftenAsItsWeight) {
  LatentMixture mixture;
  mixture.weights = torch::tensor({0.2F, 0.5F, 0.3F});
  mixture.deviations = torch::ones({3, 2});
  mixture.means = torch::tensor({{-100.0F, 0.0F}, {0.0F, 0.0F}, {100.0F, 0.0F}});
  const torch::Tensor x = Draws(mixture, 5000).select(1, 0);
  EXPECT_NEAR((x < -50.0).sum().item<double>(), 1000.0, 1.0);
  EXPECT_NEAR((x > 50.0).sum().item<double>(), 1500.0, 1.0);
}

TEST(AroundElites, OfStandardNormalElitesIsStandardNormalAgain) {
  for (const double step : {0.1, 0.5, 1.0}) {
    const LatentMixture mixture = AroundElites(Cloud(0.0, 1.0, 500, 1), 3, step, 0.0, 0.0);
    const torch::Tensor z = Draws(mixture, 1500);
    EXPECT_LT(z.mean(0).abs().max().item<double>(), 0.15) << step;  // 500 elites: +-0.045
    EXPECT_LT((z.std(0) - 1.0).abs().max().item<double>(), 0.1) << step;
  }
}

TEST(AroundElites, KeepsFamiliesApartAndTheirShares) {
  const torch::Tensor elites = torch::cat({Cloud(-5.0, 0.5, 100, 1), Cloud(5.0, 0.5, 300, 2)});
  const torch::Tensor z = Draws(AroundElites(elites, 3, 0.3, 0.0, 0.0), 2000).select(1, 0);
  EXPECT_EQ((z.abs() < 2.0).sum().item<std::int64_t>(), 0) << "nothing between them";
  EXPECT_NEAR((z < 0).sum().item<double>(), 500.0, 60.0);
}

TEST(AroundElites, StaysAsNearToAnEliteAsTheStepSays) {
  const torch::Tensor elite = torch::full({1, 3}, 4.0);
  const torch::Tensor z = Draws(AroundElites(elite, 3, 0.3, 0.0, 0.0), 3000);
  EXPECT_NEAR(z.mean().item<double>(), 4.0 * std::sqrt(1.0 - 0.09), 0.02);
  EXPECT_NEAR(z.std().item<double>(), 0.3, 0.01);
}

TEST(AroundElites, MixesInTheAskedShareOfFreshDraws) {
  const torch::Tensor elites = torch::full({10, 3}, 50.0);
  const torch::Tensor z = Draws(AroundElites(elites, 3, 0.1, 0.0, 0.25), 4000).select(1, 0);
  EXPECT_NEAR((z < 25.0).sum().item<double>(), 800.0, 90.0);  // a fifth
  EXPECT_NEAR(AroundElites(elites, 3, 0.1, 0.0, 0.25).weights.sum().item<double>(), 1.0, 1e-5);
}

TEST(AroundElites, DrawsNumbersOfPartsAboutAnElitesByTheirOwnStep) {
  const torch::Tensor elite = torch::tensor({{4.0F, 4.0F, 7.0F}});  // z, z, a part's
  const torch::Tensor z = Draws(AroundElites(elite, 2, 0.3, 0.05, 0.0), 3000);
  EXPECT_NEAR(z.narrow(1, 0, 2).mean().item<double>(), 4.0 * std::sqrt(1.0 - 0.09), 0.02);
  EXPECT_NEAR(z.narrow(1, 0, 2).std().item<double>(), 0.3, 0.01);
  EXPECT_NEAR(z.select(1, 2).mean().item<double>(), 7.0, 0.005);
  EXPECT_NEAR(z.select(1, 2).std().item<double>(), 0.05, 0.002);
  const LatentMixture mixed = AroundElites(elite, 2, 0.3, 0.05, 0.5);  // fresh z has none
  EXPECT_EQ(mixed.means[1].abs().max().item<double>(), 0.0);
  EXPECT_TRUE(torch::allclose(mixed.deviations[1], torch::tensor({1.0F, 1.0F, 0.05F})));
}

TEST(LatentMixture, DrawsTheComponentOfTheShareByTheNormalsOfTheStream) {
  LatentMixture mixture;
  mixture.weights = torch::tensor({0.25F, 0.25F, 0.5F});
  mixture.means = torch::tensor({{1.0F, 2.0F}, {10.0F, 20.0F}, {100.0F, 200.0F}});
  mixture.deviations = torch::tensor({{0.1F, 0.2F}, {0.3F, 0.4F}, {0.5F, 0.6F}});
  for (std::uint64_t i = 0; i < 20; ++i) {
    RngStream rng(3, "z", i), same(3, "z", i);
    const torch::Tensor normal = NormalTensor({2}, 1.0, &same);
    const double share = static_cast<double>(i) / 20.0;
    const std::int64_t component = share < 0.25 ? 0 : share < 0.5 ? 1 : 2;
    EXPECT_TRUE(torch::equal(DrawLatent(mixture, share, &rng),
                             mixture.means[component] + mixture.deviations[component] * normal));
  }
}

// How often each of `n` components of equal weight is drawn, which lie a hundred apart.
torch::Tensor TimesDrawn(std::int64_t n, std::uint64_t seed, std::int64_t first,
                         std::int64_t count) {
  const torch::Tensor means = 100.0 * torch::arange(n, torch::kFloat).view({n, 1});
  const LatentMixture mixture{torch::full({n}, 1.0 / double(n)), means, torch::ones({n, 1})};
  const torch::Tensor of = (SampleLatents(mixture, seed, first, count) / 100.0).round().flatten();
  return torch::bincount(of.to(torch::kLong), {}, n);
}

TEST(SampleLatents, DrawNoComponentAgainBeforeAllOthers) {
  for (const std::int64_t n : {1, 2, 6, 100, 144}) {
    for (const std::uint64_t seed : {1, 2, 3}) {
      EXPECT_TRUE((TimesDrawn(n, seed, 37, n) == 1).all().item<bool>()) << n;
      EXPECT_TRUE((TimesDrawn(n, seed, 5, 3 * n) == 3).all().item<bool>()) << n;
    }
  }
}

TEST(SampleLatents, DrawAComponentAsOftenAsItsWeightWhereThatIsNotOneOfN) {
  LatentMixture mixture;
  mixture.weights = torch::tensor({0.9F, 0.1F});
  mixture.means = torch::tensor({{0.0F}, {100.0F}});
  mixture.deviations = torch::ones({2, 1});
  const torch::Tensor z = SampleLatents(mixture, 1, 0, 2000);
  EXPECT_NEAR((z > 50.0).sum().item<double>(), 200.0, 4.0);
}

TEST(AroundElites, HasAComponentForEachEliteAndOneFresh) {
  const torch::Tensor elites = torch::tensor({{1.0F, 2.0F}, {3.0F, -4.0F}});
  const LatentMixture with = AroundElites(elites, 2, 0.6, 0.0, 0.25);
  // sqrt(1 - 0.6^2) = 0.8; the fresh one has 0.25 of the weight of the two together: 1/5.
  EXPECT_TRUE(torch::allclose(with.weights, torch::tensor({0.4F, 0.4F, 0.2F})));
  EXPECT_TRUE(
      torch::allclose(with.means, torch::tensor({{0.8F, 1.6F}, {2.4F, -3.2F}, {0.0F, 0.0F}})));
  EXPECT_TRUE(
      torch::allclose(with.deviations, torch::tensor({{0.6F, 0.6F}, {0.6F, 0.6F}, {1.0F, 1.0F}})));
  EXPECT_TRUE(
      torch::allclose(AroundElites(elites, 2, 0.6, 0.0, 0.0).weights, torch::tensor({0.5F, 0.5F})));
  EXPECT_THROW(AroundElites(elites, 2, 0.0, 0.0, 0.0), std::logic_error);
  EXPECT_THROW(AroundElites(elites, 2, 1.1, 0.0, 0.0), std::logic_error);
}

}  // namespace
}  // namespace antigrasp
