#include "antigrasp/quality/named_gripper.h"

#include <gtest/gtest.h>

#include "antigrasp/core/error.h"
#include "antigrasp/mesh/inspect.h"
#include "antigrasp/quality/graspability.h"
#include "tests/support/shapes.h"
#include "tests/support/temp_folder.h"

namespace antigrasp {
namespace {

using shapes::TempFolder;

// Every length another number, and no two grippers' the same.
constexpr const char* kMine =
    "[metric]\njaw_opening = 0.11\n"
    "[gripper]\npalm_distance = 0.012\nfingertip_overlap = 0.013\nfinger_width = 0.014\n"
    "finger_thickness = 0.015\npalm_depth = 0.016\npalm_length = 0.17\npalm_width = 0.018\n";

std::string WhyRefused(const std::string& name_or_file) {
  MetricOptions options;
  options.jaw_opening = 0.0123;
  try {
    ApplyGripper(name_or_file, &options);
  } catch (const InputError& error) {
    EXPECT_EQ(options.jaw_opening, 0.0123);
    EXPECT_EQ(options.gripper.palm_length, GripperModel{}.palm_length);
    return error.what();
  }
  return "taken";
}

TEST(NamedGripper, SetsOpeningAndBoxesAndLeavesTheRestOfTheMetric) {
  MetricOptions options;
  options.friction = 0.3;
  options.gripper.approach_distance = 0.2;
  options.gripper.approach_angles = 5;
  ApplyGripper("panda", &options);
  EXPECT_EQ(options.jaw_opening, 0.080);
  EXPECT_EQ(options.gripper.palm_distance, 0.0374);
  EXPECT_EQ(options.gripper.fingertip_overlap, 0.0095);
  EXPECT_EQ(options.gripper.finger_width, 0.0175);
  EXPECT_EQ(options.gripper.finger_thickness, 0.0152);
  EXPECT_EQ(options.gripper.palm_depth, 0.0660);
  EXPECT_EQ(options.gripper.palm_length, 0.2044);
  EXPECT_EQ(options.gripper.palm_width, 0.0633);
  EXPECT_EQ(options.friction, 0.3);
  EXPECT_EQ(options.gripper.approach_distance, 0.2);
  EXPECT_EQ(options.gripper.approach_angles, 5);
}

TEST(NamedGripper, TheYumiIsTheDefault) {
  MetricOptions options;
  ApplyGripper("yumi", &options);
  EXPECT_EQ(MetricToml(options, 1), MetricToml(MetricOptions{}, 1));
}

TEST(NamedGripper, EveryOneFitsAndItsNameSaysItsOpening) {
  for (const NamedGripper& gripper : NamedGrippers()) {
    MetricOptions options;
    ApplyGripper(std::string(gripper.name), &options);
    EXPECT_NO_THROW(RequireFittingGripper(options, "here")) << gripper.name;
    EXPECT_GE(options.gripper.palm_width, options.gripper.finger_width) << gripper.name;
  }
  MetricOptions options;
  ApplyGripper("robotiq_85", &options);
  EXPECT_EQ(options.jaw_opening, 0.085);
  ApplyGripper("robotiq_140", &options);
  EXPECT_EQ(options.jaw_opening, 0.140);
}

TEST(NamedGripper, AFileOfTheSameKeysIsOnesOwn) {
  const TempFolder folder;
  folder.Write("mine.toml", kMine);
  MetricOptions options;
  ApplyGripper((folder / "mine.toml").string(), &options);
  EXPECT_EQ(options.jaw_opening, 0.11);
  EXPECT_EQ(options.gripper.palm_distance, 0.012);
  EXPECT_EQ(options.gripper.fingertip_overlap, 0.013);
  EXPECT_EQ(options.gripper.finger_width, 0.014);
  EXPECT_EQ(options.gripper.finger_thickness, 0.015);
  EXPECT_EQ(options.gripper.palm_depth, 0.016);
  EXPECT_EQ(options.gripper.palm_length, 0.17);
  EXPECT_EQ(options.gripper.palm_width, 0.018);
  EXPECT_EQ(options.gripper.approach_distance, 0.1);  // the file does not say it
  folder.Write("way.toml", std::string(kMine) + "approach_distance = 0.3\napproach_angles = 7\n");
  ApplyGripper((folder / "way.toml").string(), &options);
  EXPECT_EQ(options.gripper.approach_distance, 0.3);
  EXPECT_EQ(options.gripper.approach_angles, 7);
}

TEST(NamedGripper, WhatIsPrintedOfOneIsAFileThatIsRead) {
  const TempFolder folder;
  for (const NamedGripper& gripper : NamedGrippers()) {
    MetricOptions written, read;
    ApplyGripper(std::string(gripper.name), &written);
    const GripperBase base = BaseOf(std::string(gripper.name));
    folder.Write("a.toml", GripperToml(written, base, "about"));
    ApplyGripper((folder / "a.toml").string(), &read);
    EXPECT_EQ(MetricToml(read, 1), MetricToml(written, 1)) << gripper.name;
    const GripperBase again = BaseOf((folder / "a.toml").string());
    EXPECT_EQ(GripperToml(read, again, ""), GripperToml(written, base, "")) << gripper.name;
  }
}

// Franka's hand closes along y of its link, YuMi's along x; a file without a word of it has z and
// x.
TEST(NamedGripper, SaysHowOtherProgramsKnowIt) {
  const GripperBase panda = BaseOf("panda"), yumi = BaseOf("yumi");
  EXPECT_EQ(panda.frame, "panda_hand");
  EXPECT_EQ(panda.Asset(), "franka_panda");
  EXPECT_EQ(panda.closing, LinkAxis::kY);
  EXPECT_EQ(panda.joint_open, 0.04);
  EXPECT_EQ(yumi.closing, LinkAxis::kX);
  const TempFolder folder;
  const std::string file = folder.Write("mine.toml", kMine).string();
  const GripperBase mine = BaseOf(file);
  EXPECT_EQ(mine.name, "mine");
  EXPECT_EQ(mine.Asset(), "mine");
  EXPECT_EQ(mine.approach, LinkAxis::kZ);
  EXPECT_EQ(mine.closing, LinkAxis::kX);
  EXPECT_EQ(mine.joints, "");
  folder.Write("mine.toml", std::string(kMine) + "[base]\napproach = \"-y\"\nclosing = \"y\"\n");
  EXPECT_EQ(WhyRefused(file),
            "base.closing = y (" + file + "): expected an axis across base.approach = -y");
}

TEST(NamedGripper, RefusesInALineAndChangesNothing) {
  const TempFolder folder;
  const auto refused = [&](const std::string& text) {
    folder.Write("f.toml", text);
    const std::string why = WhyRefused((folder / "f.toml").string());
    return why.substr(0, why.find(" (")) + why.substr(std::min(why.size(), why.find("): ")));
  };
  EXPECT_EQ(WhyRefused("robotik_85"),
            "no gripper robotik_85 (--gripper): expected yumi, panda, robotiq_85 or robotiq_140 or "
            "a TOML file; the nearest name is robotiq_85");
  EXPECT_NE(WhyRefused("no_such.toml").find("no_such.toml"), std::string::npos);
  std::string text = kMine;
  EXPECT_EQ(refused(text.replace(text.find("0.015"), 5, "-0.01")),
            "gripper.finger_thickness = -0.01): expected a number in [0, 100]");
  EXPECT_EQ(refused(std::string(kMine) + "palm = 1\n").substr(0, 24), "unknown key gripper.palm");
  text = kMine;
  EXPECT_EQ(refused(text.erase(text.find("finger_width"), 21)).substr(0, 23),
            "no gripper.finger_width");
  EXPECT_EQ(refused("[gripper]\n").substr(0, 22), "no metric.jaw_opening)");
  EXPECT_EQ(refused("[metric]\nfriction = 0.5\n").substr(0, 27), "unknown key metric.friction");
}

TEST(NamedGripper, APalmNarrowerThanTheOpenFingersDoesNotFit) {
  MetricOptions options;
  options.jaw_opening = 0.060;  // and two fingers of 10 mm: the palm's 80
  EXPECT_NO_THROW(RequireFittingGripper(options, "here"));
  options.jaw_opening = 0.085;
  try {
    RequireFittingGripper(options, "here");
    ADD_FAILURE() << "taken";
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()),
              "the palm is narrower than the open fingers: metric.jaw_opening = 0.085 (here): "
              "expected a palm of at least 0.105 m (it has 0.08), the opening and two fingers; "
              "--gripper sets what belongs together");
  }
  options.collision = Collision::kJaws;  // no palm is looked at
  EXPECT_NO_THROW(RequireFittingGripper(options, "here"));
}

