// What stands in the figures of `antigrasp figure`, of hand-made tables.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/mesh/mesh_file.h"
#include "tests/app/run_binary.h"
#include "tests/app/svg_text.h"
#include "tests/support/shapes.h"
#include "tests/support/temp_folder.h"

namespace antigrasp {
namespace {

using cli::Antigrasp;
using cli::DashedLinesIn;
using cli::Outcome;
using cli::TextsIn;
using shapes::TempFolder;
using Texts = std::vector<std::string>;

constexpr const char* kMeanLine = "3,1.5";
constexpr const char* kReferenceLine = "1.2,1.8";

std::string Drawn(const TempFolder& folder, const std::string& arguments) {
  const std::string out = (folder / "figure.svg").string();
  const Outcome outcome = Antigrasp("figure " + arguments + " --dpi 30 --out " + out);
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  return ReadFile(out);
}

// The texts that are no number of an axis.
Texts Words(const std::string& svg) {
  Texts words = TextsIn(svg);
  std::erase_if(words, [](const std::string& text) {
    return text.find_first_not_of("0123456789. %") == std::string::npos;
  });
  return words;
}

// A run as far as its tables: mean graspability 0.6 of the prior set, 0.2 of episode 0, 0.05 of
// episode 1; episode 2 is not there.
void WriteRun(const TempFolder& folder) {
  const std::string head =
      "object,status,num_grasps,ci_low,graspability,ci_high,mean,fraction_nonzero\n";
  folder.Write("run/config.toml", "[cem]\nepisodes = 2\ncontrol = false\n");
  folder.Write("run/prior_scores.csv", head + "0,ok,100,7,0.55,9,8,1\n1,ok,100,7,0.65,9,8,1\n");
  folder.Write(
      "run/episode_0/scores.csv",
      head +
          "0,ok,100,7,0.1,9,8,1\n1,ok,100,7,0.2,9,8,1\n2,ok,100,7,0.3,9,8,1\n3,disjoint,0,,,,,\n");
  folder.Write("run/episode_1/scores.csv", head + "0,ok,100,7,0.05,9,8,1\n");
}

TEST(FigureNumbersCli, Figure4IsInUnitsOfTheMeanOfEpisode0) {
  const TempFolder folder;
  WriteRun(folder);
  const std::string svg = Drawn(folder, "4 " + (folder / "run").string());
  EXPECT_EQ(Words(svg), (Texts{"Prior set", "\u03ba = 3.00", "n = 2", "Episode 0", "\u03ba = 1.00",
                               "n = 3", "Episode 1", "\u03ba = 0.25", "n = 1", "Episode 2",
                               "graspability / mean of episode 0", "not scored", "stage",
                               "episode 0", "share of the objects"}));
  // The reference beside every stage is episode 0, whose own mean stands on it.
  const auto means = DashedLinesIn(svg, kMeanLine), references = DashedLinesIn(svg, kReferenceLine);
  ASSERT_EQ(means.size(), 3u);
  ASSERT_EQ(references.size(), 3u);
  for (const double reference : references) EXPECT_EQ(reference, means[1]);
  EXPECT_GT(means[0], means[1]);
  EXPECT_LT(means[2], means[1]);
}

TEST(FigureNumbersCli, Figure4ShowsTheEpisodesThatAreAskedForBesideThePriorSet) {
  const TempFolder folder;
  WriteRun(folder);
  const Texts words = Words(Drawn(folder, "4 " + (folder / "run").string() + " --episodes 1"));
  EXPECT_EQ(Texts(words.begin(), words.begin() + 7),
            (Texts{"Prior set", "\u03ba = 3.00", "n = 2", "Episode 1",
                   "graspability / mean of episode 0", "\u03ba = 0.25", "n = 1"}));
}

TEST(FigureNumbersCli, Figure4FallsBackOnThePriorSetWithoutEpisode0) {
  const TempFolder folder;
  WriteRun(folder);
  std::filesystem::remove_all(folder / "run/episode_0");
  const std::string svg = Drawn(folder, "4 " + (folder / "run").string() + " --episodes 0 1");
  EXPECT_EQ(Words(svg), (Texts{"Prior set", "\u03ba = 1.00", "n = 2", "Episode 0", "not scored",
                               "Episode 1", "graspability / mean of the prior set", "\u03ba = 0.08",
                               "n = 1", "stage", "prior set", "share of the objects"}));
  const auto means = DashedLinesIn(svg, kMeanLine), references = DashedLinesIn(svg, kReferenceLine);
  ASSERT_EQ(references.size(), 2u);
  for (const double reference : references) EXPECT_EQ(reference, means.at(0));
}

// Three objects that lose 0.1, 0.3 and 0.35: the median is b; c is nearer to it than a. Failed ones
// and those without a number do not count. Means 0.5 and 0.25.
TEST(FigureNumbersCli, Figure3DividesByTheOriginalsAndShowsTheMedianChange) {
  const TempFolder folder;
  folder.Write("set/perturb.csv",
               "graspability_after,object,status,graspability_before\n"
               "0.3,a,ok,0.4\n0.2,b,ok,0.5\n0.25,c,ok,0.6\n9,d,after: open,9\n,e,ok,8\n");
  for (const char* part : {"before", "after"}) {
    std::filesystem::create_directories(folder / "set" / part);
    for (const char* name : {"a", "b", "c"}) {
      WriteMesh(folder / "set" / part / (std::string(name) + ".stl"), shapes::Cube());
    }
  }
  const std::string svg = Drawn(folder, "3 " + (folder / "set").string() + "/ --examples 2");
  EXPECT_EQ(Words(svg), (Texts{"original", "perturbed", "original", "perturbed", "set",
                               "g = 0.50000", "g = 0.20000", "g = 0.60000", "g = 0.25000",
                               "graspability / mean of the originals", "\u03ba = 0.50", "n = 3",
                               "perturbed", "originals", "share of the objects"}));
  EXPECT_LT(DashedLinesIn(svg, kMeanLine).at(0), DashedLinesIn(svg, kReferenceLine).at(0));
  const Texts named = Words(Drawn(folder, "3 " + (folder / "set").string() + " --label other"));
  EXPECT_EQ(named.at(2), "other");
}

TEST(FigureNumbersCli, Figure2NamesTheSectionAndTheAxesOfItsPlane) {
  const TempFolder folder;
  WriteMesh(folder / "box.stl", shapes::Box({1.0, 2.0, 3.0}));
  const std::string box = "2 " + (folder / "box.stl").string() + " --resolution 8";
  const Texts x = Words(Drawn(folder, box + " --axis x --position 0.1"));
  const auto has = [](const Texts& texts, const std::string& text) {
    return std::find(texts.begin(), texts.end(), text) != texts.end();
  };
  EXPECT_TRUE(has(x, "section at x = 0.1, zero contour")) << testing::PrintToString(x);
  EXPECT_TRUE(has(x, "y") && has(x, "z") && !has(x, "x")) << testing::PrintToString(x);
  const Texts z = Words(Drawn(folder, box));
  EXPECT_TRUE(has(z, "section at z = 0, zero contour")) << testing::PrintToString(z);
}

TEST(FigureNumbersCli, Figure1NamesObjectsByTheirFoldersAndSaysItsConeAndCounts) {
  const TempFolder folder;
  for (const char* part : {"one", "two"}) {
    std::filesystem::create_directories(folder / part);
    WriteMesh(folder / part / "cube.stl", shapes::Cube());
  }
  folder.Write("history.csv",
               "object,iteration,pairs,pairs_below_cone\nfirst,0,50,2\nfirst,10,40,30\n"
               "second,0,20,1\n");
  const std::string dir = folder.path().string();
  const Texts words = Words(Drawn(folder, "1 " + dir + "/one " + dir + "/two --history " + dir +
                                              "/history.csv --num-grasps 6 --num-draws 1 --shown "
                                              "4 --cone-angle 12.5"));
  const auto has = [&](const std::string& text) {
    return std::find(words.begin(), words.end(), text) != words.end();
  };
  for (const char* text : {"one/cube", "two/cube", "first", "second",
                           "4 most robust of 6 sampled grasps, friction cone of 12.5 degrees"}) {
    EXPECT_TRUE(has(text)) << text << " in " << testing::PrintToString(words);
  }
}

TEST(FigureNumbersCli, TrialsSayTheirJudgeTheirObjectsAndTheirSeries) {
  const TempFolder folder;
  const std::string head =
      "protocol,masses,friction,stage,grasps,objects,held,held_half_width,held_before,"
      "pairs,difference,difference_half_width,held_before_half_width\n";
  const std::string constants =
      "engine = \"mujoco 2.2.2\"\nequal_mass = 0.03\n[trial]\ntip = \"pad\"\n";
  folder.Write("low/means.csv", head +
                                    "six-ways,own,0.25,1 g,all,48,60,2,70,48,-10,1,2\n"
                                    "six-ways,equal,0.25,1 g,all,48,50,2,60,48,-10,1,2\n");
  folder.Write("low/trial.toml", constants);
  folder.Write("high/means.csv", head + "six-ways,own,0.5,1 g,all,50,80,2,,0,,,\n");
  folder.Write("high/trial.toml", constants);
  const std::string low = (folder / "low").string(), high = (folder / "high").string();
  const Texts words = Words(Drawn(folder, "trial " + low + " " + high));
  for (const char* text :
       {"friction", "held at 1 g, %", "own mass", "equal mass, 30 g", "after", "before", "load",
        "judge: mujoco 2.2.2, protocol six-ways, fingertip pad of 20 x 20 mm; 48 to 50 objects, "
        "all "
        "grasps; 95 % intervals over objects"}) {
    EXPECT_NE(std::find(words.begin(), words.end(), text), words.end())
        << text << " in " << testing::PrintToString(words);
  }
  const Texts alone = Words(Drawn(folder, "trial " + high));
  EXPECT_EQ(std::find(alone.begin(), alone.end(), "before"), alone.end());
  const Outcome twice =
      Antigrasp("figure trial " + low + " " + low + " --out " + (folder / "x.png").string());
  EXPECT_EQ(twice.code, 2);
  EXPECT_NE(twice.text.find("friction 0.25, own mass once more"), std::string::npos) << twice.text;
  EXPECT_FALSE(std::filesystem::exists(folder / "x.png"));
}

}  // namespace
}  // namespace antigrasp
