#include "antigrasp/report/figures/trial_figure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

#include "antigrasp/core/atomic_file.h"
#include "tests/report/figures/pixels.h"
#include "tests/support/well_formed.h"

namespace antigrasp {
namespace {

using pixels::FindColor;
using pixels::Spot;
using shapes::TempFolder;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kScale = 4.0;  // pixels a point
const MeanInterval kNone = {kNan, kNan, 0};
constexpr Color kOrange = {0.80, 0.36, 0.05};

// A page of 360 points: beside one plot over load the one over friction reaches from 36 to 36 + 1.3
// x 274 / 2.3, the other one from there + 42 over 274 / 2.3; both from 178 up by 150 points.
constexpr double kLoadWidth = 274.0 / 2.3, kFrictionWidth = 1.3 * kLoadWidth;
constexpr double kLoadLeft = 36.0 + kFrictionWidth + 42.0;

Image Drawn(const TrialFigure& figure) {
  const TempFolder folder;
  FigureOptions options;
  options.width_mm = 127.0;
  options.dpi = 72.0 * kScale;
  WriteTrialFigure(folder / "f.png", figure, options);
  return ReadPng(folder / "f.png");
}

// Where the percentage stands, points from the top.
double Up(double percent) { return 178.0 - 1.5 * percent; }
double AtFriction(double friction, double high) { return 36.0 + kFrictionWidth * friction / high; }
double AtLoad(double place) { return kLoadLeft + kLoadWidth * (place + 0.3) / 2.6; }

// What is of the colour within `x` and `y` points of a place.
Spot About(const Image& image, const Place& at, double x, double y, const Color& color) {
  return FindColor(
      image, {kScale * (at.x - x), kScale * (at.y - y), kScale * 2.0 * x, kScale * 2.0 * y}, color);
}

void ExpectDot(const Image& image, const Place& at, const Color& color) {
  const Spot spot = About(image, at, 8.0, 8.0, color);
  ASSERT_GT(spot.count, 50) << at.x << ' ' << at.y;
  EXPECT_NEAR(0.5 * (spot.left + spot.right + 1), kScale * at.x, 1.0);
  EXPECT_NEAR(0.5 * (spot.top + spot.bottom + 1), kScale * at.y, 1.0);
}

Color OnWhite(const Color& color, double share) {
  const auto mixed = [share](double c) { return 1.0 - share * (1.0 - c); };
  return {mixed(color.r), mixed(color.g), mixed(color.b)};
}

TEST(TrialFigure, OneFrictionAloneIsAPointWithItsInterval) {
  const Image image = Drawn({{{"own mass", 0.5, "1 g", {40.0, 12.0, 9}, kNone}}, "judge"});
  const Place at{AtFriction(0.5, 0.6), Up(40.0)};
  ExpectDot(image, at, kMark);
  const Spot bar = About(image, at, 1.0, 40.0, OnWhite(kMark, 0.6));
  EXPECT_NEAR(bar.top, kScale * Up(52.0), 3.0);
  EXPECT_NEAR(bar.bottom, kScale * Up(28.0), 3.0);
}

TEST(TrialFigure, AnIntervalEndsWhereThePlotDoes) {
  const Image image = Drawn({{{"own mass", 0.5, "1 g", {98.0, 12.0, 9}, kNone}}, ""});
  const Spot bar = About(image, {AtFriction(0.5, 0.6), Up(98.0)}, 1.0, 24.0, OnWhite(kMark, 0.6));
  EXPECT_NEAR(bar.top, kScale * Up(100.0), 3.0);
  EXPECT_NEAR(bar.bottom, kScale * Up(86.0), 3.0);
}

TEST(TrialFigure, AfterAChangeIsFullAndBeforeItIsDashedInTheColourOfItsMass) {
  TrialFigure figure;
  for (const double friction : {0.25, 0.5}) {
    figure.sets.push_back({"own mass", friction, "1 g", {30.0, kNan, 9}, {90.0, kNan, 9}});
  }
  const Image image = Drawn(figure);
  for (const double friction : {0.25, 0.5}) {
    // A dot and a ring, 3.5 points beside each other.
    const Place dot{AtFriction(friction, 0.6) + 1.75, Up(30.0)};
    EXPECT_GT(About(image, dot, 0.5, 1.5, kMark).count, 35);
    const Place ring{AtFriction(friction, 0.6) - 1.75, Up(90.0)};
    EXPECT_GE(About(image, ring, 0.5, 0.5, {1.0, 1.0, 1.0}).count, 9);
    EXPECT_GT(About(image, ring, 2.5, 2.5, kMark).count, 20);
  }
  const Place middle{AtFriction(0.375, 0.6), 0.0};
  const double length = kScale * 2.0 * 25.0;  // pixels, at least three rows of a line of 1.2 points
  const auto inked = [&](double percent) {
    return About(image, {middle.x, Up(percent)}, 25.0, 0.25, kMark).count / (2.0 * length);
  };
  EXPECT_GT(inked(30.0), 0.95);
  EXPECT_GT(inked(90.0), 0.4);
  EXPECT_LT(inked(90.0), 0.8);
}

TEST(TrialFigure, OwnAndEqualMassAreToldApartByColour) {
  TrialFigure figure;
  figure.sets = {{"own mass", 0.5, "1 g", {30.0, kNan, 9}, kNone},
                 {"equal mass", 0.5, "1 g", {70.0, kNan, 9}, kNone}};
  const Image image = Drawn(figure);
  // Two plots over load: 36 + 20 + 32 + 8 points are beside the three.
  const double width = 1.3 * (360.0 - 96.0) / 3.3, x = 36.0 + width * 0.5 / 0.6;
  ExpectDot(image, {x - 1.75, Up(30.0)}, kMark);
  ExpectDot(image, {x + 1.75, Up(70.0)}, kOrange);
}

TEST(TrialFigure, LoadsStandBesideEachOtherAndTheLowestFrictionIsLightest) {
  TrialFigure figure;
  const double held[2][3] = {{90.0, 60.0, 30.0}, {70.0, 40.0, 10.0}};  // at 0.5, at 0.25
  for (int f = 0; f < 2; ++f) {
    const char* loads[] = {"1 g", "3 g", "8 g"};
    for (int k = 0; k < 3; ++k) {
      figure.sets.push_back(
          {"own mass", f == 0 ? 0.5 : 0.25, loads[k], {held[f][k], kNan, 9}, kNone});
    }
  }
  const Image image = Drawn(figure);
  for (int k = 0; k < 3; ++k) {
    const Color dark = DegreeColor(1.0), light = DegreeColor(0.0);
    for (const auto& [percent, color] : {std::pair(held[0][k], dark), {held[1][k], light}}) {
      const Spot spot = About(image, {AtLoad(k), Up(percent)}, 0.5, 0.5, color);
      EXPECT_GE(spot.count, 16) << percent;
    }
  }
}

TEST(TrialFigure, IsWellFormedWithAnyNamesAndTheSameBytesTwice) {
  const TempFolder folder;
  const TrialFigure figure = {{{"<own> & \xff", 0.0, "a \"load\"", {0.0, 0.0, 1}, kNone}}, "<&>"};
  WriteTrialFigure(folder / "a.svg", figure, {});
  WriteTrialFigure(folder / "b.svg", figure, {});
  EXPECT_EQ(ReadFile(folder / "a.svg"), ReadFile(folder / "b.svg"));
  EXPECT_EQ(shapes::WhyNotWellFormed(ReadFile(folder / "a.svg")), "");
}

}  // namespace
}  // namespace antigrasp
