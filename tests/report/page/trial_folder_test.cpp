#include "antigrasp/report/page/trial_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "antigrasp/core/error.h"
#include "antigrasp/report/page/payload.h"
#include "tests/report/page/inflated.h"
#include "tests/support/temp_folder.h"

namespace antigrasp {
namespace {

using TrialJson = nlohmann::json;

// Columns in another order than the document's, and one that nobody asks for.
constexpr char kShares[] =
    "engine,object,side,protocol,masses,friction,held_low,held,held_high\n"
    "x,mug,after,six-ways,own,0.25,0.4,0.5,0.6\n"
    "x,mug,before,six-ways,own,0.25,0.7,0.8,0.9\n"
    "x,mug,after,six-ways,equal,0.25,0.2,0.25,0.3\n"
    "x,cup,after,paper,own,0.3,,0.125,\n"
    "x,elsewhere,after,paper,own,0.3,0,0,0.1\n";
constexpr char kExecutions[] =
    "object,side,protocol,masses,grasp,execution,robust_quality,outcome\n"
    "mug,after,six-ways,own,7,0,0.002,slipped\n"
    "mug,after,six-ways,own,7,1,0.002,held\n"
    "mug,before,six-ways,own,7,0,0.003,held\n"
    "mug,after,six-ways,own,9,0,0.001,lost closing\n"
    "mug,after,six-ways,own,7,2,0.002,slipped\n"
    "mug,after,six-ways,equal,7,0,0.002,slipped\n"
    "cup,,paper,own,2,0,,held\n";
constexpr char kReplays[] = R"({"format": "antigrasp.replays", "version": 1, "replays": [
  {"object": "mug", "side": "after", "protocol": "six-ways", "grasp": 7, "execution": 1,
   "outcome": "held", "friction": 0.52, "metres_per_unit": 0.001,
   "tip": {"kind": "sphere", "radius": 0.005}, "up": [0, 0, 1], "frames": [
     {"t": 0.25, "object": [1, 2, 3, 1, 0, 0, 0], "tips": [[-1, 0, 0], [1, 0, 0]], "forces": [],
      "table": -0.5},
     {"t": 0.5, "object": [1, 2, 4, 1, 0, 0, 0], "tips": [[-1, 0, 0], [1, 0, 0]],
      "forces": [[1, 2, 3, 4, 5, 6]]}]}]})";

class TrialFolder : public ::testing::Test {
 protected:
  TrialFolder() {
    folder_.Write("trials.csv", kShares);
    folder_.Write("executions.csv", kExecutions);
    for (const char* name : {"cup", "mug", "jug"}) {
      ReportObject object;
      object.name = name;
      object.status = "ok";
      report_.objects.push_back(object);
    }
  }

