#include "antigrasp/quality/wrench_resistance.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>

#include "antigrasp/core/error.h"
#include "tests/quality/option_lines.h"
#include "tests/quality/random_grasps.h"
#include "tests/quality/reference_cases.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

// The ends of a horizontal diameter of a ball of 2 cm radius about the origin.
std::array<Contact, 2> BallGrasp() {
  return {Contact{Vector3d(-0.02, 0.0, 0.0), -Vector3d::UnitX(), 1.0},
          Contact{Vector3d(0.02, 0.0, 0.0), Vector3d::UnitX(), 1.0}};
}

Wrench Force(double x, double y, double z) {
  Wrench w = Wrench::Zero();
  w.head<3>() = Vector3d(x, y, z);
  return w;
}

Wrench Torque(double x, double y, double z) {
  Wrench w = Wrench::Zero();
  w.tail<3>() = Vector3d(x, y, z);
  return w;
}

WrenchResistance OnBall(const Wrench& target, const WrenchResistanceOptions& options = {},
                        const WrenchModel& model = {}) {
  return ResistWrench(BallGrasp(), Vector3d::Zero(), model, target, options);
}

WrenchResistanceOptions OptionsOf(const ReferenceCase& c) {
  WrenchResistanceOptions options;
  options.force_limit = c.force_limit;
  return options;
}

TEST(WrenchResistance, ResistedOrNotIsDexNetsOnAllReferenceRows) {
  int resisted = 0, slipped = 0;
  for (const ReferenceCase& c : ReadReferenceCases()) {
    const auto result = ResistWrench(c.contacts, c.com, c.model, c.target, OptionsOf(c), c.frames);
    EXPECT_EQ(result.resisted, c.dexnet_resistance > 0.0) << c.id << " " << c.family;
    EXPECT_EQ(result.resisted, c.resistance > 0.0) << c.id << " " << c.family;
    EXPECT_EQ(result.quality > 0.0, result.resisted) << c.id;
    EXPECT_EQ(std::isnan(result.residual2), c.cone_status != "ok") << c.id;
    resisted += result.resisted ? 1 : 0;
    slipped += c.cone_status != "ok" ? 1 : 0;
  }
  EXPECT_EQ(resisted, 102);
  EXPECT_EQ(slipped, 47);
}

TEST(WrenchResistance, NormAndQualityAreTheReferencesWhereItIsExact) {
  int compared = 0;
  for (const ReferenceCase& c : ReadReferenceCases()) {
    if (!c.below_limit) continue;
    const auto result = ResistWrench(c.contacts, c.com, c.model, c.target, OptionsOf(c), c.frames);
    EXPECT_NEAR(result.coefficient_norm, c.coefficient_norm, 1e-12 * c.coefficient_norm) << c.id;
    EXPECT_NEAR(result.quality, c.resistance, 1e-12) << c.id;
    ++compared;
  }
  EXPECT_EQ(compared, 94);
}

TEST(WrenchResistance, NoReferenceSolutionIsBetterWhereTheLimitBinds) {
  int compared = 0;
  for (const ReferenceCase& c : ReadReferenceCases()) {
    if (c.below_limit || c.cone_status != "ok") continue;
    const auto result = ResistWrench(c.contacts, c.com, c.model, c.target, OptionsOf(c), c.frames);
    const auto value = [](double residual2, double norm) {
      return residual2 + 1e-10 * norm * norm;
    };
    const double reference = value(c.residual2, c.coefficient_norm);
    const double ours = value(result.residual2, result.coefficient_norm);
    EXPECT_LE(ours, reference + 1e-13) << c.id;
    EXPECT_NEAR(ours, reference, 1e-5 * reference) << c.id << " and it is nearly as good";
    for (int i = 0; i < 2; ++i) {
      const auto& a = result.coefficients;
      EXPECT_LE(a.segment(8 * i, 8).sum() + a[16 + i] + a[18 + i], c.force_limit * (1.0 + 1e-14));
    }
    EXPECT_GE(result.coefficients.minCoeff(), 0.0);
    ++compared;
  }
  EXPECT_EQ(compared, 359);
}

TEST(WrenchResistance, ABallHangsByTwiceTheFrictionTimesTheForceLimit) {
  // Each contact carries mu F upwards, z being an edge of both pyramids: 2 mu F = 20. Above, the
  // rest is what is missing, and Dex-Net forgives a squared rest of 0.001.
  const double forgiven = std::sqrt(1e-3);
  EXPECT_TRUE(OnBall(Force(0.0, 0.0, -20.0)).resisted);
  EXPECT_TRUE(OnBall(Force(0.0, 0.0, -20.0 - 0.999 * forgiven)).resisted);
  EXPECT_FALSE(OnBall(Force(0.0, 0.0, -20.0 - 1.001 * forgiven)).resisted);
  WrenchResistanceOptions options;
  options.force_limit = 3.0;
  options.tolerance = 1e-8;
  WrenchModel slippery;
  slippery.friction = 0.2;
  EXPECT_TRUE(OnBall(Force(0.0, 0.0, -1.2), options, slippery).resisted);
  EXPECT_FALSE(OnBall(Force(0.0, 0.0, -1.201), options, slippery).resisted);
  EXPECT_NEAR(OnBall(Force(0.0, 0.0, -2.2), options, slippery).residual2, 1.0, 1e-9);
}

