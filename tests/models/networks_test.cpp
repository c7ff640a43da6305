#include <gtest/gtest.h>
#include <torch/autograd.h>
#include <torch/types.h>

#include <cmath>

#include "antigrasp/core/error.h"
#include "antigrasp/models/discriminator.h"
#include "antigrasp/models/folding.h"
#include "antigrasp/models/generator.h"
#include "antigrasp/models/random_tensor.h"
#include "antigrasp/models/sdf_values.h"

namespace antigrasp {
namespace {

ModelOptions TinyModel() {
  ModelOptions options;
  options.width = 2;
  options.latent = 5;
  return options;
}

torch::Tensor Latent(std::int64_t count, std::int64_t length) {
  RngStream rng(3, "networks_test");
  return NormalTensor({count, length}, 1.0, &rng);
}

// The generator in the library's own layers, from its parameters by name.
torch::Tensor PlainGenerator(Generator& generator, const torch::Tensor& z) {
  const auto parameters = generator->named_parameters();
  torch::Tensor x = torch::linear(z, parameters["project.weight"]).view({z.size(0), -1, 2, 2, 2});
  for (int i = 0; parameters.contains("norm" + std::to_string(i) + ".weight"); ++i) {
    const std::string norm = "norm" + std::to_string(i), up = "up" + std::to_string(i + 1);
    x = torch::relu(torch::batch_norm(x, parameters[norm + ".weight"], parameters[norm + ".bias"],
                                      {}, {}, true, 0.1, 1e-5, false));
    x = parameters.contains(up + "_weight")
            ? torch::conv_transpose3d(x, parameters[up + "_weight"], {}, 2, 1)
            : torch::conv_transpose3d(x, parameters["last_weight"], parameters["last_bias"], 2, 1);
  }
  return torch::tanh(x);
}

// `tolerance`: of gradients, single-precision sums over all nodes both ways.
void ExpectPlainGenerator(ModelOptions options, double tolerance = 1e-4) {
  options.output_blur = false;
  Generator generator(options);
  const torch::Tensor z = Latent(4, options.latent);
  const torch::Tensor actual = generator(z), expected = PlainGenerator(generator, z);
  EXPECT_LT((actual - expected).abs().max().item<double>(), 1e-5);
  const std::int64_t r = options.resolution;
  ASSERT_EQ(actual.sizes(), (std::vector<std::int64_t>{4, 1, r, r, r}));
  const torch::Tensor weight = Latent(4, r * r * r).view({4, 1, r, r, r});
  const auto gradients = torch::autograd::grad({(actual * weight).sum()}, generator->parameters());
  const auto plain = torch::autograd::grad({(expected * weight).sum()}, generator->parameters());
  for (std::size_t i = 0; i < plain.size(); ++i) {
    EXPECT_LT((gradients[i] - plain[i]).abs().max().item<double>(),
              tolerance * plain[i].abs().max().item<double>())
        << "parameter " << i;
  }
}

TEST(Generator, EqualsThePlainLayersWithoutBlur) { ExpectPlainGenerator(TinyModel()); }

TEST(Generator, EqualsThePlainLayersAtOtherResolutions) {
  for (const int resolution : {16, 64}) {
    ModelOptions options = TinyModel();
    options.resolution = resolution;
    ExpectPlainGenerator(options, 5e-4);
  }
}

TEST(Generator, FoldedOutputIsTheFoldedGrid) {
  Generator generator(TinyModel());
  generator->eval();
  const torch::Tensor z = Latent(2, 5);
  EXPECT_TRUE(torch::equal(generator->ForwardJudged(z), Fold(generator(z))));
}

TEST(Generator, ValuesLieWithinOneAndStartOutsideOnTheBorder) {
  for (const bool batch_norm : {true, false}) {
    ModelOptions options = TinyModel();
    options.batch_norm = batch_norm;
    options.width = 4;
    Generator generator(options);
    const torch::Tensor grid = generator(Latent(8, options.latent));
    EXPECT_EQ(grid.sizes(), (std::vector<std::int64_t>{8, 1, 32, 32, 32}));
    EXPECT_LE(grid.abs().max().item<double>(), 1.0);
    EXPECT_LT(grid.mean().item<double>(), 0.0);
    EXPECT_EQ(generator->buffers().empty(), !batch_norm);
  }
}

TEST(Generator, InitialShapesAreSmooth) {
  // Trilinear kernels: second differences of a fresh sample stay far below white noise's.
  ModelOptions options = TinyModel();
  options.width = 8;
  Generator generator(options);
  const torch::Tensor x = generator(Latent(16, options.latent)).slice(4, 4, 28);
  const torch::Tensor second = x.slice(4, 0, -2) - 2 * x.slice(4, 1, -1) + x.slice(4, 2);
  EXPECT_LT(second.std().item<double>(), 0.2 * x.std().item<double>());
}

TEST(Generator, RestartedStatisticsAreTheAverageOverTheBatches) {
  ModelOptions options = TinyModel();
  Generator generator(options);
  generator->RestartStatistics();
  generator->train();
  const torch::Tensor a = Latent(8, 5), b = 2.0 * Latent(8, 5) + 1.0;
  const torch::Tensor weight = generator->named_parameters()["project.weight"];
  const auto channel_means = [&](const torch::Tensor& z) {
    return torch::linear(z, weight).view({8, -1, 8}).mean(at::IntArrayRef({0, 2}));
  };
  generator(a);
  generator(b);
  const torch::Tensor mean = generator->named_buffers()["norm0.running_mean"];
  const torch::Tensor expected = (channel_means(a) + channel_means(b)) / 2;
  EXPECT_LT((mean - expected).abs().max().item().toDouble(), 1e-5);
}

TEST(Generator, FoldedBatchNormGivesTheSameGridsInTrainingToo) {
  ModelOptions options = TinyModel();
  options.width = 4;
  Generator with(options);
  {
    torch::NoGradGuard no_grad;  // scales and shifts that matter
    for (auto& item : with->named_parameters()) {
      if (item.key().starts_with("norm")) item.value().add_(0.3 * torch::randn_like(item.value()));
    }
  }
  with->RestartStatistics();
  with->train();
  with(2.0 * Latent(32, options.latent));  // statistics far from those of the batch below
  with->eval();
  ModelOptions plain = options;
  plain.batch_norm = false;
  Generator without(plain);
  without->TakeFolded(*with);
  const torch::Tensor z = Latent(4, options.latent), grids = with(z);
  for (const bool training : {false, true}) {
    without->train(training);
    EXPECT_LT((without(z) - grids).abs().max().item<double>(), 1e-5);
  }
  with->train();
  EXPECT_GT((with(z) - grids).abs().max().item<double>(), 1e-2);  // what folding takes away
}

TEST(Generator, WeightsDependOnTheStreamOnly) {
  Generator a(TinyModel()), b(TinyModel());
  for (Generator* generator : {&a, &b}) {
    RngStream rng(42, "weights");
    (*generator)->Initialize(&rng);
  }
  for (std::size_t i = 0; i < a->parameters().size(); ++i) {
    EXPECT_TRUE(torch::equal(a->parameters()[i], b->parameters()[i]));
  }
  RngStream other(43, "weights");
  b->Initialize(&other);
  EXPECT_FALSE(torch::equal(a->parameters()[0], b->parameters()[0]));
}

// Packed shapes are channels of one input.
void ExpectPlainLayers(int pack, int resolution = 32) {
  ModelOptions options = TinyModel();
  options.spectral_norm = false;
  options.pack = pack;
  options.resolution = resolution;
  Discriminator discriminator(options);
  const auto parameters = discriminator->named_parameters();
  const std::int64_t r = resolution;
  const torch::Tensor grid = Latent(3 * pack, r * r * r).view({3 * pack, 1, r, r, r});
  torch::Tensor x = grid.view({3, pack, r, r, r});
  int layer = 1;
  for (; x.size(2) > 2; ++layer) {
    const std::string name = std::to_string(layer);
    x = torch::leaky_relu(
        torch::conv3d(x, parameters["layer" + name + ".weight"], parameters["bias" + name], 2, 1),
        0.2);
  }
  x = torch::linear(x.flatten(1), parameters["layer" + std::to_string(layer) + ".weight"],
                    parameters["bias" + std::to_string(layer)])
          .squeeze(1);
  const torch::Tensor score = discriminator(grid);
  EXPECT_EQ(score.sizes(), (std::vector<std::int64_t>{3}));
  EXPECT_LT((score - x).abs().max().item<double>(), 1e-5 * (1 + x.abs().max().item<double>()));
}

TEST(Discriminator, EqualsThePlainLayers) { ExpectPlainLayers(1); }
TEST(Discriminator, EqualsThePlainLayersOnPackedShapes) { ExpectPlainLayers(4); }
TEST(Discriminator, EqualsThePlainLayersAtOtherResolutions) {
  ExpectPlainLayers(2, 16);
  ExpectPlainLayers(2, 64);
}

TEST(Networks, HaveOneLayerMoreForTwiceTheResolution) {
  ModelOptions options = TinyModel();
  options.block = Block::kResidual;
  for (const auto& [resolution, levels] : {std::pair(16, 2), std::pair(32, 3), std::pair(64, 4)}) {
    options.resolution = resolution;
    EXPECT_EQ(HiddenLevels(options), levels);
    Generator generator(options);
    const auto of = generator->named_parameters();
    EXPECT_EQ(of["project.weight"].size(0), 8 * (options.width << levels));
    EXPECT_EQ(of["last_weight"].size(0), options.width);
    EXPECT_TRUE(of.contains("refine" + std::to_string(levels) + "_weight"));
    EXPECT_FALSE(of.contains("refine" + std::to_string(levels + 1) + "_weight"));
    Discriminator discriminator(options);
    EXPECT_EQ(discriminator(generator(Latent(4, 5))).sizes(), (std::vector<std::int64_t>{4}));
  }
}

TEST(Discriminator, AddsTheDeviationOverAPackToEveryShapesFeatures) {
  ModelOptions options = TinyModel();
  options.spectral_norm = false;
  options.pack = 4;
  options.pack_at = PackAt::kFeatures;
  Discriminator discriminator(options);
  const auto parameters = discriminator->named_parameters();
  const auto layer = [&](const torch::Tensor& x, int i) {
    const std::string name = std::to_string(i);
    return torch::leaky_relu(
        torch::conv3d(x, parameters["layer" + name + ".weight"], parameters["bias" + name], 2, 1),
        0.2);
  };
  const torch::Tensor grid = Latent(8, 32 * 32 * 32).view({8, 1, 32, 32, 32});
  torch::Tensor x = layer(layer(layer(grid, 1), 2), 3);
  std::vector<torch::Tensor> deviations;
  for (const torch::Tensor& pack : x.split(4)) {
    deviations.push_back(pack.std(0, /*unbiased=*/false, /*keepdim=*/true).expand_as(pack));
  }
  x = layer(torch::cat({x, torch::cat(deviations)}, 1), 4);
  x = torch::linear(x.flatten(1), parameters["layer5.weight"], parameters["bias5"]).squeeze(1);
  const torch::Tensor score = discriminator(grid);
  EXPECT_EQ(score.sizes(), (std::vector<std::int64_t>{8}));
  EXPECT_LT((score - x).abs().max().item<double>(), 1e-4 * (1 + x.abs().max().item<double>()));
}

TEST(Discriminator, MayBeWiderThanTheGenerator) {
  ModelOptions options = TinyModel();
  options.width_d = 2 * options.width;
  Discriminator discriminator(options);
  EXPECT_EQ(discriminator->named_parameters()["layer1.weight"].size(0), 2 * options.width);
  EXPECT_EQ(discriminator(torch::zeros({3, 1, 32, 32, 32})).size(0), 3);
}

TEST(ResidualBlocks, BeginAsASmallChangeAndReachEveryParameter) {
  ModelOptions options = TinyModel();
  options.block = Block::kResidual;
  Generator generator(options);
  Discriminator discriminator(options);
  generator->train();
  discriminator->train();
  discriminator(generator(Latent(6, options.latent))).sum().backward();
  for (const auto& item : generator->named_parameters()) {
    ASSERT_TRUE(item.value().grad().defined()) << item.key();
    EXPECT_GT(item.value().grad().abs().max().item<double>(), 0.0) << item.key();
  }
  for (const auto& item : discriminator->named_parameters()) {
    ASSERT_TRUE(item.value().grad().defined()) << item.key();
  }
}

TEST(Discriminator, WithAnEdgeGainSeesTheSharpenedGrid) {
  ModelOptions model = TinyModel();
  Discriminator plain(model);
  model.edge_gain = 2.0;
  Discriminator sharpening(model);  // the same weights
  plain->eval();
  sharpening->eval();
  const torch::Tensor grid = Latent(4, 32 * 32 * 32).view({4, 1, 32, 32, 32});
  const torch::Tensor sharpened = Unfold(EmphasizeEdges(Fold(grid), 2.0));
  EXPECT_TRUE(torch::allclose(sharpening(grid), plain(sharpened)));
  EXPECT_FALSE(torch::allclose(sharpening(grid), plain(grid), 1e-3, 1e-3));
}

TEST(Discriminator, SeesIntoShapesAsFarAsItsDepth) {
  ModelOptions model = TinyModel();
  Discriminator plain(model);
  model.depth = 0.03;
  Discriminator shallow(model);  // the same weights
  plain->eval();
  shallow->eval();
  const torch::Tensor grid = Latent(4, 32 * 32 * 32).view({4, 1, 32, 32, 32});
  // 0.03 by a truncation of 0.1: a value of 0.3, or tanh(0.3).
  EXPECT_TRUE(torch::equal(shallow(grid), plain(grid.clamp_max(0.3))));
  EXPECT_FALSE(torch::allclose(shallow(grid), plain(grid), 1e-3, 1e-3));
  model.squash = Squash::kTanh;
  EXPECT_TRUE(torch::allclose(Discriminator(model)(grid),
                              Discriminator(TinyModel())(grid.clamp_max(std::tanh(0.3)))));
}

TEST(Networks, InBfloat16DifferFromFloatByItsRounding) {
  ModelOptions model = TinyModel();
  Generator exact(model);
  Discriminator exact_judge(model);
  model.precision = Precision::kBfloat16;
  Generator rounded(model);
  Discriminator rounded_judge(model);
  torch::Tensor z = Latent(4, model.latent);
  const torch::Tensor a = exact(z), b = rounded(z);
  EXPECT_EQ(b.scalar_type(), torch::kFloat);
  const double apart = (a - b).abs().max().item<double>();
  EXPECT_GT(apart, 0.0);
  EXPECT_LT(apart, 0.05);
  const auto gradient = [&](Discriminator& judge) {
    torch::Tensor input = a.detach().clone().requires_grad_();
    return torch::autograd::grad({judge(input).sum()}, {input})[0];
  };
  const torch::Tensor g = gradient(exact_judge), h = gradient(rounded_judge);
  // LibTorch 1.13 adds up in bfloat16 where the CPU has no kernel for it.
  EXPECT_GT((g * h).sum().item<double>(), 0.9 * g.norm().item<double>() * h.norm().item<double>());
}

TEST(Discriminator, SpectralNormBoundsItsSlope) {
  // Every layer has a stretch of at most 1 per patch; each node is in 2^3 patches of a strided
  // kernel of 4, so a convolution stretches by at most sqrt(8): four of them by 64.
  Discriminator discriminator(TinyModel());
  for (int i = 0; i < 50; ++i) {
    discriminator(torch::zeros({1, 1, 32, 32, 32}));
  }
  discriminator->eval();
  const torch::Tensor a = Latent(4, 32 * 32 * 32).view({4, 1, 32, 32, 32}), b = a.flip(0);
  const torch::Tensor change = (discriminator(a) - discriminator(b)).abs();
  EXPECT_TRUE((change <= 64.1 * (a - b).flatten(1).norm(2, 1)).all().item<bool>());
}

TEST(SdfValues, TruncationClampsAndComesBack) {
  ModelOptions options;
  options.truncation = 0.1;
  const torch::Tensor distances = torch::tensor({-0.7, -0.1, -0.05, 0.0, 0.025, 0.3});
  EXPECT_TRUE(torch::allclose(NetworkValues(distances, options),
                              torch::tensor({-1.0, -1.0, -0.5, 0.0, 0.25, 1.0})));
  EXPECT_TRUE(torch::allclose(Distances(NetworkValues(distances, options), options),
                              distances.clamp(-0.1, 0.1)));
}

TEST(SdfValues, TanhIsSmoothAndComesBackFurtherOut) {
  ModelOptions options;
  options.truncation = 0.1;
  options.squash = Squash::kTanh;
  EXPECT_NEAR(LargestDistance(options), 0.495, 0.001);
  const torch::Tensor distances = torch::tensor({-0.7, -0.3, -0.05, 0.0, 0.025, 0.3});
  const torch::Tensor values = NetworkValues(distances, options);
  EXPECT_TRUE(torch::allclose(values, torch::tanh(distances / 0.1)));
  EXPECT_TRUE(torch::allclose(Distances(values, options), distances.clamp_min(-0.49517), 1e-3));
}

TEST(SdfValues, RawDistancesAreScaled) {
  ModelOptions options;
  options.truncation = 0.0;
  options.raw_scale = 2.0;
  const torch::Tensor distances = torch::tensor({-0.7, 0.25});
  EXPECT_TRUE(torch::allclose(NetworkValues(distances, options), torch::tensor({-1.0, 0.5})));
  EXPECT_TRUE(
      torch::allclose(Distances(torch::tensor({-1.0, 0.5}), options), torch::tensor({-0.5, 0.25})));
}

TEST(ModelOptions, RefuseValuesOutOfRange) {
  ModelOptions options;
  OptionTable table;
  Bind(&table, &options);
  table.ApplyOverride("model.width=16");
  EXPECT_EQ(options.width, 16);
  EXPECT_THROW(table.ApplyOverride("model.width=0"), InputError);
  EXPECT_THROW(table.ApplyOverride("model.resolution=8"), InputError);
  EXPECT_THROW(table.ApplyOverride("model.resolution=256"), InputError);
  options.resolution = 48;
  EXPECT_THROW(CheckResolution(options, "x"), InputError);
  options.resolution = 64;
  EXPECT_NO_THROW(CheckResolution(options, "x"));
  EXPECT_THROW(table.ApplyOverride("model.truncation=-0.1"), InputError);
}

}  // namespace
}  // namespace antigrasp
