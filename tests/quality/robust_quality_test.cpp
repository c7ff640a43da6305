#include "antigrasp/quality/robust_quality.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <vector>

#include "antigrasp/quality/epsilon.h"
#include "antigrasp/quality/jaw_closing.h"
#include "tests/support/random_draws.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

// A box off the origin, so that "about the centre of mass" differs from "about the origin".
const Vector3d kCom(0.01, -0.02, 0.03);
TriangleMesh BoxMesh() { return Transformed(shapes::Box({0.03, 0.05, 0.08}), 1.0, kCom); }

Grasp GraspAcross(const RayScene& scene, const Vector3d& offset) {
  Grasp grasp;
  grasp.center = kCom + offset;
  grasp.axis = Vector3d::UnitX();
  grasp.contacts = *CloseJaws(scene, grasp.center, grasp.axis, 0.05, 0.5);
  grasp.width = 0.03;
  return grasp;
}

Eigen::Matrix3d Rotation(const Vector3d& v) {
  return Eigen::AngleAxisd(v.norm(), v.normalized()).toRotationMatrix();
}

Vector3d RotationVector(const Eigen::Matrix3d& rotation) {
  const Eigen::AngleAxisd turn(rotation);
  return turn.angle() * turn.axis();
}

TEST(RobustQuality, WithoutNoiseIsTheEpsilonOfTheGrasp) {
  const RayScene scene(BoxMesh());
  MetricOptions options;
  ApplyNoisePreset("none", &options);
  const Grasp grasp = GraspAcross(scene, {0.0, 0.004, 0.01});
  const double epsilon = Epsilon(grasp.contacts, kCom, {});
  EXPECT_GT(epsilon, 0.0);
  RngStream rng(1, "noise");
  EXPECT_NEAR(RobustQuality(scene, kCom, grasp, options, &rng), epsilon, 1e-15);
}

TEST(ExecutedQualities, AreThoseOfSingleDrawsToTheLastBit) {
  const RayScene scene(BoxMesh());
  const MetricOptions options;
  const Grasp grasp = GraspAcross(scene, {0.0, 0.004, 0.01});
  RngStream rng(2, "noise"), again(2, "noise");
  std::vector<NoiseDraw> draws(60);
  std::vector<double> together(60);
  DrawNoises(options, &rng, draws);
  ExecutedQualities(scene, kCom, grasp, options, draws, together);
  int held = 0;
  for (std::size_t i = 0; i < draws.size(); ++i) {
    const NoiseDraw draw = DrawNoise(options, &again);
    EXPECT_EQ(draws[i].object_translation, draw.object_translation);
    EXPECT_EQ(draws[i].object_rotation, draw.object_rotation);
    EXPECT_EQ(draws[i].grasp_translation, draw.grasp_translation);
    EXPECT_EQ(draws[i].grasp_rotation, draw.grasp_rotation);
    EXPECT_EQ(draws[i].friction, draw.friction);
    EXPECT_EQ(together[i], ExecutedQuality(scene, kCom, grasp, options, draw)) << i;
    held += together[i] > 0.0;
  }
  EXPECT_GT(held, 30);
  EXPECT_EQ(rng.NextU64(), again.NextU64());
}

TEST(RobustQuality, IsTheMeanOverItsDraws) {
  const RayScene scene(BoxMesh());
  MetricOptions options;
  options.num_draws = 7;
  const Grasp grasp = GraspAcross(scene, {0.0, 0.004, 0.01});
  RngStream rng(2, "noise"), again(2, "noise");
  double sum = 0.0;
  for (int i = 0; i < 7; ++i) {
    sum += ExecutedQuality(scene, kCom, grasp, options, DrawNoise(options, &rng));
  }
  EXPECT_NEAR(RobustQuality(scene, kCom, grasp, options, &again), sum / 7.0, 1e-16);
}

TEST(ExecutedQuality, OnlyTheRelativePoseOfGripperAndObjectMatters) {
  const RayScene scene(BoxMesh());
  const MetricOptions options;
  const Grasp grasp = GraspAcross(scene, {0.0, 0.004, 0.01});
  const double nominal = ExecutedQuality(scene, kCom, grasp, options, {});
  RngStream rng(3, "noise");
  for (int i = 0; i < 100; ++i) {
    // Object and gripper carried along by one rigid motion about the centre of mass.
    NoiseDraw together;
    together.object_translation = DrawPoint(0.1, &rng);
    together.object_rotation = DrawPoint(1.0, &rng);
    together.grasp_rotation = together.object_rotation;
    together.grasp_translation = Rotation(together.object_rotation) * (grasp.center - kCom) + kCom +
                                 together.object_translation - grasp.center;
    EXPECT_NEAR(ExecutedQuality(scene, kCom, grasp, options, together), nominal, 1e-9);
  }
}