TEST(WrenchResistance, SmallestCoefficientsUnderALightWeightAreThoseOnPaper) {
  // Per contact a_j = max(cos, 0) W / (4 mu) over the octagon: all together |a| = W / (2 mu).
  const double weight = 3.0;
  const auto result = OnBall(Force(0.0, 0.0, -weight));
  ASSERT_TRUE(result.resisted);
  EXPECT_NEAR(result.coefficient_norm, weight, 1e-8);
  EXPECT_NEAR(result.quality, 1.0 / (weight + 1e-9) - 1.0 / 40.0, 1e-9);
  EXPECT_NEAR(result.coefficients.maxCoeff(), weight / 2.0, 1e-8);
  EXPECT_NEAR(result.coefficients.sum(), weight * (1.0 + std::sqrt(2.0)), 1e-8);
}

TEST(WrenchResistance, TwistAboutTheLineIsHeldByTorsionAloneUpToTheLimit) {
  // +T1 and -T2 share it without any normal force; each can do F times its column.
  const double column = std::numbers::pi * 0.005 * 0.005 * 0.5 * 1000.0;
  const auto result = OnBall(Torque(column, 0.0, 0.0));
  ASSERT_TRUE(result.resisted);
  EXPECT_NEAR(result.coefficient_norm, 1.0 / std::sqrt(2.0), 1e-6);
  EXPECT_NEAR(result.coefficients[16], 0.5, 1e-6);
  EXPECT_NEAR(result.coefficients[19], 0.5, 1e-6);
  WrenchResistanceOptions exact;
  exact.tolerance = 1e-8;
  EXPECT_TRUE(OnBall(Torque(40.0 * column, 0.0, 0.0), exact).resisted);
  EXPECT_FALSE(OnBall(Torque(40.1 * column, 0.0, 0.0), exact).resisted);
  exact.limit_cone_only = true;
  EXPECT_TRUE(OnBall(Torque(400.0 * column, 0.0, 0.0), exact).resisted);
  WrenchModel hard;
  hard.torsion = Torsion::kNone;
  EXPECT_FALSE(OnBall(Torque(column, 0.0, 0.0), exact, hard).resisted);
  hard.torsion = Torsion::kUniformPressure;  // 2 * 20 * 2/3 r mu s = 66.7
  exact.limit_cone_only = false;
  EXPECT_TRUE(OnBall(Torque(66.6, 0.0, 0.0), exact, hard).resisted);
  EXPECT_FALSE(OnBall(Torque(66.8, 0.0, 0.0), exact, hard).resisted);
}

TEST(WrenchResistance, ALimitIsOfEachContactNotOfBothTogether) {
  // Pushing the ball along +x is contact 1's work alone, its 8 edges have 1 along x each; contact 2
  // can only push back. 20 is the limit of one, 40 would be that of both.
  WrenchResistanceOptions exact;
  exact.tolerance = 1e-8;
  const auto most = OnBall(Force(20.0, 0.0, 0.0), exact);
  ASSERT_TRUE(most.resisted);
  EXPECT_NEAR(most.coefficients.head<8>().sum(), 20.0, 1e-6);
  EXPECT_NEAR(most.coefficients.segment<8>(8).sum(), 0.0, 1e-6);
  EXPECT_FALSE(OnBall(Force(20.1, 0.0, 0.0), exact).resisted);
  const auto back = OnBall(Force(-20.0, 0.0, 0.0), exact);
  EXPECT_NEAR(back.coefficients.head<8>().sum(), 0.0, 1e-6);
  EXPECT_NEAR(back.coefficients.segment<8>(8).sum(), 20.0, 1e-6);
}

TEST(WrenchResistance, DexNetAsksForTheWrenchItselfNotForItsOpposite) {
  // Both contacts under the object: they push up, they cannot pull down.
  const std::array<Contact, 2> contacts{Contact{Vector3d(-0.02, 0.0, 0.0), -Vector3d::UnitZ(), 1.0},
                                        Contact{Vector3d(0.02, 0.0, 0.0), -Vector3d::UnitZ(), 1.0}};
  const Wrench weight = Force(0.0, 0.0, -5.0);
  WrenchResistanceOptions hold;
  hold.oppose_target = true;
  EXPECT_FALSE(ResistWrench(contacts, Vector3d::Zero(), {}, weight).resisted);
  EXPECT_TRUE(ResistWrench(contacts, Vector3d::Zero(), {}, weight, hold).resisted);
  EXPECT_TRUE(ResistWrench(contacts, Vector3d::Zero(), {}, -weight).resisted);
}

