#include "antigrasp/quality/tip_quality.h"

#include <gtest/gtest.h>

#include <cmath>

#include "antigrasp/core/angles.h"
#include "antigrasp/quality/graspability.h"
#include "antigrasp/quality/robust_quality.h"
#include "tests/support/contact_shapes.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

MetricOptions With(TipContact contact, ClosingEnd closing) {
  MetricOptions options;
  options.contact = contact;
  options.closing = closing;
  return options;
}

Grasp Across(const Vector3d& center) {
  Grasp grasp;
  grasp.center = center;
  grasp.axis = Vector3d::UnitX();
  grasp.approach = -Vector3d::UnitZ();
  grasp.width = 0.03;
  return grasp;
}

TEST(TipQuality, OnFlatFacesABallScoresWhatAPointScores) {
  const TriangleMesh box = shapes::Box({0.03, 0.04, 0.05});
  const RayScene scene(box);
  const GraspObject object{box, scene, Vector3d::Zero()};
  const Grasp grasp = Across({0.0, 0.004, -0.006});
  const MetricOptions point = With(TipContact::kPoint, ClosingEnd::kFirst);
  const double expected = ExecutedQuality(scene, Vector3d::Zero(), grasp, point, {});
  ASSERT_GT(expected, 0.0);
  for (const TipContact contact : {TipContact::kSphere, TipContact::kPad}) {
    const TipQuality tips(object, With(contact, ClosingEnd::kFirst));
    if (contact == TipContact::kSphere) {
      EXPECT_NEAR(tips.Executed(grasp, {}), expected, 1e-9);
    } else {
      // Its patch ends at the box's rim or not: its middle is the grasp's here.
      EXPECT_NEAR(tips.Executed(grasp, {}), expected, 1e-6);
    }
  }
}

// A ridge between two valleys: the ray falls into the valley, the ball rests on both its sides.
TEST(TipQuality, ABallTouchesTheOffsetSurface) {
  // A ball of 5 mm beside the edge of a box, 3 mm past it: it meets the edge where the circle does.
  const TriangleMesh box = shapes::Box({0.03, 0.04, 0.05});
  const RayScene scene(box);
  const TipQuality tips({box, scene, Vector3d::Zero()},
                        With(TipContact::kSphere, ClosingEnd::kFirst));
  const auto contacts = tips.FirstContacts(Across({0.0, 0.023, 0.0}), {.friction = 10.0});
  ASSERT_TRUE(contacts);
  const Vector3d edge(-0.015, 0.02, 0.0);
  EXPECT_LT(((*contacts)[0].point - edge).norm(), 1e-5);
  EXPECT_NEAR((*contacts)[0].normal.y(), 3.0 / 5.0, 1e-3);  // from the edge to the ball's centre
  // There the point meets nothing, and the ball slips below tan(asin 0.6) = 0.75.
  EXPECT_EQ(ExecutedQuality(scene, Vector3d::Zero(), Across({0.0, 0.023, 0.0}), {}, {}), 0.0);
  EXPECT_FALSE(tips.FirstContacts(Across({0.0, 0.023, 0.0}), {.friction = 0.74}));
  EXPECT_TRUE(tips.FirstContacts(Across({0.0, 0.023, 0.0}), {.friction = 0.76}));
}

TEST(TipQuality, AJawThatStartsInsideScoresNothing) {
  const TriangleMesh box = shapes::Box({0.06, 0.04, 0.05});
  const RayScene scene(box);
  for (const TipContact contact : {TipContact::kSphere, TipContact::kPad}) {
    const TipQuality tips({box, scene, Vector3d::Zero()}, With(contact, ClosingEnd::kFirst));
    EXPECT_EQ(tips.Executed(Across(Vector3d::Zero()), {}), 0.0);
  }
}

TEST(TipQuality, TheSettledPresetIsTheShareOfGraspsHeld) {
  MetricOptions options;
  ApplyMetricPreset("settled", &options);
  options.num_grasps = 40;
  const Graspability easy = EvaluateGraspability(shapes::Box({0.04, 0.05, 0.06}), options, 1, 1);
  EXPECT_EQ(easy.status, GraspabilityStatus::kOk);
  EXPECT_EQ(easy.value, easy.mean);
  EXPECT_GT(easy.value, 0.6);
  EXPECT_LE(easy.value, 1.0);
  EXPECT_LT(easy.ci_low, easy.value);
  int held = 0;
  for (const ScoredGrasp& grasp : easy.grasps) {
    EXPECT_TRUE(grasp.quality == 0.0 || grasp.quality == 1.0);
    held += grasp.quality > 0.0 ? 1 : 0;
  }
  EXPECT_DOUBLE_EQ(easy.value, held / 40.0);
}

// A share: Wilson's interval stays within 0 and 1 and is no point at its ends.
TEST(TipQuality, TheIntervalOfAShareIsWithinZeroAndOne) {
  MetricOptions options;
  ApplyMetricPreset("settled", &options);
  ApplyNoisePreset("none", &options);
  options.num_grasps = 10;
  const Graspability all = EvaluateGraspability(shapes::Box({0.04, 0.05, 0.06}), options, 1, 1);
  EXPECT_EQ(all.value, 1.0);
  EXPECT_NEAR(all.ci_low, 0.722, 0.001);  // Wilson, 10 of 10
  EXPECT_NEAR(all.ci_high, 1.0, 1e-12);
  EXPECT_LE(all.ci_high, 1.0);
}

TEST(TipQuality, WithoutNoiseEveryGraspOfABoxSettles) {
  MetricOptions options;
  ApplyMetricPreset("settled", &options);
  ApplyNoisePreset("none", &options);
  options.num_grasps = 40;
  options.friction = 0.2;
  EXPECT_GE(EvaluateGraspability(shapes::Box({0.04, 0.05, 0.06}), options, 1, 1).value, 0.95);
}

TEST(TipQuality, LessFrictionHoldsLess) {
  MetricOptions options;
  ApplyMetricPreset("settled", &options);
  options.num_grasps = 60;
  const TriangleMesh mesh = shapes::Bumpy(0.02, 3, 3);
  options.friction = 0.6;
  const double more = EvaluateGraspability(mesh, options, 1, 1).value;
  options.friction = 0.15;
  const double less = EvaluateGraspability(mesh, options, 1, 1).value;
  EXPECT_GT(more, less + 0.1);
}

}  // namespace
}  // namespace antigrasp