TEST(ExecutedQuality, MovingTheObjectIsMovingTheGripperTheOtherWay) {
  const RayScene scene(BoxMesh());
  const MetricOptions options;
  const Grasp grasp = GraspAcross(scene, {0.0, 0.004, 0.01});
  RngStream rng(4, "noise");
  int positive = 0;
  for (int i = 0; i < 200; ++i) {
    NoiseDraw object, gripper;
    object.object_translation = DrawPoint(0.005, &rng);
    object.object_rotation = DrawPoint(0.1, &rng);
    const Eigen::Matrix3d back = Rotation(object.object_rotation).transpose();
    gripper.grasp_rotation = RotationVector(back);
    gripper.grasp_translation =
        back * (grasp.center - kCom - object.object_translation) + kCom - grasp.center;
    const double quality = ExecutedQuality(scene, kCom, grasp, options, object);
    EXPECT_NEAR(ExecutedQuality(scene, kCom, grasp, options, gripper), quality, 1e-9);
    positive += quality > 0.0 ? 1 : 0;
  }
  EXPECT_GT(positive, 50);
}

TEST(ExecutedQuality, MatchesTheObjectMovedForReal) {
  // Translation keeps the object's axes, so the moved mesh has the same tangent frames.
  const MetricOptions options;
  const RayScene scene(BoxMesh());
  const Grasp grasp = GraspAcross(scene, {0.0, 0.004, 0.01});
  NoiseDraw draw;
  draw.object_translation = Vector3d(0.003, -0.006, 0.009);
  const RayScene moved(Transformed(BoxMesh(), 1.0, draw.object_translation));
  const double expected =
      ExecutedQuality(moved, kCom + draw.object_translation, grasp, options, {});
  EXPECT_GT(expected, 0.0);
  EXPECT_NEAR(ExecutedQuality(scene, kCom, grasp, options, draw), expected, 1e-9);
}

TEST(ExecutedQuality, IsZeroWhenTheGraspFails) {
  const RayScene scene(BoxMesh());
  const MetricOptions options;
  const Grasp grasp = GraspAcross(scene, Vector3d::Zero());
  NoiseDraw miss;
  miss.grasp_translation = Vector3d(0.0, 0.0, 0.05);
  EXPECT_EQ(ExecutedQuality(scene, kCom, grasp, options, miss), 0.0);
  NoiseDraw starts_inside;
  starts_inside.grasp_translation = Vector3d(0.011, 0.0, 0.0);
  EXPECT_EQ(ExecutedQuality(scene, kCom, grasp, options, starts_inside), 0.0);
  NoiseDraw slips;
  slips.grasp_rotation = Vector3d(0.0, 0.0, std::atan(0.5) + 0.01);
  EXPECT_EQ(ExecutedQuality(scene, kCom, grasp, options, slips), 0.0);
  NoiseDraw no_friction;
  no_friction.friction = 0.0;
  EXPECT_EQ(ExecutedQuality(scene, kCom, grasp, options, no_friction), 0.0);
}

TEST(ExecutedQuality, UsesTheConstantsOfTheOptionsAndTheFrictionOfTheDraw) {
  const RayScene scene(BoxMesh());
  const Grasp grasp = GraspAcross(scene, {0.0, 0.004, 0.01});
  MetricOptions options;
  options.cone_edges = 5;
  options.finger_radius = 0.007;
  options.torque_scale = 300.0;
  NoiseDraw draw;
  draw.friction = 0.35;
  const double expected = Epsilon(grasp.contacts, kCom, {0.35, 5, 0.007, 300.0});
  EXPECT_GT(expected, 0.0);
  EXPECT_NEAR(ExecutedQuality(scene, kCom, grasp, options, draw), expected, 1e-15);
  // Between the cone of the draw and that of the options: a jaw slips by the draw's.
  const auto turned = [&](double tangent, double friction) {
    NoiseDraw turn;
    turn.grasp_rotation = Vector3d(0.0, 0.0, std::atan(tangent));
    turn.friction = friction;
    return ExecutedQuality(scene, kCom, grasp, options, turn);
  };
  EXPECT_EQ(turned(0.3, 0.29), 0.0);
  EXPECT_GT(turned(0.3, 0.5), 0.0);
  EXPECT_GT(turned(0.6, 0.9), 0.0);
  options.friction = 0.9;
  EXPECT_EQ(turned(0.6, 0.5), 0.0);
}

