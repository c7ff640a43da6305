#include "antigrasp/report/figures/color.h"

#include <algorithm>
#include <cmath>

namespace antigrasp {
namespace {

constexpr Color kNoNumber = {0.6, 0.6, 0.6};
constexpr Color kRed = {0.84, 0.10, 0.10}, kGreen = {0.10, 0.62, 0.20};
constexpr Color kOutside = {0.13, 0.33, 0.62}, kSurface = {0.97, 0.97, 0.97};
constexpr Color kInside = {0.80, 0.36, 0.05};
constexpr Color kLight = {0.58, 0.76, 0.93}, kDark = {0.04, 0.16, 0.38};

Color Mix(const Color& from, const Color& to, double share) {
  const auto mix = [share](double a, double b) { return a + share * (b - a); };
  return {mix(from.r, to.r), mix(from.g, to.g), mix(from.b, to.b), mix(from.a, to.a)};
}

}  // namespace

Color ReliabilityColor(double share) {
  return std::isnan(share) ? kNoNumber : Mix(kRed, kGreen, std::clamp(share, 0.0, 1.0));
}

Color SignedColor(double share) {
  if (std::isnan(share)) return kNoNumber;
  const double cut = std::clamp(share, -1.0, 1.0);
  return Mix(kSurface, cut < 0.0 ? kOutside : kInside, std::abs(cut));
}

Color DegreeColor(double share) {
  return std::isnan(share) ? kNoNumber : Mix(kLight, kDark, std::clamp(share, 0.0, 1.0));
}

}  // namespace antigrasp
