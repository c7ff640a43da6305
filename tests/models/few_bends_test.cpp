#include "antigrasp/models/few_bends.h"

#include <ATen/ATen.h>
#include <ATen/Parallel.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "antigrasp/core/rng.h"

namespace antigrasp {
namespace {

constexpr std::int64_t kNodes = 16;

using Field = std::function<double(double x, double y, double z)>;

// Distances in cells about the middle of a grid of 16^3, with errors of this deviation.
at::Tensor GridOfField(const Field& field, double error = 0.0) {
  RngStream rng(1, "test");
  at::Tensor grid = at::empty({1, 1, kNodes, kNodes, kNodes});
  auto* value = grid.data_ptr<float>();
  for (std::int64_t z = 0; z < kNodes; ++z) {
    for (std::int64_t y = 0; y < kNodes; ++y) {
      for (std::int64_t x = 0; x < kNodes; ++x) {
        const double at = field(double(x) - 7.5, double(y) - 7.5, double(z) - 7.5);
        *value++ = static_cast<float>(at + error * rng.Normal());
      }
    }
  }
  return grid;
}

double Tilted(double x, double y, double z) { return (2.0 * x - y + 2.0 * z) / 3.0; }
// The ridge of two planes, outside of one of which one is outside.
double Roof(double x, double y, double z) {
  return std::min((3.0 * x + 4.0 * y) / 5.0, (3.0 * x - 4.0 * z) / 5.0);
}

// Largest distance between the two where the surface is near.
double LargestMove(const at::Tensor& a, const at::Tensor& b, double within) {
  return (a - b).abs().masked_select(a.abs() < within).max().item<double>();
}

// Mean square of a second difference along x near the surface.
double Bends(const at::Tensor& grid) {
  const at::Tensor bend =
      grid.slice(4, 0, kNodes - 2) - 2.0 * grid.slice(4, 1, kNodes - 1) + grid.slice(4, 2, kNodes);
  const at::Tensor near = grid.slice(4, 1, kNodes - 1).abs() < 1.0;
  return bend.square().masked_select(near).mean().item<double>();
}

TEST(WithFewBends, LeavesPlanesAndCreasesOfPlanesWhereTheyAre) {
  const at::Tensor plane = GridOfField(Tilted);
  EXPECT_LT(LargestMove(plane, WithFewBends(plane, {}), 5.0), 1e-4);
  const at::Tensor roof = GridOfField(Roof);
  const at::Tensor faired = WithFewBends(roof, {});
  EXPECT_LT(LargestMove(roof, faired, 1.0), 0.15);  // at the ridge, between nodes
  EXPECT_GT(Bends(faired), 0.7 * Bends(roof));      // which is no rounder
}

TEST(WithFewBends, TakesErrorsOffAPlane) {
  const at::Tensor plane = GridOfField(Tilted), noisy = GridOfField(Tilted, 0.05);
  const at::Tensor faired = WithFewBends(noisy, {.weight = 2.0});
  EXPECT_LT(Bends(faired), 1e-3 * Bends(noisy));
  EXPECT_LT(LargestMove(faired, plane, 1.0), 0.03);  // of errors up to .2
}

// A huge weight leaves no bend at all: every shape becomes a plane.
TEST(WithFewBends, OfAHugeWeightHasNone) {
  const at::Tensor noisy = GridOfField(Tilted, 0.05);
  EXPECT_LT(Bends(WithFewBends(noisy, {.weight = 1e6, .power = 1.0, .iterations = 200})), 1e-9);
}

TEST(WithFewBends, ChangesNothingFarFromTheSurfaceNorWithoutWeight) {
  const at::Tensor noisy = GridOfField(Tilted, 0.05);
  const at::Tensor far = noisy.abs() >= 2.0;
  const at::Tensor faired = WithFewBends(noisy, {.weight = 2.0});
  EXPECT_TRUE(at::equal(faired.masked_select(far), noisy.masked_select(far)));
  EXPECT_TRUE(at::equal(WithFewBends(noisy, {.weight = 0.0}), noisy));
}

TEST(WithFewBends, HasTheSameBytesForAnyThreadsAndCompany) {
  const at::Tensor a = GridOfField(Tilted, 0.05), b = GridOfField(Roof, 0.05);
  const at::Tensor both = at::cat({a, b, a, b});
  at::set_num_threads(1);
  const at::Tensor one = WithFewBends(both, {});
  at::set_num_threads(3);
  const at::Tensor three = WithFewBends(both, {});
  at::set_num_threads(1);
  EXPECT_TRUE(at::equal(one, three));
  EXPECT_TRUE(at::equal(one.slice(0, 1, 2), WithFewBends(b, {})));
}

}  // namespace
}  // namespace antigrasp