TEST(NamedGripper, WhatAWiderGripperReachesANarrowOneDoesNot) {
  // A box whose narrowest side is 60 mm, as it is: wider than the YuMi's 50, not than 85.
  const TriangleMesh box = shapes::Box({0.060, 0.070, 0.080});
  MetricOptions options;
  options.object_min_extent = 0.0;
  options.num_grasps = 10;
  options.num_draws = 2;
  EXPECT_EQ(EvaluateGraspability(box, options, 1, 0).grasps.size(), 0U);
  ApplyGripper("robotiq_85", &options);
  EXPECT_EQ(EvaluateGraspability(box, options, 1, 0).grasps.size(), 10U);
}

TEST(GripperMesh, IsThreeClosedBoxesOfTheirVolumes) {
  const GripperModel model{0.01, 0.02, 0.03, 0.04, 0.05, 0.36, 0.07};
  const TriangleMesh mesh = GripperMesh(model, 0.2);
  const MeshReport report = Inspect(mesh);
  EXPECT_TRUE(report.closed);
  // Two fingers 30 mm long, 30 wide, 40 thick; a palm of 50 x 360 x 70.
  EXPECT_NEAR(report.volume, 2 * 0.03 * 0.03 * 0.04 + 0.05 * 0.36 * 0.07, 1e-12);
  const BoundingBox box = Bounds(mesh);
  EXPECT_NEAR((box.min - Eigen::Vector3d(-0.06, -0.18, -0.035)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((box.max - Eigen::Vector3d(0.02, 0.18, 0.035)).norm(), 0.0, 1e-12);
}

}  // namespace
}  // namespace antigrasp
