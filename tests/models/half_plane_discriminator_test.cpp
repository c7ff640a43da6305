#include "antigrasp/models/half_plane_discriminator.h"

#include <ATen/ATen.h>
#include <gtest/gtest.h>
#include <torch/types.h>

#include <algorithm>

#include "antigrasp/models/discriminator.h"
#include "antigrasp/models/folding.h"
#include "antigrasp/models/random_tensor.h"

namespace antigrasp {
namespace {

ModelOptions Turned() {
  ModelOptions options;
  options.kind = ModelKind::kSolids;
  options.form = PartForm::kTurned;
  options.width = 2;
  return options;
}

torch::Tensor Grids(std::int64_t n, std::int64_t r) {
  RngStream rng(8, "half_plane_discriminator_test");
  return NormalTensor({n, 1, r, r, r}, 0.4, &rng).clamp_(-1, 1);
}

// [N, 2, r, r / 2], node by node: values from the axis outwards, and three times their Laplacian.
torch::Tensor SeenBy(const torch::Tensor& grids) {
  const std::int64_t n = grids.size(0), r = grids.size(4), half = r / 2;
  torch::Tensor seen = torch::empty({n, 2, r, half});
  const auto value = grids.accessor<float, 5>();
  auto out = seen.accessor<float, 4>();
  for (std::int64_t i = 0; i < n; ++i) {
    const auto at = [&](std::int64_t z, std::int64_t radius) {
      const std::int64_t row = std::min(std::max<std::int64_t>(z, 0), r - 1);
      return value[i][0][row][half - 1]
                  [half + std::min(std::max<std::int64_t>(radius, 0), half - 1)];
    };
    for (std::int64_t z = 0; z < r; ++z) {
      for (std::int64_t radius = 0; radius < half; ++radius) {
        const float around =
            at(z - 1, radius) + at(z + 1, radius) + at(z, radius - 1) + at(z, radius + 1);
        out[i][0][z][radius] = at(z, radius);
        out[i][1][z][radius] = 3.0F * (around - 4.0F * at(z, radius));
      }
    }
  }
  return seen;
}

TEST(HalfPlaneDiscriminator, EqualsPlainLayersOnValuesAndLaplaciansOfTheHalfPlane) {
  torch::NoGradGuard no_grad;
  for (const int resolution : {16, 32}) {
    ModelOptions options = Turned();
    options.resolution = resolution;
    HalfPlaneDiscriminator discriminator(options);
    const auto weights = discriminator->named_parameters();
    const torch::Tensor grids = Grids(3, resolution);
    torch::Tensor x = SeenBy(grids);
    const int convolutions = resolution == 32 ? 4 : 3;
    for (int i = 1; i <= convolutions + 2; ++i) {
      const torch::Tensor weight = weights["weight" + std::to_string(i)];
      const torch::Tensor bias = weights["bias" + std::to_string(i)];
      x = i <= convolutions ? torch::conv2d(x, weight, bias, i == 1 ? 1 : 2, 1)
                            : torch::linear(x.flatten(1), weight, bias);
      if (i < convolutions + 2) x = torch::where(x > 0, x, 0.2 * x);
    }
    EXPECT_TRUE(torch::allclose(discriminator(grids), x.squeeze(1), 1e-4, 1e-5)) << resolution;
    EXPECT_TRUE(torch::equal(discriminator->ForwardFolded(Fold(grids)), discriminator(grids)));
  }
}

TEST(HalfPlaneDiscriminator, SeesHalfThePlaneAndNothingElse) {
  torch::NoGradGuard no_grad;
  HalfPlaneDiscriminator discriminator(Turned());
  const torch::Tensor grids = Grids(2, 32);
  torch::Tensor elsewhere = Grids(4, 32).narrow(0, 2, 2).clone();
  elsewhere.select(3, 15).narrow(3, 16, 16).copy_(grids.select(3, 15).narrow(3, 16, 16));
  EXPECT_TRUE(torch::equal(discriminator(elsewhere), discriminator(grids)));
  torch::Tensor touched = grids.clone();
  touched.select(3, 15).narrow(3, 16, 16)[1][0][20][4].fill_(1.0);
  const torch::Tensor change = (discriminator(touched) - discriminator(grids)).abs();
  EXPECT_EQ(change[0].item<float>(), 0.0F);
  EXPECT_GT(change[1].item<float>(), 0.0F);
}

TEST(HalfPlaneDiscriminator, SeesIntoShapesAsFarAsItsDepth) {
  torch::NoGradGuard no_grad;
  ModelOptions options = Turned();
  HalfPlaneDiscriminator plain(options);
  options.depth = 0.03;  // by a truncation of 0.1 a value of 0.3
  HalfPlaneDiscriminator shallow(options);
  const torch::Tensor grids = Grids(2, 32);
  EXPECT_TRUE(torch::equal(shallow(grids), plain(grids.clamp_max(0.3))));
  EXPECT_FALSE(torch::allclose(shallow(grids), plain(grids), 1e-3, 1e-3));
}

TEST(HalfPlaneDiscriminator, JudgesTurnedSolidsAndNoOthers) {
  ModelOptions options = Turned();
  EXPECT_NE(dynamic_cast<HalfPlaneDiscriminatorImpl*>(MakeDiscriminator(options).get()), nullptr);
  options.form = PartForm::kBoxes;
  EXPECT_NE(dynamic_cast<DiscriminatorImpl*>(MakeDiscriminator(options).get()), nullptr);
  options.form = PartForm::kTurned;
  options.kind = ModelKind::kSngan;  // whose samples need not be round
  EXPECT_NE(dynamic_cast<DiscriminatorImpl*>(MakeDiscriminator(options).get()), nullptr);
}

TEST(HalfPlaneDiscriminator, ShapesOfAPackMeetInTheFeatures) {
  torch::NoGradGuard no_grad;
  ModelOptions options = Turned();
  options.pack = 2;
  HalfPlaneDiscriminator discriminator(options);
  const torch::Tensor grids = Grids(4, 32);
  const torch::Tensor scores = discriminator(grids);
  ASSERT_EQ(scores.size(0), 4);  // one a shape, not one a pack
  torch::Tensor other = grids.clone();
  other[1] = grids[2];  // another companion for the first, the second pack as it was
  const torch::Tensor change = (discriminator(other) - scores).abs();
  EXPECT_GT(change[0].item<float>(), 0.0F);
  EXPECT_EQ(change[2].item<float>(), 0.0F);
  EXPECT_EQ(change[3].item<float>(), 0.0F);
  // A pack of one shape twice deviates by nothing: the weights of deviations say nothing.
  const torch::Tensor twice = grids.index_select(0, torch::tensor({3, 3}));
  const torch::Tensor before = discriminator(twice);
  torch::Tensor weight = discriminator->named_parameters()["weight5"];
  weight.narrow(1, weight.size(1) / 2, weight.size(1) / 2).zero_();
  EXPECT_TRUE(torch::allclose(discriminator(twice), before, 1e-3, 1e-4));
}

TEST(HalfPlaneDiscriminator, IsAsWideAsItIsTold) {
  ModelOptions options = Turned();
  const auto channels = [&] {
    return HalfPlaneDiscriminator(options)->named_parameters()["weight1"].size(0);
  };
  EXPECT_EQ(channels(), 6);
  options.width_d = 5;
  EXPECT_EQ(channels(), 15);
}

}  // namespace
}  // namespace antigrasp
