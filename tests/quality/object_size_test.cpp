// At which size the metric looks at objects, and what it says of sizes that are hardly meant.
#include "antigrasp/quality/object_size.h"

#include <gtest/gtest.h>

#include <limits>

#include "antigrasp/quality/parallel_jaws.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;
using Texts = std::vector<std::string>;

MetricOptions TrueSize(LengthUnit units) {
  MetricOptions options;
  options.object_min_extent = 0.0;
  options.units = units;
  return options;
}

Graspability WithoutGrasps(int attempts, int too_wide) {
  Graspability score;
  score.status = GraspabilityStatus::kNoGrasps;
  score.attempts = attempts;
  score.rejected.reasons = {{kTooWide, too_wide}, {"slip", attempts - too_wide}};
  return score;
}

Texts TextsOf(const MetricOptions& options, const Vector3d& extent,
              const Graspability* score = nullptr) {
  UnlikelySizes sizes(options);
  sizes.Add("a.stl", extent, score);
  return sizes.Texts();
}

TEST(LengthUnit, EveryUnitHasItsLength) {
  EXPECT_EQ(ChoiceNames<LengthUnit>(), (Texts{"mm", "cm", "m", "in"}));
  EXPECT_EQ(MetresPer(LengthUnit::kMm), 0.001);
  EXPECT_EQ(MetresPer(LengthUnit::kCm), 0.01);
  EXPECT_EQ(MetresPer(LengthUnit::kM), 1.0);
  EXPECT_EQ(MetresPer(LengthUnit::kIn), 0.0254);
}

TEST(ObjectSize, IsTheSmallestExtentsUnlessObjectsKeepTheirs) {
  EXPECT_DOUBLE_EQ(MetresPerUnit({}, {80.0, 20.0, 160.0}), 0.002);
  MetricOptions inches;
  inches.units = LengthUnit::kIn;  // of no effect while objects are rescaled
  EXPECT_DOUBLE_EQ(MetresPerUnit(inches, {80.0, 20.0, 160.0}), 0.002);
  EXPECT_EQ(MetresPerUnit(TrueSize(LengthUnit::kIn), {80.0, 20.0, 160.0}), 0.0254);
  EXPECT_EQ(SizeText({}), "each scaled to a smallest extent of 40 mm");
  EXPECT_EQ(SizeText(TrueSize(LengthUnit::kCm)), "at true size (cm)");
}

TEST(ObjectSize, LengthsAreReadInMillimetresBelowAMetre) {
  EXPECT_EQ(LengthText(120.0), "120 m");
  EXPECT_EQ(LengthText(1234567.0), "1234567 m");
  EXPECT_EQ(LengthText(1.0), "1 m");
  EXPECT_EQ(LengthText(0.9999), "1 m");
  EXPECT_EQ(LengthText(0.99), "990 mm");
  EXPECT_EQ(LengthText(0.05), "50 mm");
  EXPECT_EQ(LengthText(0.0123456), "12.3 mm");
  EXPECT_EQ(LengthText(0.000085), "0.085 mm");
}

// The same file in millimetres and in metres: one size, one score.
TEST(TrueSize, IsTheSameInEveryUnit) {
  const TriangleMesh metres = shapes::Box({0.025, 0.03, 0.08});
  const Graspability expected = EvaluateGraspability(metres, TrueSize(LengthUnit::kM), 1, 0);
  ASSERT_GT(expected.value, 0.0);
  for (const Choice<LengthUnit>& unit : ChoicesOf(LengthUnit{})) {
    const double scale = MetresPer(unit.value);
    const Graspability g = EvaluateGraspability(Transformed(metres, 1.0 / scale, Vector3d::Zero()),
                                                TrueSize(unit.value), 1, 0);
    EXPECT_EQ(g.scale, scale) << unit.name;
    EXPECT_EQ(g.grasps.size(), expected.grasps.size()) << unit.name;
    EXPECT_NEAR(g.value, expected.value, 1e-6 * expected.value) << unit.name;
  }
}

// A cube of 100 mm is wider than the jaws open; at 40 mm it is the easiest of the three, since its
// grasps have the shortest levers. The plate of 10 mm becomes 160 mm wide, and so do its levers: at
// its own size they are short, and the jaws fit on all sides.
TEST(TrueSize, AndTheRescaledVersionRankObjectsDifferently) {
  const auto score = [](const Vector3d& millimetres, bool true_size) {
    MetricOptions options = TrueSize(LengthUnit::kMm);
    if (!true_size) options.object_min_extent = 0.04;
    return EvaluateGraspability(shapes::Box(millimetres), options, 1, 0).value;
  };
  const Vector3d cube(100.0, 100.0, 100.0), brick(30.0, 45.0, 90.0), plate(10.0, 40.0, 40.0);
  EXPECT_GT(score(cube, false), 1.2 * score(brick, false));
  EXPECT_GT(score(brick, false), 1.2 * score(plate, false));
  EXPECT_EQ(score(cube, true), 0.0);
  EXPECT_GT(score(plate, true), 1.2 * score(brick, true));
}