TEST(WrenchResistance, TorqueOfTheTargetIsInScaledUnitsUnlessToldOtherwise) {
  WrenchResistanceOptions metric;
  metric.metric_torque = true;
  const Wrench newton_metres = Torque(0.0, 0.02, 0.0);
  EXPECT_NEAR(OnBall(newton_metres, metric).coefficient_norm,
              OnBall(1000.0 * newton_metres).coefficient_norm, 1e-12);
  EXPECT_NE(OnBall(newton_metres).coefficient_norm, OnBall(newton_metres, metric).coefficient_norm);
}

TEST(WrenchResistance, ScalesWithTheForcesAndNeedsLessWithMoreFriction) {
  RngStream rng(41, "resist");
  int resisted = 0;
  for (int i = 0; i < 150; ++i) {
    RandomGrasp grasp = DrawRandomGrasp(1.0, 8, &rng);
    grasp.model.torque_scale = 50.0;
    Wrench target;
    for (int k = 0; k < 6; ++k) target[k] = 0.3 * rng.Normal();
    WrenchResistanceOptions options;
    options.regularizer = 1e-8;
    const auto before = ResistWrench(grasp.contacts, grasp.com, grasp.model, target, options);
    options.force_limit *= 2.0;
    const auto twice = ResistWrench(grasp.contacts, grasp.com, grasp.model, 2.0 * target, options);
    EXPECT_NEAR(twice.coefficient_norm, 2.0 * before.coefficient_norm,
                1e-9 * before.coefficient_norm);
    EXPECT_NEAR(twice.residual2, 4.0 * before.residual2, 1e-9 * before.residual2 + 1e-12);
    grasp.model.friction *= 1.3;
    const auto rougher =
        ResistWrench(grasp.contacts, grasp.com, grasp.model, 2.0 * target, options);
    EXPECT_LE(rougher.residual2, twice.residual2 + 1e-4);
    resisted += before.resisted ? 1 : 0;
  }
  EXPECT_GT(resisted, 20);
  EXPECT_LT(resisted, 140);
}

TEST(WrenchResistance, NothingIsResistedWithoutContactForceOrWithoutNumbers) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  auto contacts = BallGrasp();
  contacts[1].normal_force = 0.0;
  EXPECT_FALSE(ResistWrench(contacts, Vector3d::Zero(), {}, Wrench::Zero()).resisted);
  contacts = BallGrasp();
  contacts[0].point.x() = nan;
  EXPECT_FALSE(ResistWrench(contacts, Vector3d::Zero(), {}, Wrench::Zero()).resisted);
  const auto result = OnBall(Force(nan, 0.0, 0.0));
  EXPECT_FALSE(result.resisted);
  EXPECT_EQ(result.quality, 0.0);
  EXPECT_TRUE(std::isnan(result.coefficient_norm));
  EXPECT_EQ(result.coefficients.size(), 0);
}

TEST(WrenchResistance, NothingToResistIsResistedByNoForceAtAll) {
  const auto result = OnBall(Wrench::Zero());
  EXPECT_TRUE(result.resisted);
  EXPECT_EQ(result.coefficient_norm, 0.0);
  EXPECT_NEAR(result.quality, 1e9, 1.0);
}

TEST(WrenchResistanceOptions, EveryKeyIsBoundToItsFieldAndEveryDefaultIsItsNumber) {
  EXPECT_EQ(
      LinesOf(WrenchResistanceOptions()),
      (std::vector<std::string>{"wrench.force_limit = 20.0", "wrench.tolerance = 0.001",
                                "wrench.regularizer = 1e-10", "wrench.oppose_target = false",
                                "wrench.metric_torque = false", "wrench.limit_cone_only = false"}));
  // One flag at a time: three that are all set hide two that have changed places.
  for (int flag = 0; flag < 3; ++flag) {
    const auto text = [flag](int which) { return flag == which ? "true" : "false"; };
    EXPECT_EQ(LinesOf(WrenchResistanceOptions{3.0, 0.25, 1e-6, flag == 0, flag == 1, flag == 2}),
              (std::vector<std::string>{"wrench.force_limit = 3.0", "wrench.tolerance = 0.25",
                                        "wrench.regularizer = 1e-06",
                                        std::string("wrench.oppose_target = ") + text(0),
                                        std::string("wrench.metric_torque = ") + text(1),
                                        std::string("wrench.limit_cone_only = ") + text(2)}));
  }
}

TEST(WrenchResistanceOptions, EveryFieldSurvivesTheConfigurationFile) {
  WrenchResistanceOptions written{3.0, 0.25, 1e-6, true, true, true}, read;
  OptionTable out, in;
  Bind(&out, &written);
  Bind(&in, &read);
  EXPECT_EQ(out.options().size(), 6u);
  in.ApplyText(out.Dump(), "dump");
  EXPECT_EQ(read.force_limit, 3.0);
  EXPECT_EQ(read.tolerance, 0.25);
  EXPECT_EQ(read.regularizer, 1e-6);
  EXPECT_TRUE(read.oppose_target && read.metric_torque && read.limit_cone_only);
  EXPECT_THROW(in.ApplyOverride("wrench.force_limit=0"), InputError);
  EXPECT_THROW(in.ApplyOverride("wrench.regularizer=0"), InputError);
}

}  // namespace
}  // namespace antigrasp
