#pragma once

#include <array>

// The scene of every self-check: two boxes, each pinched along x by two balls at 1 N, friction 1.
// A box weighs 0.294 N, so it takes a friction of 0.147 to hold it. Metres, kilograms.
namespace antigrasp {

struct PinchedBox {
  const char* name;
  double y;
  double friction;
};

inline constexpr std::array<PinchedBox, 2> kPinchedBoxes{
    {{"falls", -0.1, 0.14}, {"stays", 0.1, 0.16}}};

inline constexpr double kPinchHeight = 0.3;
inline constexpr double kBoxSide = 0.04, kBoxMass = 0.03;
inline constexpr double kBallRadius = 0.005, kBallMass = 0.05;
inline constexpr double kBallAside = 0.5 * kBoxSide + kBallRadius;  // of the middle of the box
// A soft spring whose rest is a metre away: 1 N, and no actuator to be set.
inline constexpr double kSpring = 1.0, kSpringRest = 1.0;
inline constexpr double kBoxInertia = kBoxMass * kBoxSide * kBoxSide / 6.0;
inline constexpr double kBallInertia = 0.4 * kBallMass * kBallRadius * kBallRadius;

}  // namespace antigrasp
