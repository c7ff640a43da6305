#include "antigrasp/models/solid_field.h"

#include <gtest/gtest.h>
#include <torch/autograd.h>
#include <torch/types.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <vector>

#include "antigrasp/core/pieces.h"
#include "antigrasp/models/random_tensor.h"

namespace antigrasp {
namespace {

using Point = std::array<double, 3>;

// An upright box of these half sizes about the centre of the cube.
torch::Tensor Part(double u, double v, double w) {
  torch::Tensor part = torch::zeros({1, 1, kPartColumns});
  for (int axis = 0; axis < 3; ++axis) part[0][0][kPartAxes + 4 * axis] = 1.0;
  part[0][0][kPartHalf] = u;
  part[0][0][kPartHalf + 1] = v;
  part[0][0][kPartHalf + 2] = w;
  part[0][0][kPartNarrow] = 1.0;
  return part;
}

void Set(torch::Tensor* part, int column, double value) { (*part)[0][0][column] = value; }

// Compares with distances, positive inside, at the nodes for which `where` holds.
void ExpectDistances(
    const torch::Tensor& parts, const std::function<double(const Point&)>& expected,
    const std::function<bool(const Point&)>& where = [](const Point&) { return true; }) {
  const torch::Tensor field = SolidField(parts, 16);
  const auto values = field.accessor<float, 5>();
  int compared = 0;
  for (int z = 0; z < 16; ++z) {
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 16; ++x) {
        const Point p = {(x + 0.5) / 16 - 0.5, (y + 0.5) / 16 - 0.5, (z + 0.5) / 16 - 0.5};
        if (!where(p)) continue;
        ++compared;
        ASSERT_NEAR(values[0][0][z][y][x], expected(p), 2e-6) << p[0] << " " << p[1] << " " << p[2];
      }
    }
  }
  EXPECT_GT(compared, 100);
}

// Of a box about `centre`: to its nearest wall inside, to its wall, edge or corner outside.
double BoxDistance(const Point& p, const Point& centre, const Point& half) {
  double squares = 0.0, nearest = -10.0;
  for (int i = 0; i < 3; ++i) {
    const double beyond = std::abs(p[i] - centre[i]) - half[i];
    squares += std::pow(std::max(beyond, 0.0), 2);
    nearest = std::max(nearest, beyond);
  }
  return -(std::sqrt(squares) + std::min(nearest, 0.0));
}

// Random parts of every form, usable ones: axes are those of a random matrix.
torch::Tensor RandomParts(std::int64_t n, std::int64_t m) {
  RngStream rng(4, "solid_field_test");
  torch::Tensor parts = torch::empty({n, m, kPartColumns});
  for (std::int64_t i = 0; i < n * m; ++i) {
    torch::Tensor part = parts.view({n * m, kPartColumns})[i];
    const torch::Tensor axes =
        std::get<0>(torch::linalg_qr(NormalTensor({3, 3}, 1.0, &rng), "reduced"));
    part.narrow(0, kPartAxes, 9).copy_(axes.flatten());
    for (int c = kPartCentre; c < kPartHalf; ++c) part[c] = rng.Uniform(-0.2, 0.2);
    for (int c = kPartHalf; c < kPartRound; ++c) part[c] = rng.Uniform(0.05, 0.3);
    part[kPartRound] = rng.Uniform(0.1, 0.9);
    for (int c = kPartLean; c < kPartFillet; ++c) part[c] = rng.Uniform(-0.15, 0.15);
    part[kPartFillet] = rng.Uniform(0.005, 0.02);
    part[kPartNarrow] = rng.Uniform(0.9, 1.0);
  }
  return parts;
}

TEST(SolidField, ABoxHasItsExactDistancesInsideAndOutside) {
  torch::Tensor box = Part(0.25, 0.2, 0.1);
  Set(&box, kPartCentre, 0.05);
  Set(&box, kPartCentre + 2, -0.1);
  ExpectDistances(box, [](const Point& p) {
    return BoxDistance(p, {0.05, 0.0, -0.1}, {0.25, 0.2, 0.1});
  });
}

TEST(SolidField, RowsOfTheAxesAreThoseOfThePart) {
  torch::Tensor box = Part(0.3, 0.2, 0.1);  // u along y, v along z, w along x
  for (int c = 0; c < 9; ++c) Set(&box, kPartAxes + c, c == 1 || c == 5 || c == 6 ? 1.0 : 0.0);
  Set(&box, kPartCentre, 0.1);  // along u: y
  ExpectDistances(box, [](const Point& p) {
    return BoxDistance(p, {0.0, 0.1, 0.0}, {0.1, 0.3, 0.2});
  });
}