TEST(UnlikelyLengths, AreThoseAboveAMetreAndAUnitThatChangesNothing) {
  EXPECT_TRUE(UnlikelyLengths({}).empty());
  EXPECT_TRUE(UnlikelyLengths(TrueSize(LengthUnit::kMm)).empty());
  MetricOptions options;
  options.jaw_opening = 1.0;
  EXPECT_TRUE(UnlikelyLengths(options).empty());
  options.jaw_opening = 85.0;
  EXPECT_EQ(UnlikelyLengths(options),
            Texts{"metric.jaw_opening = 85 is 85 m: the metric's lengths are in metres, 85 mm are "
                  "0.085"});
  options = {};
  options.object_min_extent = 40.0;
  options.gripper.finger_width = 22.0;
  options.gripper.approach_angles = 64;  // no length
  EXPECT_EQ(UnlikelyLengths(options),
            (Texts{"gripper.finger_width = 22 is 22 m: the metric's lengths are in metres, 22 mm "
                   "are 0.022",
                   "metric.object_min_extent = 40 is 40 m: the metric's lengths are in metres, 40 "
                   "mm are 0.04"}));
  options = {};
  options.units = LengthUnit::kMm;
  EXPECT_EQ(UnlikelyLengths(options),
            Texts{"--units mm changes nothing while objects are each scaled to a smallest extent "
                  "of 40 mm; --true-size keeps their size"});
}

TEST(UnlikelySizes, NameTheUnitThatMakesAThingForTheHand) {
  const auto m = TrueSize(LengthUnit::kM), mm = TrueSize(LengthUnit::kMm);
  EXPECT_EQ(TextsOf(m, {120.0, 85.0, 40.0}),
            Texts{"a.stl: largest extent 120 m: are the coordinates in mm? --units mm"});
  EXPECT_EQ(TextsOf(m, {1.0, 8.0, 2.0}),  // 8 mm would be a crumb
            Texts{"a.stl: largest extent 8 m: are the coordinates in cm? --units cm"});
  EXPECT_EQ(TextsOf(mm, {0.12, 0.085, 0.04}),
            Texts{"a.stl: largest extent 0.12 mm: are the coordinates in m? --units m"});
  EXPECT_EQ(TextsOf(m, {1e6, 1.0, 1.0}),  // in no unit
            Texts{"a.stl: largest extent 1000000 m: are the coordinates in m? --units"});
  for (const Vector3d& fine : {Vector3d(5.0, 1.0, 1.0), Vector3d(0.001, 0.0005, 0.0005)}) {
    EXPECT_TRUE(TextsOf(m, fine).empty()) << fine.transpose();
  }
}

TEST(UnlikelySizes, OfRescaledObjectsSayNothing) {
  EXPECT_TRUE(TextsOf({}, {120.0, 85.0, 40.0}).empty());
  EXPECT_TRUE(TextsOf({}, {1e-6, 1e-6, 1e-6}).empty());
  EXPECT_TRUE(TextsOf({}, {0.0, 1.0, 1.0}).empty());
  EXPECT_TRUE(TextsOf({}, Vector3d::Zero()).empty());
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(TextsOf(TrueSize(LengthUnit::kM), {infinity, 1.0, 1.0}).empty());
}

TEST(UnlikelySizes, SayWhenEverythingIsWiderThanTheJawsOpen) {
  const Graspability none = WithoutGrasps(4000, 3900), slips = WithoutGrasps(4000, 1000);
  const std::string wide = "a.stl: no grasp, everything is wider than the opening of 50 mm ";
  EXPECT_EQ(TextsOf(TrueSize(LengthUnit::kMm), {300.0, 400.0, 120.0}, &none),
            Texts{wide + "(300 mm x 400 mm x 120 mm)"});
  EXPECT_EQ(TextsOf(TrueSize(LengthUnit::kM), {3.0, 4.0, 2.5}, &none),
            Texts{wide + "(3 m x 4 m x 2.5 m): are the coordinates in cm? --units cm"});
  EXPECT_EQ(TextsOf({}, {3.0, 4.0, 2.0}, &none), Texts{wide + "(60 mm x 80 mm x 40 mm)"});
  EXPECT_TRUE(TextsOf(TrueSize(LengthUnit::kMm), {300.0, 400.0, 120.0}, &slips).empty());
  Graspability some = none;
  some.status = GraspabilityStatus::kFewGrasps;
  EXPECT_TRUE(TextsOf(TrueSize(LengthUnit::kMm), {300.0, 400.0, 120.0}, &some).empty());
}

TEST(UnlikelySizes, OfManyObjectsAreOneSentenceEach) {
  UnlikelySizes sizes(TrueSize(LengthUnit::kM));
  EXPECT_TRUE(sizes.Texts().empty());
  for (const char* name : {"a.stl", "b.stl", "c.stl"}) sizes.Add(name, {60.0, 30.0, 45.0});
  sizes.Add("d.stl", {0.0006, 0.0003, 0.0003});
  EXPECT_EQ(sizes.Texts(),
            (Texts{"a.stl: largest extent 60 m: are the coordinates in mm? --units mm (and 2 more)",
                   "d.stl: largest extent 0.6 mm: are the coordinates in m? --units"}));
}

}  // namespace
}  // namespace antigrasp