  std::string Path() const { return folder_.path().string(); }
  std::string MessageOf() {
    try {
      AddTrials(ReadTrials({Path()}), &report_);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  // kReplays with one text exchanged.
  std::string MessageWith(const std::string& from, const std::string& to) {
    std::string text = kReplays;
    text.replace(text.find(from), from.size(), to);
    folder_.Write("replays.json", text);
    return MessageOf();
  }

  shapes::TempFolder folder_;
  Report report_;
};

TEST_F(TrialFolder, GivesObjectsTheSharesOfTheirName) {
  AddTrials(ReadTrials({Path()}), &report_);
  const ReportTrials& mug = *report_.objects[1].trials;
  ASSERT_EQ(mug.series.size(), 3U);
  EXPECT_EQ(mug.series[0].protocol, "six-ways");
  EXPECT_FALSE(mug.series[0].before);
  EXPECT_TRUE(mug.series[1].before);
  EXPECT_EQ(mug.series[0].friction, 0.25);
  EXPECT_EQ(mug.series[0].held, 0.5);
  EXPECT_EQ(mug.series[0].low, 0.4);
  EXPECT_EQ(mug.series[0].high, 0.6);
  EXPECT_EQ(mug.series[1].held, 0.8);
  EXPECT_EQ(mug.series[1].masses, "own");
  EXPECT_EQ(mug.series[2].masses, "equal");
  EXPECT_EQ(mug.series[2].held, 0.25);
  EXPECT_TRUE(std::isnan(report_.objects[0].trials->series[0].low));
  EXPECT_FALSE(report_.objects[2].trials);
}

TEST_F(TrialFolder, CountsTheExecutionsOfEveryGraspBySideAndOutcome) {
  AddTrials(ReadTrials({Path()}), &report_);
  const auto& grasps = report_.objects[1].trials->grasps;
  ASSERT_EQ(grasps.size(), 4U);
  EXPECT_EQ(grasps[0].grasp, 7);
  EXPECT_EQ(grasps[0].series, 0U);
  EXPECT_EQ(grasps[0].quality, 0.002);
  EXPECT_EQ(grasps[0].held, 1);
  EXPECT_EQ(grasps[0].executions, 3);
  EXPECT_EQ(grasps[0].outcomes,
            (std::vector<std::pair<std::string, int>>{{"slipped", 2}, {"held", 1}}));
  EXPECT_EQ(grasps[1].series, 1U);
  EXPECT_EQ(grasps[1].held, 1);
  EXPECT_EQ(grasps[2].grasp, 9);
  EXPECT_TRUE(std::isnan(report_.objects[0].trials->grasps[0].quality));
}

TEST_F(TrialFolder, JoinsFoldersOfOneProtocolEach) {
  folder_.Write("b/trials.csv", "object,protocol,held,held_low,held_high\nmug,paper,1,0.75,1\n");
  folder_.Write("b/executions.csv",
                "object,protocol,grasp,robust_quality,outcome\nmug,paper,7,0.5,held\n");
  const ReportTrials mug = ReadTrials({Path(), (folder_ / "b").string()}).at("mug");
  ASSERT_EQ(mug.series.size(), 4U);
  EXPECT_EQ(mug.series[3].protocol, "paper");
  EXPECT_EQ(mug.grasps.back().series, 3U);
  EXPECT_EQ(mug.grasps.back().quality, 0.5);
  EXPECT_THROW(ReadTrials({Path(), Path()}), InputError);
}

TEST_F(TrialFolder, SaysWhatHasNoPartner) {
  AddTrials(ReadTrials({Path()}), &report_);
  ASSERT_EQ(report_.missing.size(), 2U);
  EXPECT_EQ(report_.missing[0], "1 of 3 objects with trials are not shown here: elsewhere.");
  EXPECT_EQ(report_.missing[1], "1 of 3 objects have no trials.");
}

TEST_F(TrialFolder, FindsAPerturbedObjectByTheFileItWasWrittenTo) {
  folder_.Write("trials.csv",
                "object,protocol,held,held_low,held_high\njug.stl,paper,0.5,0.25,0.75\n");
  folder_.Write("executions.csv", "object,protocol,grasp,robust_quality,outcome\n");
  AddTrials(ReadTrials({Path()}), &report_);
  EXPECT_FALSE(report_.objects[1].trials);
  ASSERT_TRUE(report_.objects[2].trials);
  EXPECT_EQ(report_.objects[2].trials->series[0].held, 0.5);
  EXPECT_EQ(report_.missing, std::vector<std::string>{"2 of 3 objects have no trials."});
  Report of_meshes;  // an OBJ file is written as STL
  of_meshes.objects.resize(1);
  of_meshes.objects[0].name = "jug.obj";
  AddTrials(ReadTrials({Path()}), &of_meshes);
  EXPECT_TRUE(of_meshes.objects[0].trials);
  EXPECT_TRUE(of_meshes.missing.empty());
}

TEST_F(TrialFolder, PutsReplaysIntoThePageAsTheyAre) {
  folder_.Write("replays.json", kReplays);
  AddTrials(ReadTrials({Path()}), &report_);
  const ReportPayload payload = EncodeReport(report_, {});
  const TrialJson objects = TrialJson::parse(payload.json)["objects"];
  EXPECT_FALSE(objects[2].contains("trials"));
  const TrialJson trials = objects[1]["trials"];
  EXPECT_EQ(trials["series"][0], TrialJson::parse(R"({"protocol": "six-ways", "side": "after",
      "masses": "own", "friction": 0.25, "held": 0.5, "low": 0.4, "high": 0.6})"));
  EXPECT_EQ(objects[0]["trials"]["series"][0]["low"], nullptr);
  EXPECT_EQ(trials["grasps"][0], TrialJson::parse(R"({"series": 0, "grasp": 7, "quality": 0.002,
      "held": 1, "executions": 3, "outcomes": [["slipped", 2], ["held", 1]]})"));
  TrialJson replay = trials["replays"][0];
  const std::size_t offset = replay["frames"][0], length = replay["frames"][1];
  const std::string frames = Inflated(payload.blob.substr(offset, length), replay["frames"][2]);
  const TrialJson original = TrialJson::parse(kReplays)["replays"][0];
  EXPECT_EQ(TrialJson::parse(frames), original["frames"]);
  replay["frames"] = original["frames"];
  replay["object"] = "mug";
  EXPECT_EQ(replay, original);
}

TEST_F(TrialFolder, RefusesAFolderWithoutItsTables) {
  std::filesystem::remove(folder_ / "executions.csv");
  EXPECT_EQ(MessageOf(), "no executions.csv (" + Path() +
                             "): expected a folder that antigrasp trial wrote, with trials.csv and "
                             "executions.csv");
}

TEST_F(TrialFolder, RefusesTablesThatSayNothingOrSayItTwice) {
  folder_.Write("executions.csv", "object,protocol,grasp,outcome\n");
  EXPECT_NE(MessageOf().find("robust_quality"), std::string::npos);
  folder_.Write("executions.csv",
                "object,protocol,grasp,robust_quality,outcome\nmug,paper,1.5,0,held\n");
  EXPECT_EQ(MessageOf(), "grasp = 1.5 (" + (folder_ / "executions.csv").string() +
                             ":2): expected a whole number");
  folder_.Write("trials.csv",
                "object,protocol,held,held_low,held_high\nmug,paper,1,1,1\nmug,paper,0,0,0\n");
  EXPECT_EQ(MessageOf(),
            "mug under paper once more (" + (folder_ / "trials.csv").string() +
                ":3): expected one row for an object, protocol, side and kind of mass");
}

TEST_F(TrialFolder, SaysWhereAReplayIsNotAsItShouldBe) {
  const std::string file = " (" + (folder_ / "replays.json").string() + "): expected ";
  EXPECT_EQ(MessageWith("antigrasp.replays", "replays"),
            "format = \"replays\"" + file + "\"antigrasp.replays\"");
  EXPECT_EQ(MessageWith("\"version\": 1", "\"version\": 2"), "version = 2" + file + "1");
  EXPECT_EQ(MessageWith("[1, 2, 4, 1, 0, 0, 0]", "[1, 2, 4]"),
            "replays[0].frames[1].object = [1,2,4]" + file + "7 numbers");
  EXPECT_EQ(MessageWith("[[1, 2, 3, 4, 5, 6]]", "[[1, 2, 3, 4, 5, null]]"),
            "replays[0].frames[1].forces[0] = [1,2,3,4,5,null]" + file + "6 numbers");
  EXPECT_EQ(MessageWith("\"t\": 0.5", "\"t\": 0.25"),
            "replays[0].frames[1].t = 0.25" + file + "a time after the frame before");
  EXPECT_EQ(MessageWith("\"sphere\"", "\"cone\""),
            "replays[0].tip.kind = \"cone\"" + file + "\"sphere\" or \"pad\"");
  EXPECT_EQ(MessageWith("0.001", "0"),
            "replays[0].metres_per_unit = 0" + file + "a number above 0");
  EXPECT_NE(MessageWith("\"up\": [0, 0, 1], ", "").find("the key \"up\""), std::string::npos);
  EXPECT_NE(MessageWith("}]}]}", "}]}").find("expected JSON: "), std::string::npos);
}

}  // namespace
}  // namespace antigrasp