TEST(SolidField, RoundCornersAsLargeAsTheSectionMakeACylinder) {
  torch::Tensor cylinder = Part(0.2, 0.2, 0.3);
  Set(&cylinder, kPartRound, 1.0);
  ExpectDistances(cylinder, [](const Point& p) {
    const double wall = std::hypot(p[0], p[1]) - 0.2, end = std::abs(p[2]) - 0.3;
    return -(std::hypot(std::max(wall, 0.0), std::max(end, 0.0)) +
             std::min(std::max(wall, end), 0.0));
  });
}

TEST(SolidField, AFilletAsLargeAsACylinderMakesASphere) {
  torch::Tensor sphere = Part(0.3, 0.3, 0.3);
  Set(&sphere, kPartRound, 1.0);
  Set(&sphere, kPartFillet, 0.3);
  ExpectDistances(sphere,
                  [](const Point& p) { return 0.3 - std::hypot(std::hypot(p[0], p[1]), p[2]); });
}

TEST(SolidField, LeaningRoundWallsAreACone) {
  torch::Tensor cone = Part(0.2, 0.2, 0.4);  // radius 0.2 - w / 2: 0.4 below, 0 above
  Set(&cone, kPartRound, 1.0);
  Set(&cone, kPartLean, -0.5);
  Set(&cone, kPartLean + 1, -0.5);
  Set(&cone, kPartNarrow, 2.0 / std::sqrt(5.0));
  ExpectDistances(
      cone,
      [](const Point& p) {
        return -(std::hypot(p[0], p[1]) - 0.2 + 0.5 * p[2]) * 2.0 / std::sqrt(5.0);
      },
      [](const Point& p) {  // nodes whose nearest place is the wall
        return std::abs(p[2]) < 0.25 && std::abs(std::hypot(p[0], p[1]) - 0.2 + 0.5 * p[2]) < 0.1;
      });
}

TEST(SolidField, AUnionIsTheLargestOfItsParts) {
  torch::Tensor a = Part(0.1, 0.3, 0.1), b = Part(0.3, 0.1, 0.1);
  Set(&b, kPartCentre, 0.1);
  const torch::Tensor both = SolidField(torch::cat({a, b}, 1), 16);
  EXPECT_TRUE(torch::equal(both, torch::maximum(SolidField(a, 16), SolidField(b, 16))));
}

TEST(SolidField, OnlyTheNearestPartHasAGradient) {
  torch::Tensor parts = torch::cat({Part(0.3, 0.3, 0.3), Part(0.1, 0.1, 0.1)}, 1);
  parts.set_requires_grad(true);  // the second is deep inside of the first
  const torch::Tensor gradient = torch::autograd::grad({SolidField(parts, 16).sum()}, {parts})[0];
  EXPECT_GT(gradient[0][0].abs().sum().item<double>(), 1.0);
  EXPECT_EQ(gradient[0][1].abs().sum().item<double>(), 0.0);
}

TEST(SolidField, EqualsTheOperationsOfTheLibraryAndTheirGradients) {
  torch::Tensor parts = RandomParts(3, 4);
  torch::Tensor exact = parts.to(torch::kDouble);
  parts.set_requires_grad(true);
  exact.set_requires_grad(true);
  const torch::Tensor field = SolidField(parts, 32), expected = SolidField(exact, 32);
  EXPECT_LT((field - expected).abs().max().item<double>(), 1e-6);
  RngStream rng(5, "solid_field_test");
  const torch::Tensor weight = NormalTensor(field.sizes(), 1.0, &rng);
  const auto actual = torch::autograd::grad({(field * weight).sum()}, {parts})[0];
  const auto right = torch::autograd::grad({(expected * weight).sum()}, {exact})[0];
  for (int c = 0; c < kPartColumns; ++c) {
    EXPECT_LT((actual - right).select(2, c).abs().max().item<double>(),
              2e-3 * right.select(2, c).abs().max().item<double>())
        << "column " << c;
  }
}

TEST(SolidField, BitsDoNotDependOnTheNumberOfThreads) {
  torch::Tensor parts = RandomParts(5, 3);
  parts.set_requires_grad(true);
  const int before = PieceThreads();
  std::vector<torch::Tensor> fields, gradients;
  for (const int threads : {1, 3}) {
    SetPieceThreads(threads);
    fields.push_back(SolidField(parts, 16));
    gradients.push_back(torch::autograd::grad({fields.back().square().sum()}, {parts})[0]);
  }
  SetPieceThreads(before);
  EXPECT_TRUE(torch::equal(fields[0], fields[1]));
  EXPECT_TRUE(torch::equal(gradients[0], gradients[1]));
}

TEST(SolidField, RefusesMorePartsThanItCountsAndBrokenRows) {
  EXPECT_THROW(SolidField(torch::zeros({1, 33, kPartColumns}), 16), std::logic_error);
  EXPECT_THROW(SolidField(torch::zeros({1, 1, kPartColumns}), 24), std::logic_error);
}

}  // namespace
}  // namespace antigrasp
