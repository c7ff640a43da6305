#include "antigrasp/models/solid_reach.h"

#include <gtest/gtest.h>
#include <torch/types.h>

#include <array>
#include <cmath>

namespace antigrasp {
namespace {

// One upright part without corners, edges or lean.
SolidForm Box(double u, double v, double w) {
  return {torch::eye(3).view({1, 1, 3, 3}), torch::tensor({u, v, w}, torch::kFloat).view({1, 1, 3}),
          torch::zeros({1, 1, 1}), torch::zeros({1, 1, 2}), torch::zeros({1, 1, 1})};
}

// Turns a form by `angle` about y: w leans towards x.
void LeanTowardsX(double angle, SolidForm* form) {
  const double c = std::cos(angle), s = std::sin(angle);
  form->axes =
      torch::tensor({c, 0.0, -s, 0.0, 1.0, 0.0, s, 0.0, c}, torch::kFloat).view({1, 1, 3, 3});
}

void ExpectReach(const SolidForm& form, const std::array<double, 3>& up,
                 const std::array<double, 3>& down) {
  const SolidReach reach = ReachOf(form);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(reach.up[0][0][i].item<double>(), up[i], 1e-6) << "up, axis " << i;
    EXPECT_NEAR(reach.down[0][0][i].item<double>(), down[i], 1e-6) << "down, axis " << i;
  }
}

void ExpectReach(const SolidForm& form, const std::array<double, 3>& both) {
  ExpectReach(form, both, both);
}

const double kDiagonal = std::sqrt(0.5);

TEST(SolidReach, OfABoxIsThatOfItsCorners) {
  SolidForm box = Box(0.3, 0.2, 0.1);
  ExpectReach(box, {0.3, 0.2, 0.1});
  LeanTowardsX(M_PI / 4, &box);
  ExpectReach(box, {0.4 * kDiagonal, 0.2, 0.4 * kDiagonal});
}

TEST(SolidReach, OfACylinderIsThatOfItsRims) {
  SolidForm cylinder = Box(0.1, 0.1, 0.3);
  cylinder.round.fill_(1.0);
  LeanTowardsX(M_PI / 4, &cylinder);
  ExpectReach(cylinder, {0.4 * kDiagonal, 0.1, 0.4 * kDiagonal});
  // About its own axis too: a box would reach 0.1 sqrt(2).
  SolidForm turned = Box(0.1, 0.1, 0.3);
  turned.round.fill_(1.0);
  turned.axes =
      torch::tensor({kDiagonal, kDiagonal, 0.0, -kDiagonal, kDiagonal, 0.0, 0.0, 0.0, 1.0},
                    torch::kFloat)
          .view({1, 1, 3, 3});
  ExpectReach(turned, {0.1, 0.1, 0.3});
}

TEST(SolidReach, RoundedCornersReachLess) {
  SolidForm prism = Box(0.3, 0.2, 0.1);
  prism.round.fill_(0.5);  // corners of radius 0.1
  prism.axes = torch::tensor({kDiagonal, kDiagonal, 0.0, -kDiagonal, kDiagonal, 0.0, 0.0, 0.0, 1.0},
                             torch::kFloat)
                   .view({1, 1, 3, 3});
  ExpectReach(prism, {0.3 * kDiagonal + 0.1, 0.3 * kDiagonal + 0.1, 0.1});
}

TEST(SolidReach, OfASphereIsItsRadiusHoweverItIsTurned) {
  SolidForm sphere = Box(0.3, 0.3, 0.3);
  sphere.round.fill_(1.0);
  sphere.fillet.fill_(0.3);
  LeanTowardsX(0.7, &sphere);
  ExpectReach(sphere, {0.3, 0.3, 0.3});
}

TEST(SolidReach, OfALyingConeIsItsTipUpAndItsRimDown) {
  SolidForm cone = Box(0.2, 0.2, 0.4);  // radius 0.4 below, 0 above
  cone.round.fill_(1.0);
  cone.slope.fill_(-0.5);
  ExpectReach(cone, {0.4, 0.4, 0.4});
  LeanTowardsX(M_PI / 2, &cone);
  ExpectReach(cone, {0.4, 0.4, 0.4});
  LeanTowardsX(M_PI / 4, &cone);  // the tip; the rim's far side, and upwards its near side
  ExpectReach(cone, {0.4 * kDiagonal, 0.4, 0.4 * kDiagonal},
              {0.8 * kDiagonal, 0.4, 0.8 * kDiagonal});
}

}  // namespace
}  // namespace antigrasp
