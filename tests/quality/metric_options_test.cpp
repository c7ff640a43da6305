#include "antigrasp/quality/metric_options.h"

#include <gtest/gtest.h>

#include "antigrasp/core/error.h"
#include "tests/quality/option_lines.h"

namespace antigrasp {
namespace {

// Every field different from its default.
MetricOptions Unusual() {
  return {0.37,
          6,
          0.004,
          900.0,
          Torsion::kNone,
          0.03,
          0.06,
          11,
          12,
          13,
          2e-3,
          60.0,
          true,
          0.001,
          0.02,
          0.003,
          0.04,
          0.05,
          Collision::kJaws,
          {0.01, 0.02, 0.03, 0.04, 0.05, 0.06, 0.07, 0.08, 9},
          LengthUnit::kIn,
          TipContact::kPad,
          ClosingEnd::kSettled,
          0.004,
          0.014,
          0.015,
          0.016,
          17.0,
          Summary::kMean};
}

void ExpectEqual(const MetricOptions& a, const MetricOptions& b) {
  EXPECT_EQ(a.friction, b.friction);
  EXPECT_EQ(a.cone_edges, b.cone_edges);
  EXPECT_EQ(a.finger_radius, b.finger_radius);
  EXPECT_EQ(a.torque_scale, b.torque_scale);
  EXPECT_EQ(a.torsion, b.torsion);
  EXPECT_EQ(a.object_min_extent, b.object_min_extent);
  EXPECT_EQ(a.jaw_opening, b.jaw_opening);
  EXPECT_EQ(a.num_grasps, b.num_grasps);
  EXPECT_EQ(a.num_draws, b.num_draws);
  EXPECT_EQ(a.max_attempts, b.max_attempts);
  EXPECT_EQ(a.grasp_separation, b.grasp_separation);
  EXPECT_EQ(a.percentile, b.percentile);
  EXPECT_EQ(a.adaptive, b.adaptive);
  EXPECT_EQ(a.object_translation_std, b.object_translation_std);
  EXPECT_EQ(a.object_rotation_std, b.object_rotation_std);
  EXPECT_EQ(a.grasp_translation_std, b.grasp_translation_std);
  EXPECT_EQ(a.grasp_rotation_std, b.grasp_rotation_std);
  EXPECT_EQ(a.friction_std, b.friction_std);
  EXPECT_EQ(a.collision, b.collision);
  EXPECT_EQ(a.contact, b.contact);
  EXPECT_EQ(a.closing, b.closing);
  EXPECT_EQ(a.ball_radius, b.ball_radius);
  EXPECT_EQ(a.patch_width, b.patch_width);
  EXPECT_EQ(a.patch_height, b.patch_height);
  EXPECT_EQ(a.held_mass, b.held_mass);
  EXPECT_EQ(a.grip_force, b.grip_force);
  EXPECT_EQ(a.summary, b.summary);
  EXPECT_EQ(a.gripper.palm_distance, b.gripper.palm_distance);
  EXPECT_EQ(a.gripper.fingertip_overlap, b.gripper.fingertip_overlap);
  EXPECT_EQ(a.gripper.finger_width, b.gripper.finger_width);
  EXPECT_EQ(a.gripper.finger_thickness, b.gripper.finger_thickness);
  EXPECT_EQ(a.gripper.palm_depth, b.gripper.palm_depth);
  EXPECT_EQ(a.gripper.palm_length, b.gripper.palm_length);
  EXPECT_EQ(a.gripper.palm_width, b.gripper.palm_width);
  EXPECT_EQ(a.gripper.approach_distance, b.gripper.approach_distance);
  EXPECT_EQ(a.gripper.approach_angles, b.gripper.approach_angles);
  EXPECT_EQ(a.units, b.units);
}

TEST(MetricOptions, EveryFieldSurvivesTheConfigurationFile) {
  MetricOptions written = Unusual(), read;
  OptionTable out, in;
  Bind(&out, &written);
  Bind(&in, &read);
  EXPECT_EQ(out.options().size(), 37u);
  in.ApplyText(out.Dump(), "dump");
  ExpectEqual(read, Unusual());
}

TEST(MetricOptions, EveryKeyIsBoundToItsFieldAndEveryDefaultIsItsNumber) {
  EXPECT_EQ(LinesOf(MetricOptions()),
            (std::vector<std::string>{"metric.friction = 0.5",
                                      "metric.cone_edges = 8",
                                      "metric.finger_radius = 0.005",
                                      "metric.torque_scale = 1000.0",
                                      "metric.torsion = 'dexnet'",
                                      "metric.object_min_extent = 0.04",
                                      "metric.units = 'm'",
                                      "metric.jaw_opening = 0.05",
                                      "metric.num_grasps = 100",
                                      "metric.num_draws = 25",
                                      "metric.max_attempts = 4000",
                                      "metric.grasp_separation = 1e-04",
                                      "metric.adaptive = false",
                                      "metric.percentile = 75.0",
                                      "metric.object_translation_std = 0.0025",
                                      "metric.object_rotation_std = 0.01",
                                      "metric.grasp_translation_std = 0.00125",
                                      "metric.grasp_rotation_std = 0.001",
                                      "metric.friction_std = 0.1",
                                      "metric.collision = 'gripper'",
                                      "metric.contact = 'point'",
                                      "metric.closing = 'first'",
                                      "metric.ball_radius = 0.005",
                                      "metric.patch_width = 0.02",
                                      "metric.patch_height = 0.02",
                                      "metric.held_mass = 0.05",
                                      "metric.grip_force = 15.0",
                                      "metric.summary = 'percentile'",
                                      "gripper.palm_distance = 0.046",
                                      "gripper.fingertip_overlap = 0.01",
                                      "gripper.finger_width = 0.02",
                                      "gripper.finger_thickness = 0.01",
                                      "gripper.palm_depth = 0.084",
                                      "gripper.palm_length = 0.08",
                                      "gripper.palm_width = 0.05",
                                      "gripper.approach_distance = 0.1",
                                      "gripper.approach_angles = 16"}));
  EXPECT_EQ(LinesOf(Unusual()), (std::vector<std::string>{"metric.friction = 0.37",
                                                          "metric.cone_edges = 6",
                                                          "metric.finger_radius = 0.004",
                                                          "metric.torque_scale = 900.0",
                                                          "metric.torsion = 'none'",
                                                          "metric.object_min_extent = 0.03",
                                                          "metric.units = 'in'",
                                                          "metric.jaw_opening = 0.06",
                                                          "metric.num_grasps = 11",
                                                          "metric.num_draws = 12",
                                                          "metric.max_attempts = 13",
                                                          "metric.grasp_separation = 0.002",
                                                          "metric.adaptive = true",
                                                          "metric.percentile = 60.0",
                                                          "metric.object_translation_std = 0.001",
                                                          "metric.object_rotation_std = 0.02",
                                                          "metric.grasp_translation_std = 0.003",
                                                          "metric.grasp_rotation_std = 0.04",
                                                          "metric.friction_std = 0.05",
                                                          "metric.collision = 'jaws'",
                                                          "metric.contact = 'pad'",
                                                          "metric.closing = 'settled'",
                                                          "metric.ball_radius = 0.004",
                                                          "metric.patch_width = 0.014",
                                                          "metric.patch_height = 0.015",
                                                          "metric.held_mass = 0.016",
                                                          "metric.grip_force = 17.0",
                                                          "metric.summary = 'mean'",
                                                          "gripper.palm_distance = 0.01",
                                                          "gripper.fingertip_overlap = 0.02",
                                                          "gripper.finger_width = 0.03",
                                                          "gripper.finger_thickness = 0.04",
                                                          "gripper.palm_depth = 0.05",
                                                          "gripper.palm_length = 0.06",
                                                          "gripper.palm_width = 0.07",
                                                          "gripper.approach_distance = 0.08",
                                                          "gripper.approach_angles = 9"}));
}

TEST(MetricPreset, EachIsTheseNumbers) {
  const GripperModel yumi{0.046, 0.010, 0.020, 0.010, 0.084, 0.080, 0.050, 0.100, 16};
  MetricOptions options;
  ApplyMetricPreset("dexnet", &options);
  ExpectEqual(options, {0.5,
                        8,
                        0.005,
                        1000.0,
                        Torsion::kDexNet,
                        0.040,
                        0.05,
                        25,
                        25,
                        4000,
                        1e-4,
                        75.0,
                        false,
                        0.01,
                        0.01,
                        0.005,
                        0.001,
                        0.1,
                        Collision::kJaws,
                        yumi});
  ApplyMetricPreset("egad", &options);
  ExpectEqual(
      options,
      {0.5, 8,   0.005, 100.0, Torsion::kDexNet, 0.040, 0.05, 100, 1, 4000, 1e-4, 75.0, false, 0.0,
       0.0, 0.0, 0.0,   0.0,   Collision::kJaws, yumi});
  ApplyMetricPreset("default", &options);
  ExpectEqual(options, {0.5,
                        8,
                        0.005,
                        1000.0,
                        Torsion::kDexNet,
                        0.040,
                        0.05,
                        100,
                        25,
                        4000,
                        1e-4,
                        75.0,
                        false,
                        0.0025,
                        0.01,
                        0.00125,
                        0.001,
                        0.1,
                        Collision::kGripper,
                        yumi});
}

TEST(MetricPreset, SetsEveryConstantWhateverWasThere) {
  EXPECT_EQ(MetricPresetNames(),
            (std::vector<std::string>{"default", "settled", "dexnet", "egad"}));
  for (const std::string& name : MetricPresetNames()) {
    MetricOptions a, b = Unusual();
    ApplyMetricPreset(name, &a);
    ApplyMetricPreset(name, &b);
    ExpectEqual(a, b);
  }
  MetricOptions unchanged = Unusual();
  ApplyMetricPreset("default", &unchanged);
  ExpectEqual(unchanged, MetricOptions());
}

TEST(MetricPreset, DexNetHasItsConfigurationsConstants) {
  MetricOptions options;
  ApplyMetricPreset("dexnet", &options);
  EXPECT_EQ(options.friction, 0.5);
  EXPECT_EQ(options.torque_scale, 1000.0);
  EXPECT_EQ(options.object_min_extent, 0.040);
  EXPECT_EQ(options.num_grasps, 25);
  EXPECT_EQ(options.num_draws, 25);
  EXPECT_EQ(options.object_translation_std, 0.01);
  EXPECT_EQ(options.object_rotation_std, 0.01);
  EXPECT_EQ(options.grasp_translation_std, 0.005);
  EXPECT_EQ(options.grasp_rotation_std, 0.001);
  EXPECT_EQ(options.friction_std, 0.1);
  EXPECT_EQ(options.collision, Collision::kJaws);
}

TEST(MetricPreset, EgadIsWithoutNoiseAndHasATenthOfTheTorqueScale) {
  MetricOptions options;
  ApplyMetricPreset("egad", &options);
  EXPECT_EQ(options.torque_scale, 100.0);
  EXPECT_EQ(options.num_grasps, 100);
  EXPECT_EQ(options.num_draws, 1);
  EXPECT_EQ(options.collision, Collision::kJaws);
  EXPECT_EQ(options.percentile, 75.0);
  EXPECT_EQ(options.object_translation_std, 0.0);
  EXPECT_EQ(options.object_rotation_std, 0.0);
  EXPECT_EQ(options.grasp_translation_std, 0.0);
  EXPECT_EQ(options.grasp_rotation_std, 0.0);
  EXPECT_EQ(options.friction_std, 0.0);
}

TEST(MetricPreset, AnUnknownNameIsRefusedAndChangesNothing) {
  MetricOptions options = Unusual();
  EXPECT_THROW(ApplyMetricPreset("eggad", &options), InputError);
  EXPECT_THROW(ApplyMetricPreset("", &options), InputError);
  ExpectEqual(options, Unusual());
}

TEST(EgadScore, IsLinearBetweenItsTwoEndsAndHigherForEasierObjects) {
  EXPECT_EQ(EgadScore(0.0), 0.0);
  EXPECT_EQ(EgadScore(0.0005), 0.0);
  EXPECT_NEAR(EgadScore(0.00225), 50.0, 1e-12);
  EXPECT_EQ(EgadScore(0.004), 100.0);
  EXPECT_EQ(EgadScore(1.0), 100.0);
  EXPECT_LT(EgadScore(0.001), EgadScore(0.0011));
}

TEST(MetricOptions, EveryKeyRefusesAValueJustOutsideItsRange) {
  MetricOptions options;
  OptionTable table;
  Bind(&table, &options);
  for (const Option& option : table.options()) {
    EXPECT_TRUE(option.key.starts_with("metric.") || option.key.starts_with("gripper."));
    EXPECT_FALSE(option.help.empty()) << option.key;
    EXPECT_THROW(table.ApplyOverride(option.key + "=-1"), InputError) << option.key;
    EXPECT_THROW(table.ApplyOverride(option.key + "=nan"), InputError) << option.key;
    EXPECT_THROW(table.ApplyOverride(option.key + "=2000000000"), InputError) << option.key;
  }
  EXPECT_THROW(table.ApplyOverride("metric.cone_edges=2"), InputError);
  EXPECT_THROW(table.ApplyOverride("metric.num_draws=0"), InputError);
  EXPECT_THROW(table.ApplyOverride("metric.percentile=100.5"), InputError);
  EXPECT_THROW(table.ApplyOverride("metric.no_such_key=1"), InputError);
  EXPECT_THROW(table.ApplyOverride("metric.collision=jaw"), InputError);
  EXPECT_THROW(table.ApplyOverride("metric.torsion=rubber"), InputError);
  EXPECT_THROW(table.ApplyOverride("metric.units=inch"), InputError);
  EXPECT_THROW(table.ApplyOverride("gripper.approach_angles=0"), InputError);
  ExpectEqual(options, MetricOptions{});
}

TEST(MetricOptions, DefaultPresetIsTheDefault) {
  MetricOptions options;
  ApplyNoisePreset("dexnet", &options);
  ApplyNoisePreset("default", &options);
  ExpectEqual(options, MetricOptions{});
}

TEST(MetricOptions, PresetsTouchOnlyTheNoise) {
  MetricOptions options = Unusual();
  ApplyNoisePreset("dexnet", &options);
  MetricOptions expected = Unusual();
  expected.object_translation_std = 0.01;
  expected.object_rotation_std = 0.01;
  expected.grasp_translation_std = 0.005;
  expected.grasp_rotation_std = 0.001;
  expected.friction_std = 0.1;
  ExpectEqual(options, expected);
  ApplyNoisePreset("none", &options);
  expected.object_translation_std = expected.object_rotation_std = 0.0;
  expected.grasp_translation_std = expected.grasp_rotation_std = expected.friction_std = 0.0;
  ExpectEqual(options, expected);
}

TEST(MetricOptions, AnUnknownPresetIsRefusedByName) {
  MetricOptions options;
  try {
    ApplyNoisePreset("loud", &options);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("loud"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("dexnet"), std::string::npos);
  }
}

}  // namespace
}  // namespace antigrasp
