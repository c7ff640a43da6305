#include "antigrasp/models/turned_field.h"

#include <gtest/gtest.h>
#include <torch/autograd.h>
#include <torch/types.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <vector>

#include "antigrasp/core/pieces.h"
#include "antigrasp/models/random_tensor.h"

namespace antigrasp {
namespace {

torch::Tensor Outline(const std::vector<float>& radius_and_z) {
  return torch::tensor(radius_and_z).view({1, -1, 2});
}

// Compares with distances, positive inside, at the nodes (distance from the axis, z) for which
// `where` holds.
void ExpectDistances(
    const torch::Tensor& outline, const std::function<double(double, double)>& expected,
    const std::function<bool(double, double)>& where = [](double, double) { return true; }) {
  const torch::Tensor field = TurnedField(outline, 16);
  const auto values = field.accessor<float, 5>();
  int compared = 0;
  for (int z = 0; z < 16; ++z) {
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 16; ++x) {
        const double radius = std::hypot((x + 0.5) / 16 - 0.5, (y + 0.5) / 16 - 0.5);
        const double height = (z + 0.5) / 16 - 0.5;
        if (!where(radius, height)) continue;
        ++compared;
        ASSERT_NEAR(values[0][0][z][y][x], expected(radius, height), 2e-6) << radius << " " << z;
      }
    }
  }
  EXPECT_GT(compared, 100);
}

// Random frusta on a hollow base, as training meets them: nothing about them is alike.
torch::Tensor RandomOutlines(std::int64_t n) {
  RngStream rng(4, "turned_field_test");
  torch::Tensor outlines = torch::empty({n, 7, 2});
  for (std::int64_t i = 0; i < n; ++i) {
    double z = rng.Uniform(-0.4, -0.3);
    outlines[i][0] = torch::tensor({0.0, z + rng.Uniform(0.05, 0.2)});
    for (int k = 1; k < 6; ++k) {
      outlines[i][k] = torch::tensor({rng.Uniform(0.1, 0.4), z});
      z += rng.Uniform(0.08, 0.16);
    }
    outlines[i][6] = torch::tensor({0.0, z});
  }
  return outlines;
}

TEST(TurnedField, ACylinderHasItsExactDistancesInsideAndOutside) {
  ExpectDistances(Outline({0.0, -0.2, 0.3, -0.2, 0.3, 0.1, 0.0, 0.1}), [](double radius, double z) {
    const double wall = radius - 0.3, end = std::abs(z + 0.05) - 0.15;
    return -(std::hypot(std::max(wall, 0.0), std::max(end, 0.0)) +
             std::min(std::max(wall, end), 0.0));
  });
}

TEST(TurnedField, OfWhatRisesInsideARingTheFloorIsMissing) {
  // From the middle at z = 0.1 down at 45 degrees to the ground; nodes below that slope, whose
  // nearest place is on it, are outside by (0.1 - z - radius) / sqrt(2).
  ExpectDistances(
      Outline({0.0, 0.1, 0.4, -0.3, 0.45, -0.3, 0.45, 0.4, 0.0, 0.4}),
      [](double radius, double z) { return -(0.1 - z - radius) / std::sqrt(2.0); },
      [](double radius, double z) { return z > -0.3 && 0.1 - z - radius > 0.0; });
}

TEST(TurnedField, IsTheSameFromAllSides) {
  const torch::Tensor field = TurnedField(RandomOutlines(3), 16);
  EXPECT_TRUE(torch::equal(field, field.transpose(3, 4)));
  EXPECT_TRUE(torch::equal(field, field.flip({3})));
  EXPECT_TRUE(torch::equal(field, field.flip({4})));
  EXPECT_FALSE(torch::equal(field, field.flip({2})));
}

TEST(TurnedField, EqualsTheOperationsOfTheLibraryAndTheirGradients) {
  torch::Tensor outlines = RandomOutlines(3);
  torch::Tensor exact = outlines.to(torch::kDouble);
  outlines.set_requires_grad(true);
  exact.set_requires_grad(true);
  const torch::Tensor field = TurnedField(outlines, 32), expected = TurnedField(exact, 32);
  EXPECT_LT((field - expected).abs().max().item<double>(), 1e-6);
  RngStream rng(5, "turned_field_test");
  const torch::Tensor weight = NormalTensor(field.sizes(), 1.0, &rng);
  const auto actual = torch::autograd::grad({(field * weight).sum()}, {outlines})[0];
  const auto right = torch::autograd::grad({(expected * weight).sum()}, {exact})[0];
  EXPECT_GT(right.abs().max().item<double>(), 1.0);
  EXPECT_LT((actual - right).abs().max().item<double>(), 2e-3 * right.abs().max().item<double>());
}

TEST(TurnedField, AWallMovedOutwardRaisesAllItsNodesByAsMuch) {
  torch::Tensor outline = Outline({0.0, -0.45, 0.2, -0.45, 0.2, 0.45, 0.0, 0.45});
  outline.set_requires_grad(true);
  // The layers about z = 0, whose nearest place is the wall but for nodes at the middle.
  const torch::Tensor layers = TurnedField(outline, 16).narrow(2, 7, 2);
  const torch::Tensor gradient = torch::autograd::grad({layers.sum()}, {outline})[0][0];
  EXPECT_NEAR((gradient[1][0] + gradient[2][0]).item<double>(), 2.0 * 256.0, 1e-2);
  EXPECT_NEAR(gradient.select(1, 1).abs().max().item<double>(), 0.0, 1e-3);
}

TEST(TurnedField, BitsDoNotDependOnTheNumberOfThreads) {
  torch::Tensor outlines = RandomOutlines(5);
  outlines.set_requires_grad(true);
  const int before = PieceThreads();
  std::vector<torch::Tensor> fields, gradients;
  for (const int threads : {1, 3}) {
    SetPieceThreads(threads);
    fields.push_back(TurnedField(outlines, 16));
    gradients.push_back(torch::autograd::grad({fields.back().square().sum()}, {outlines})[0]);
  }
  SetPieceThreads(before);
  EXPECT_TRUE(torch::equal(fields[0], fields[1]));
  EXPECT_TRUE(torch::equal(gradients[0], gradients[1]));
}

TEST(TurnedField, PiecesWithoutLengthChangeNothing) {
  torch::Tensor outline = Outline({0.0, -0.2, 0.3, -0.2, 0.3, -0.2, 0.3, -0.2, 0.2, 0.3, 0.0, 0.3});
  EXPECT_TRUE(torch::equal(TurnedField(outline, 16),
                           TurnedField(Outline({0.0, -0.2, 0.3, -0.2, 0.2, 0.3, 0.0, 0.3}), 16)));
  outline.set_requires_grad(true);
  const auto gradient = torch::autograd::grad({TurnedField(outline, 16).sum()}, {outline})[0];
  EXPECT_TRUE(torch::isfinite(gradient).all().item<bool>());
}

TEST(TurnedField, RefusesAPointAloneAndBrokenRows) {
  EXPECT_THROW(TurnedField(torch::zeros({1, 1, 2}), 16), std::logic_error);
  EXPECT_THROW(TurnedField(torch::zeros({1, 4, 3}), 16), std::logic_error);
  EXPECT_THROW(TurnedField(torch::zeros({1, 4, 2}), 24), std::logic_error);
}

}  // namespace
}  // namespace antigrasp