TEST(ExecutedQuality, IsThatOfTheTorsionModelOnACube) {
  // 1 / epsilon is the length of the longest y with y . w <= 1 for every wrench w. Across the
  // middle of a cube of 4 cm torsion alone turns about the line of the contacts: +-T, T = s pi r^2
  // mu or s 2/3 r mu, so that y has the part 1 / T there. The edges are (+-1, f, +-H J f) for f on
  // the octagon of radius mu, H = s 2 cm = 20 and J a quarter turn. The longest other part leaves
  // all to one contact: (-1, p / 2, J p / (2 H)), |p| = 2 / (mu cos(pi / 8)) towards a side of the
  // octagon.
  const RayScene scene(shapes::Box({0.04, 0.04, 0.04}));
  Grasp grasp;  // along x through the origin
  MetricOptions options;
  const auto quality = [&](Torsion torsion) {
    options.torsion = torsion;
    return ExecutedQuality(scene, Vector3d::Zero(), grasp, options, {});
  };
  const double half = 1.0 / (0.5 * std::cos(std::numbers::pi / 8.0));
  const double rest = 1.0 + (1.0 + 1.0 / 400.0) * half * half;
  const auto expected = [rest](double t) { return 1.0 / std::sqrt(1.0 / (t * t) + rest); };
  EXPECT_EQ(quality(Torsion::kNone), 0.0);
  EXPECT_NEAR(quality(Torsion::kDexNet), expected(0.0125 * std::numbers::pi), 1e-9);
  EXPECT_NEAR(quality(Torsion::kDexNet), 0.0390985, 1e-7);
  EXPECT_NEAR(quality(Torsion::kUniformPressure), expected(5.0 / 3.0), 1e-9);
  EXPECT_NEAR(quality(Torsion::kUniformPressure), 0.4062890, 1e-7);
}

TEST(ExecutedQuality, OpensTheJawsAsWideAsTheOptionsSay) {
  // 3 cm across the box: 11 mm aside a jaw starts inside with 5 cm, outside with 6.
  const RayScene scene(BoxMesh());
  const Grasp grasp = GraspAcross(scene, Vector3d::Zero());
  NoiseDraw aside;
  aside.grasp_translation = Vector3d(0.011, 0.0, 0.0);
  MetricOptions options;
  EXPECT_EQ(ExecutedQuality(scene, kCom, grasp, options, aside), 0.0);
  options.jaw_opening = 0.06;
  EXPECT_GT(ExecutedQuality(scene, kCom, grasp, options, aside), 0.0);
}

TEST(ExecutedPose, TurnsAboutTheCentreOfMassAndTheGripperAboutItsOwnCentre) {
  Grasp grasp;
  grasp.center = Vector3d(1.0, 2.0, 3.0);
  grasp.axis = Vector3d::UnitX();
  const Vector3d com(1.0, 1.0, 1.0);
  NoiseDraw draw;
  draw.grasp_rotation = Vector3d(0.0, 0.0, 0.5 * std::numbers::pi);  // x to y
  JawPose pose = ExecutedPose(grasp, com, draw);
  EXPECT_LT((pose.center - grasp.center).norm(), 1e-15);
  EXPECT_LT((pose.axis - Vector3d::UnitY()).norm(), 1e-15);
  draw = {};
  draw.object_rotation = Vector3d(0.5 * std::numbers::pi, 0.0, 0.0);  // of the object: y to z
  pose = ExecutedPose(grasp, com, draw);
  // The gripper is (0, 1, 2) off the com; in the turned object's frame (0, 2, -1).
  EXPECT_LT((pose.center - Vector3d(1.0, 3.0, 0.0)).norm(), 1e-15);
  EXPECT_LT((pose.axis - Vector3d::UnitX()).norm(), 1e-15);
  draw.object_translation = Vector3d(0.1, 0.2, 0.4);
  draw.grasp_translation = Vector3d(0.3, 0.0, 0.0);  // (0.2, 0.8, 1.6) off
  pose = ExecutedPose(grasp, com, draw);
  EXPECT_LT((pose.center - Vector3d(1.2, 2.6, 0.2)).norm(), 1e-15);
}

