#include "antigrasp/trial/replay_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "antigrasp/core/atomic_file.h"
#include "tests/support/temp_folder.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

ReplayMoment MomentAt(double seconds) {
  ReplayMoment moment;
  moment.seconds = seconds;
  moment.tips = {Vector3d(-0.025, 0.0, 0.0), Vector3d(0.025, 0.0, 0.0)};
  return moment;
}

Replay Slipped() {
  Replay replay;
  replay.object = "a \"mug\"\n";
  replay.protocol = "six-ways";
  replay.outcome = "slipped";
  replay.grasp = 12;
  replay.execution = 3;
  replay.friction = 0.52;
  replay.metres_per_unit = 0.001;
  replay.half = Vector3d::Constant(0.005);
  return replay;
}

std::string WrittenText(const std::vector<Replay>& replays) {
  const shapes::TempFolder folder;
  WriteReplays(folder / "replays.json", replays);
  return ReadFile(folder / "replays.json");
}

int CountOf(const std::string& text, const std::string& part) {
  int count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(WriteReplays, WritesWhatTheDocumentShows) {
  Replay replay = Slipped();
  ReplayMoment first = MomentAt(0.31);
  // A quarter turn about z, and a third of a metre in six digits.
  first.object.translation() = Vector3d(1.0 / 3.0, 0.001, -0.02);
  first.object.linear() =
      Eigen::AngleAxisd(0.5 * std::numbers::pi, Vector3d::UnitZ()).toRotationMatrix();
  first.forces.emplace_back(Vector3d(-0.02, 0.0, 0.0), Vector3d(15.0, 0.0, 0.2));
  first.forces.emplace_back(Vector3d(0.02, 0.0, 0.0), Vector3d(-15.0, 0.0, 0.3));
  first.table = -0.04;
  replay.moments = {first, MomentAt(0.32)};
  Replay pad = replay;
  pad.pad = pad.before = true;
  pad.half = Vector3d(0.002, 0.01, 0.008);
  const std::string frames =
      R"("frames": [
     {"t": 0.31, "object": [0.333333, 0.001, -0.02, 0.707107, 0, 0, 0.707107], "tips": [[-0.025, 0, 0], [0.025, 0, 0]], "forces": [[-0.02, 0, 0, 15, 0, 0.2], [0.02, 0, 0, -15, 0, 0.3]], "table": -0.04},
     {"t": 0.32, "object": [0, 0, 0, 1, 0, 0, 0], "tips": [[-0.025, 0, 0], [0.025, 0, 0]], "forces": [], "table": null}]})";
  const std::string who =
      R"("protocol": "six-ways", "grasp": 12, "execution": 3, "outcome": "slipped",
   "friction": 0.52, "metres_per_unit": 0.001, )";
  EXPECT_EQ(WrittenText({replay, pad}),
            R"({"format": "antigrasp.replays", "version": 1, "replays": [
  {"object": "a \"mug\"\u000a", "side": "after", )" + who +
                R"("tip": {"kind": "sphere", "radius": 0.005}, "up": [0, 0, 1],
   )" + frames + R"(,
  {"object": "a \"mug\"\u000a", "side": "before", )" + who +
                R"("tip": {"kind": "pad", "half": [0.002, 0.01, 0.008]}, "up": [0, 0, 1],
   )" + frames + "]}\n");
}

TEST(WriteReplays, KeepsAtMost120MomentsTheFirstAndTheLastAmongThem) {
  Replay replay = Slipped();
  for (int i = 0; i <= 1000; ++i) replay.moments.push_back(MomentAt(0.001 * (i + 1)));
  const std::string text = WrittenText({replay});
  EXPECT_EQ(CountOf(text, "\"t\": "), 120);
  EXPECT_EQ(CountOf(text, "\"t\": 0.001,"), 1);
  EXPECT_EQ(CountOf(text, "\"t\": 1.001,"), 1);
}

TEST(WriteReplays, LeavesOutWhatIsNoNumberAndWhatIsTooShort) {
  Replay broken = Slipped();
  broken.moments = {MomentAt(0.1), MomentAt(0.2), MomentAt(0.3)};
  broken.moments[1].object.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(CountOf(WrittenText({broken}), "\"t\": "), 2);
  broken.moments.pop_back();
  EXPECT_EQ(WrittenText({broken}),
            "{\"format\": \"antigrasp.replays\", \"version\": 1, \"replays\": []}\n");
}

}  // namespace
}  // namespace antigrasp
