// The families' ranges, read back from the outlines: every parameter reaches both ends of its range
// and nothing beyond.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "antigrasp/datasets/bottle.h"

namespace antigrasp {
namespace {

using Eigen::Vector2d;

// Where the outline's curves end, by number of points: 16 a curve, 32 for the body's wall.
enum Corner : std::size_t {
  kHollow = 0,
  kFoot = 16,
  kFilletStart = 17,
  kFilletEnd = 33,
  kBodyMiddle = 49,
  kBodyTop = 65,
  kShoulderTop = 81,
  kNeckTop = 82,
  kCapRim = 83,
  kCapWall = 84,
  kCapEdge = 100,
  kTop = 101
};

// The outline standing on the ground: heights from 0.
std::vector<Vector2d> Standing(int family, std::uint64_t seed) {
  RngStream rng(seed, "bottle-test");
  std::vector<Vector2d> outline = SampleBottle(family, rng).outline;
  EXPECT_EQ(outline.size(), kTop + 1U);
  const double ground = outline[kFoot].y();
  for (Vector2d& p : outline) p.y() -= ground;
  return outline;
}

struct Spread {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void Add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

struct Parameters {
  Spread height, body_radius, body, shoulder, cap, neck_radius, cap_radius, waist, dimple, fillet;
  Spread pull, cap_fillet;
};

void AddTo(Parameters* p, const std::vector<Vector2d>& o) {
  const double height = o[kTop].y(), radius = o[kFilletEnd].x(), neck = o[kNeckTop].x();
  const double body_top = o[kBodyTop].y(), cap_bottom = o[kCapRim].y();
  p->height.Add(height);
  p->body_radius.Add(radius);
  p->body.Add(body_top / height);
  p->cap.Add((height - cap_bottom) / height);
  p->neck_radius.Add(neck / radius);
  p->cap_radius.Add(o[kCapRim].x() / neck);
  p->waist.Add(1 - o[kBodyMiddle].x() / radius);
  p->dimple.Add(o[kHollow].y() / height);
  // A long shoulder ends at the cap, a large rounding before the wall or the axis does.
  const double shoulder = o[kShoulderTop].y() - body_top, fillet = o[kFilletEnd].y();
  if (o[kShoulderTop].y() < cap_bottom - 1e-12) p->shoulder.Add(shoulder / height);
  if (fillet < 0.8 * body_top - 1e-12) p->fillet.Add(fillet / radius);
  const double edge = height - o[kCapWall].y();
  if (edge < 0.5 * o[kCapRim].x() - 1e-12) p->cap_fillet.Add(edge / (height - cap_bottom));
  // A quarter of the way along the cubic from `pull` above the bottom to `pull` below the top:
  // 27/64 pull + 9/64 (1 - pull) + 1/64.
  const double quarter = (o[kBodyTop + 4].y() - body_top) / shoulder;
  p->pull.Add((quarter - 10.0 / 64) / (18.0 / 64));
}

Parameters Of(int family) {
  Parameters parameters;
  for (std::uint64_t seed = 0; seed < 1500; ++seed) AddTo(&parameters, Standing(family, seed));
  return parameters;
}

// Of 1,500 draws the outermost are within a hundredth of the range of its ends, all but certainly.
void ExpectRange(const Spread& found, double low, double high, const char* what) {
  const double near = 0.01 * (high - low);
  EXPECT_GE(found.low, low - 1e-9) << what;
  EXPECT_LE(found.low, low + near + 1e-9) << what;
  EXPECT_LE(found.high, high + 1e-9) << what;
  EXPECT_GE(found.high, high - near - 1e-9) << what;
}

void ExpectCommon(const Parameters& p) {
  ExpectRange(p.pull, 0.35, 0.65, "pull");
  ExpectRange(p.cap_fillet, 0.3, 0.5, "cap fillet");
}

TEST(BottleFamily, WineKeepsItsRanges) {
  const Parameters p = Of(0);
  ExpectRange(p.height, 0.93, 1.0, "height");
  ExpectRange(p.body_radius, 0.145, 0.18, "body radius");
  ExpectRange(p.body, 0.50, 0.60, "body");
  ExpectRange(p.shoulder, 0.12, 0.18, "shoulder");
  ExpectRange(p.cap, 0.075, 0.105, "cap");
  ExpectRange(p.neck_radius, 0.36, 0.44, "neck radius");
  ExpectRange(p.cap_radius, 1.12, 1.30, "cap radius");
  ExpectRange(p.waist, 0.0, 0.0, "waist");
  ExpectRange(p.dimple, 0.03, 0.08, "dimple");
  ExpectRange(p.fillet, 0.08, 0.2, "fillet");
}

TEST(BottleFamily, BeerKeepsItsRanges) {
  const Parameters p = Of(1);
  ExpectRange(p.height, 0.80, 0.98, "height");
  ExpectRange(p.body_radius, 0.15, 0.19, "body radius");
  ExpectRange(p.body, 0.40, 0.52, "body");
  ExpectRange(p.shoulder, 0.22, 0.32, "shoulder");
  ExpectRange(p.cap, 0.085, 0.115, "cap");
  ExpectRange(p.neck_radius, 0.36, 0.45, "neck radius");
  ExpectRange(p.cap_radius, 1.12, 1.30, "cap radius");
  ExpectRange(p.waist, 0.0, 0.0, "waist");
  ExpectRange(p.dimple, 0.01, 0.03, "dimple");
  ExpectRange(p.fillet, 0.1, 0.25, "fillet");
}

TEST(BottleFamily, WaterKeepsItsRanges) {
  const Parameters p = Of(2);
  ExpectRange(p.height, 0.85, 1.0, "height");
  ExpectRange(p.body_radius, 0.15, 0.19, "body radius");
  ExpectRange(p.body, 0.58, 0.68, "body");
  ExpectRange(p.shoulder, 0.10, 0.18, "shoulder");
  ExpectRange(p.cap, 0.08, 0.115, "cap");
  ExpectRange(p.neck_radius, 0.38, 0.50, "neck radius");
  ExpectRange(p.cap_radius, 1.15, 1.40, "cap radius");
  ExpectRange(p.waist, 0.06, 0.22, "waist");
  ExpectRange(p.dimple, 0.02, 0.05, "dimple");
  ExpectRange(p.fillet, 0.15, 0.4, "fillet");
  ExpectRange(p.pull, 0.35, 0.65, "pull");
}

TEST(BottleFamily, FlaskKeepsItsRanges) {
  const Parameters p = Of(3);
  ExpectRange(p.height, 0.75, 0.95, "height");
  ExpectRange(p.body_radius, 0.26, 0.36, "body radius");
  ExpectRange(p.body, 0.04, 0.10, "body");
  ExpectRange(p.shoulder, 0.48, 0.60, "shoulder");
  ExpectRange(p.cap, 0.09, 0.13, "cap");
  ExpectRange(p.neck_radius, 0.26, 0.38, "neck radius");
  ExpectRange(p.cap_radius, 1.15, 1.40, "cap radius");
  ExpectRange(p.waist, 0.0, 0.0, "waist");
  ExpectRange(p.dimple, 0.0, 0.02, "dimple");
  ExpectRange(p.fillet, 0.08, 0.15, "fillet");
}

TEST(BottleFamily, JarKeepsItsRanges) {
  const Parameters p = Of(4);
  ExpectRange(p.height, 0.60, 0.82, "height");
  ExpectRange(p.body_radius, 0.26, 0.38, "body radius");
  ExpectRange(p.body, 0.64, 0.74, "body");
  ExpectRange(p.shoulder, 0.07, 0.13, "shoulder");
  ExpectRange(p.cap, 0.115, 0.16, "cap");
  ExpectRange(p.neck_radius, 0.68, 0.84, "neck radius");
  ExpectRange(p.cap_radius, 1.04, 1.18, "cap radius");
  ExpectRange(p.waist, 0.0, 0.06, "waist");
  ExpectRange(p.dimple, 0.01, 0.03, "dimple");
  ExpectRange(p.fillet, 0.08, 0.2, "fillet");
  ExpectCommon(p);
}

TEST(BottleFamily, SprayKeepsItsRanges) {
  const Parameters p = Of(5);
  ExpectRange(p.height, 0.88, 1.0, "height");
  ExpectRange(p.body_radius, 0.13, 0.17, "body radius");
  ExpectRange(p.body, 0.64, 0.74, "body");
  ExpectRange(p.shoulder, 0.06, 0.10, "shoulder");
  ExpectRange(p.cap, 0.08, 0.13, "cap");
  ExpectRange(p.neck_radius, 0.55, 0.70, "neck radius");
  ExpectRange(p.cap_radius, 0.55, 0.75, "cap radius");
  ExpectRange(p.waist, 0.0, 0.0, "waist");
  ExpectRange(p.dimple, 0.01, 0.03, "dimple");
  ExpectRange(p.fillet, 0.05, 0.12, "fillet");
}

// The limits of the roundings hold, and with equality where they are at work.
TEST(BottleFamily, RoundingsStayWithinTheirPart) {
  double lower = 0.0, upper = 0.0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const auto o = Standing(3, seed);
    const double rounding = o[kTop].y() - o[kCapWall].y();
    lower = std::max(lower, o[kFilletEnd].y() / o[kBodyTop].y());
    upper = std::max(upper, rounding / o[kCapRim].x());
    EXPECT_LE(o[kShoulderTop].y(), o[kCapRim].y());
    EXPECT_NEAR(o[kCapEdge].x(), o[kCapRim].x() - rounding, 1e-12);
    EXPECT_NEAR(o[kNeckTop].y(), o[kCapRim].y(), 1e-12);
  }
  EXPECT_NEAR(lower, 0.8, 1e-12);
  EXPECT_NEAR(upper, 0.5, 1e-12);
}

TEST(BottleFamily, EdgesAreQuarterCirclesAndTheBaseIsHollow) {
  for (int family = 0; family < kBottleFamilies; ++family) {
    const auto o = Standing(family, 4);
    const double radius = o[kFilletEnd].x(), fillet = o[kFilletEnd].y();
    const Vector2d below(radius - fillet, fillet);
    for (std::size_t i = kFilletStart; i <= kFilletEnd; ++i) {
      EXPECT_NEAR((o[i] - below).norm(), fillet, 3e-4 * fillet);
    }
    const double cap = o[kTop].y() - o[kCapWall].y();
    const Vector2d above(o[kCapRim].x() - cap, o[kCapWall].y());
    for (std::size_t i = kCapWall; i <= kCapEdge; ++i) {
      EXPECT_NEAR((o[i] - above).norm(), cap, 3e-4 * cap);
    }
    // Half-way along the hollow's cubic: (3 * 0.5 + 3 * 0.7 + 1) / 8 of the foot, half its height.
    EXPECT_NEAR(o[kFoot].x(), 0.92 * (radius - fillet), 1e-12);
    EXPECT_NEAR(o[8].x(), 0.575 * o[kFoot].x(), 1e-12);
    EXPECT_NEAR(o[8].y(), 0.5 * o[kHollow].y(), 1e-12);
  }
}

// A stream gives the same bottle for ever: one number a parameter, in this order.
TEST(BottleFamily, DrawsItsParametersInOneOrder) {
  RngStream rng(3, "bottle-test");
  const auto o = Standing(2, 3);
  const double height = rng.Uniform(0.85, 1.0), radius = rng.Uniform(0.15, 0.19);
  const double body = rng.Uniform(0.58, 0.68), shoulder = rng.Uniform(0.10, 0.18);
  const double cap = rng.Uniform(0.08, 0.115), neck = rng.Uniform(0.38, 0.50);
  const double rim = rng.Uniform(1.15, 1.40), waist = rng.Uniform(0.06, 0.22);
  const double dimple = rng.Uniform(0.02, 0.05), fillet = rng.Uniform(0.15, 0.4);
  const double pull = rng.Uniform(0.35, 0.65), edge = rng.Uniform(0.3, 0.5);
  EXPECT_NEAR(o[kTop].y(), height, 1e-12);
  EXPECT_NEAR(o[kFilletEnd].x(), radius, 1e-12);
  EXPECT_NEAR(o[kBodyTop].y(), body * height, 1e-12);
  EXPECT_NEAR(o[kShoulderTop].y(), (body + shoulder) * height, 1e-12);
  EXPECT_NEAR(o[kCapRim].y(), (1 - cap) * height, 1e-12);
  EXPECT_NEAR(o[kNeckTop].x(), neck * radius, 1e-12);
  EXPECT_NEAR(o[kCapRim].x(), rim * neck * radius, 1e-12);
  EXPECT_NEAR(o[kBodyMiddle].x(), (1 - waist) * radius, 1e-12);
  EXPECT_NEAR(o[kHollow].y(), dimple * height, 1e-12);
  EXPECT_NEAR(o[kFilletEnd].y(), fillet * radius, 1e-12);
  EXPECT_NEAR(o[kBodyTop + 4].y(), (body + shoulder * (10 + 18 * pull) / 64) * height, 1e-12);
  EXPECT_NEAR(o[kTop].y() - o[kCapWall].y(),
              std::min(edge * cap * height, 0.5 * rim * neck * radius), 1e-12);
}

TEST(BottleFamily, StandsOnItsBase) {
  RngStream rng(1, "bottle-test");
  const BottleProfile wine = SampleBottle(0, rng);
  EXPECT_GT(SignedDistance(wine, 0.1, -0.2), 0.0);  // the body below
  EXPECT_LT(SignedDistance(wine, 0.1, 0.3), 0.0);   // beside the neck above
  EXPECT_THROW(SampleBottle(6, rng), std::logic_error);
  EXPECT_THROW(SampleBottle(-1, rng), std::logic_error);
}

}  // namespace
}  // namespace antigrasp