TEST(DrawNoise, TakesThirteenNormalNumbersInTheOrderOfTheFields) {
  MetricOptions options;
  options.friction = 0.4;
  options.object_translation_std = 1.0;
  options.object_rotation_std = 2.0;
  options.grasp_translation_std = 3.0;
  options.grasp_rotation_std = 4.0;
  options.friction_std = 0.01;
  RngStream rng(8, "noise"), plain(8, "noise");
  for (int i = 0; i < 3; ++i) {
    const NoiseDraw draw = DrawNoise(options, &rng);
    for (int k = 0; k < 3; ++k) EXPECT_EQ(draw.object_translation[k], plain.Normal());
    for (int k = 0; k < 3; ++k) EXPECT_EQ(draw.object_rotation[k], 2.0 * plain.Normal());
    for (int k = 0; k < 3; ++k) EXPECT_EQ(draw.grasp_translation[k], 3.0 * plain.Normal());
    for (int k = 0; k < 3; ++k) EXPECT_EQ(draw.grasp_rotation[k], 4.0 * plain.Normal());
    EXPECT_EQ(draw.friction, 0.4 + 0.01 * plain.Normal());
  }
  ApplyNoisePreset("none", &options);
  DrawNoise(options, &rng);
  for (int k = 0; k < 13; ++k) plain.Normal();
  EXPECT_EQ(rng.Normal(), plain.Normal()) << "as many without noise";
}

TEST(DrawNoise, HasTheStandardDeviationsOfTheOptions) {
  MetricOptions options;
  RngStream rng(5, "noise");
  const int count = 20000;
  Vector3d object_t = Vector3d::Zero(), object_r = object_t, grasp_t = object_t, grasp_r = object_t;
  double friction = 0.0, friction2 = 0.0;
  for (int i = 0; i < count; ++i) {
    const NoiseDraw draw = DrawNoise(options, &rng);
    object_t += draw.object_translation.cwiseAbs2() / count;
    object_r += draw.object_rotation.cwiseAbs2() / count;
    grasp_t += draw.grasp_translation.cwiseAbs2() / count;
    grasp_r += draw.grasp_rotation.cwiseAbs2() / count;
    friction += draw.friction / count;
    friction2 += draw.friction * draw.friction / count;
  }
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(std::sqrt(object_t[k]), 0.0025, 0.0025 * 0.03);
    EXPECT_NEAR(std::sqrt(object_r[k]), 0.01, 0.01 * 0.03);
    EXPECT_NEAR(std::sqrt(grasp_t[k]), 0.00125, 0.00125 * 0.03);
    EXPECT_NEAR(std::sqrt(grasp_r[k]), 0.001, 0.001 * 0.03);
  }
  EXPECT_NEAR(friction, 0.5, 0.005);
  EXPECT_NEAR(std::sqrt(friction2 - friction * friction), 0.1, 0.003);
}

TEST(DrawNoise, NeverDrawsNegativeFriction) {
  MetricOptions options;
  options.friction_std = 1.0;
  RngStream rng(6, "noise");
  int zeros = 0;
  for (int i = 0; i < 1000; ++i) {
    const double friction = DrawNoise(options, &rng).friction;
    EXPECT_GE(friction, 0.0);
    zeros += friction == 0.0 ? 1 : 0;
  }
  EXPECT_NEAR(zeros / 1000.0, 0.309, 0.05);  // Phi(-0.5)
}

TEST(DrawNoise, DrawsOfTwoNoiseLevelsPairUp) {
  MetricOptions small, large;
  ApplyNoisePreset("dexnet", &large);
  RngStream a(7, "noise"), b(7, "noise");
  for (int i = 0; i < 10; ++i) {
    const NoiseDraw x = DrawNoise(small, &a), y = DrawNoise(large, &b);
    EXPECT_LT((4.0 * x.object_translation - y.object_translation).norm(), 1e-15);
    EXPECT_EQ(x.friction, y.friction);
  }
}

}  // namespace
}  // namespace antigrasp
