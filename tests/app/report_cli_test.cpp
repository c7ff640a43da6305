// The command report: what the page holds, which numbers agree with which table, what is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/csv_reader.h"
#include "antigrasp/datasets/shape_set.h"
#include "antigrasp/mesh/mesh_file.h"
#include "tests/app/run_binary.h"
#include "tests/support/shapes.h"
#include "tests/support/temp_folder.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;
using cli::Antigrasp;
using cli::ExpectRefused;
using cli::Outcome;
using nlohmann::json;
using shapes::TempFolder;

constexpr const char* kQuickReport = " --num-grasps 10 --num-draws 3 ";

// The data of a page.
json DataOf(const fs::path& page) {
  const std::string html = ReadFile(page);
  const std::string opening = "id=\"antigrasp-report\">";
  const std::size_t start = html.find(opening) + opening.size();
  return json::parse(html.substr(start, html.find("</script>", start) - start));
}

// A report that must succeed.
json ReportOf(const std::string& arguments, const fs::path& page) {
  const Outcome outcome = Antigrasp("report " + arguments + " --out " + page.string());
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_NE(outcome.text.find(page.string() + ": "), std::string::npos) << outcome.text;
  return outcome.code == 0 ? DataOf(page) : json::object();
}

// The graspability in a table by object; empty fields are left out.
std::map<std::string, double> ScoresIn(const fs::path& table, const char* column = "graspability") {
  std::map<std::string, double> scores;
  CsvReader csv(table);
  while (csv.Next()) {
    const auto score = csv.Number(*csv.Column(column));
    if (score) scores[csv.Field(*csv.Column("object"))] = *score;
  }
  return scores;
}

bool Mentions(const json& missing, const std::string& part) {
  return std::any_of(missing.begin(), missing.end(), [&](const json& sentence) {
    return sentence.get<std::string>().find(part) != std::string::npos;
  });
}

void MakeMeshes(const fs::path& folder) {
  fs::create_directory(folder);
  WriteMesh(folder / "ball.stl", shapes::Sphere(1.0, 2));
  WriteMesh(folder / "open.ply", shapes::FlatSquare());
  WriteMesh(folder / "<b>\"it's\" & \xC3\xBC.stl", shapes::Box({1.0, 1.5, 2.0}));
  WriteFileAtomic(folder / "noise.off", "rubbish");
}

TEST(ReportCli, ShowsObjectsWithTheScoresOfEvaluateAndTheBrokenOnesToo) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  MakeMeshes(folder / "in");
  ASSERT_EQ(Antigrasp("evaluate " + dir + "in" + kQuickReport + "--out " + dir + "s.csv").code, 0);
  const auto scores = ScoresIn(folder / "s.csv");
  const json data = ReportOf(dir + "in --title '<i>' " + kQuickReport, folder / "r.html");
  EXPECT_EQ(data["kind"], "objects");
  EXPECT_EQ(data["title"], "<i>");
  EXPECT_TRUE(data["run"].is_null());
  EXPECT_EQ(data["metric"]["num_draws"], 3);
  ASSERT_EQ(data["objects"].size(), 4u);
  for (const json& object : data["objects"]) {
    const std::string name = object["name"];
    const bool scored = scores.contains(name);
    EXPECT_EQ(object["score"].is_null(), !scored) << name;
    EXPECT_EQ(object["grasps"].is_null(), !scored) << name;
    EXPECT_EQ(object["mesh"].is_null(), name == "noise.off") << name;
    EXPECT_EQ(object["print"].is_null(), name == "noise.off") << name;
    if (scored) {
      EXPECT_EQ(object["score"]["graspability"], scores.at(name)) << name;
      EXPECT_EQ(object["grasps"][2], 10 * 36 + 128);
      EXPECT_EQ(object["status"], "ok");
      EXPECT_EQ(object["print"]["watertight"], true);
      const auto size = object["print"]["size_mm"].get<std::vector<double>>();
      EXPECT_NEAR(*std::max_element(size.begin(), size.end()), 60.0, 1e-9);
    }
  }
  EXPECT_EQ(scores.size(), 2u);
  const std::string html = ReadFile(folder / "r.html");
  EXPECT_NE(html.find("<title>&lt;i&gt;</title>"), std::string::npos);
  EXPECT_EQ(html.find("<b>\"it's"), std::string::npos);

  ReportOf(dir + "in --title '<i>' --threads 1 " + kQuickReport, folder / "one.html");
  EXPECT_EQ(html, ReadFile(folder / "one.html"));
  EXPECT_EQ(ReportOf(dir + "in --limit 3" + kQuickReport, folder / "r.html")["objects"].size(), 3u);
}

TEST(ReportCli, UsesTheConstantsOfATableOfScoresOrShowsItAlone) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  MakeMeshes(folder / "in");
  WriteMesh(folder / "first.stl", shapes::Cylinder(1.0, 3.0, 24));
  ASSERT_EQ(Antigrasp("evaluate " + dir + "first.stl " + dir + "in --seed 5 --friction 0.6" +
                      kQuickReport + "--out " + dir + "s.csv")
                .code,
            0);
  const auto scores = ScoresIn(folder / "s.csv");
  // Without the first object every other one stands at another place than in the table.
  const json both = ReportOf(dir + "s.csv " + dir + "in", folder / "r.html");
  EXPECT_EQ(both["metric"]["friction"], 0.6);
  EXPECT_EQ(both["groups"].size(), 1u);
  int compared = 0;
  for (const json& object : both["objects"]) {
    if (object["score"].is_null()) continue;
    EXPECT_EQ(object["score"]["graspability"], scores.at(object["name"]));
    ++compared;
  }
  EXPECT_EQ(compared, 2);

  const json alone = ReportOf(dir + "s.csv", folder / "r.html");
  EXPECT_EQ(alone["objects"].size(), 5u);
  for (const json& object : alone["objects"]) {
    EXPECT_TRUE(object["mesh"].is_null());
    EXPECT_EQ(object["score"].is_null(), !scores.contains(object["name"]));
  }
  ExpectRefused("report " + dir + "s.csv --friction 0.5 --out " + dir + "x.html", "its own");
  ExpectRefused("report " + dir + "s.csv --seed 2 --out " + dir + "x.html", "its own");

  // Two tables of one metric, by two judges.
  for (const char* judge : {"epsilon", "settled"}) {
    ASSERT_EQ(Antigrasp("evaluate " + dir + "in --seed 5 --friction 0.6" + kQuickReport +
                        "--judge " + judge + " --out " + dir + judge + ".csv")
                  .code,
              0);
  }
  const json judged = ReportOf(dir + "epsilon.csv " + dir + "settled.csv", folder / "r.html");
  EXPECT_TRUE(Mentions(judged["missing"], "settled.csv was judged by settled, "));
  EXPECT_FALSE(Mentions(judged["missing"], "other constants"));
  EXPECT_NE(judged["config"].get<std::string>().find("[judge]"), std::string::npos);
  EXPECT_EQ(ReportOf(dir + "epsilon.csv " + dir + "epsilon.csv", folder / "r.html")["missing"],
            json::array());

  fs::remove(folder / "s.csv.metric.toml");
  EXPECT_TRUE(Mentions(ReportOf(dir + "s.csv", folder / "r.html")["missing"], "not known"));
  const std::string table = ReadFile(folder / "s.csv");
  folder.Write("cut.csv", table.substr(0, table.rfind(",") - 20));
  ExpectRefused("report " + dir + "cut.csv --out " + dir + "x.html", "cut.csv:6");
}

// A finished run of one episode after 0, and its control.
std::string MakeRun(const std::string& dir) {
  const Outcome outcome = Antigrasp(
      "train " ANTIGRASP_CONFIGS "/smoke.toml --set cem.episodes=1 --set cem.prior_iterations=10 " +
      std::string("--set cem.iterations=1 --set prior.count=16 --set cem.compared=8 --set ") +
      "cem.samples=12 --set cem.keep=4 --set cem.prior_scored=8 --out " + dir + "run");
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  return dir + "run";
}

void ExpectHeadAndStages(const json& data, const std::string& run) {
  EXPECT_EQ(data["kind"], "run");
  EXPECT_EQ(data["title"], run);
  EXPECT_EQ(data["missing"], json::array());
  EXPECT_NE(data["config"].get<std::string>().find("[cem]"), std::string::npos);
  EXPECT_EQ(data["metric"]["num_draws"], 5);
  std::map<std::string, std::string> provenance;
  for (const json& line : data["provenance"]) provenance[line[0]] = line[1];
  EXPECT_EQ(provenance["seed"], "1");
  EXPECT_EQ(provenance["device"], "cpu");
  EXPECT_NE(provenance["time"], "");

  std::vector<std::string> stages;
  for (const json& stage : data["run"]["stages"]) {
    stages.push_back(stage["id"]);
    EXPECT_FALSE(stage["graspability"]["mean"].is_null());
    EXPECT_EQ(stage["scores"].size(), stage["graspability"]["count"]);
    EXPECT_EQ(stage["coverage"].is_null(), stage["id"] == "prior");
  }
  EXPECT_EQ(stages, (std::vector<std::string>{"prior", "episode-0", "episode-1", "control-1"}));
  EXPECT_EQ(data["run"]["stages"][0]["samples"], 8);
  ASSERT_EQ(data["run"]["losses"].size(),
            1u);  // a single update leaves no row: every tenth is written
  EXPECT_EQ(data["run"]["losses"][0]["columns"]["step"], json::parse("[10]"));
}

// By how many usable objects of the stage an object is beaten.
std::string RankIn(const std::map<std::string, double>& scores, double own) {
  const auto below = std::count_if(scores.begin(), scores.end(),
                                   [own](const auto& entry) { return entry.second < own; });
  return std::to_string(below + 1) + " of " + std::to_string(scores.size());
}

void ExpectTheScoredObjects(const json& data, const std::string& run) {
  ASSERT_EQ(data["groups"].size(), 3u);
  int elites = 0;
  std::map<int, double> least;
  for (const json& object : data["objects"]) {
    const int group = object["group"];
    const std::string sample = object["numbers"][0][1];
    const auto scores =
        ScoresIn(group == 0 ? run + "/prior_scores.csv"
                            : run + "/episode_" + std::to_string(group - 1) + "/scores.csv");
    const std::string key = group == 0 ? sample : object["name"].get<std::string>();
    EXPECT_EQ(object["score"]["graspability"], scores.at(key)) << group << " " << key;
    EXPECT_FALSE(object["mesh"].is_null());
    const std::string rank = RankIn(scores, scores.at(key));
    EXPECT_EQ(object["numbers"][2], (json{"rank, least graspable first", rank}));
    const bool of_prior = object["name"].get<std::string>().starts_with("cylinders-");
    EXPECT_EQ(of_prior, group == 0) << object["name"];
    const bool picked = object["numbers"][1][1] == "least graspable";
    EXPECT_EQ(object.value("random", true), !picked) << object["numbers"][1][1];
    elites += object.value("elite", false) ? 1 : 0;
    EXPECT_EQ(object.contains("elite"), group > 0);
    for (const auto& [name, score] : scores) {
      least[group] = least.contains(group) ? std::min(least[group], score) : score;
    }
    if (object["score"]["graspability"] == least[group]) least[group] = -1.0;
  }
  EXPECT_GE(elites, 3);  // the least graspable of either episode
  for (const auto& [group, value] : least) EXPECT_EQ(value, -1.0) << "shown: the least graspable";
}

// A run of an older version called sample 12 "12" in scores.csv and "sample-12" in elites.h5.
void ExpectTheSameOfOldNames(const json& data, const std::string& run, const TempFolder& folder) {
  for (const std::string episode : {"0", "1"}) {
    const std::string of = run + "/episode_" + episode;
    const std::string table = ReadFile(of + "/scores.csv");
    const std::string old = std::regex_replace(table, std::regex("sample-0*([0-9]+)"), "$1");
    EXPECT_NE(old.find("\n0,"), std::string::npos) << old;
    EXPECT_NE(old, table);
    WriteFileAtomic(of + "/scores.csv", old);
    if (!fs::exists(of + "/elites.h5")) continue;
    ShapeSet elites = ReadShapeSet(of + "/elites.h5");
    for (std::string& name : elites.names) {
      name = std::regex_replace(name, std::regex("-0*([0-9]+)$"), "-$1");
      EXPECT_LT(name.size(), 13u);
    }
    fs::remove(of + "/elites.h5");
    WriteShapeSet(of + "/elites.h5", elites);
  }
  EXPECT_EQ(ReportOf(run + "/ --per-stage 6", folder / "old.html"), data);
}

// Last, because it takes the run apart.
void ExpectWhatIsMissing(const std::string& run, const TempFolder& folder) {
  const std::string dir = folder.path().string() + "/";
  fs::remove(run + "/episode_0/scores.csv");
  fs::remove(run + "/episode_1/checkpoint.pt");
  fs::remove(run + "/episode_0/losses.csv");
  fs::remove(run + "/prior.h5");
  fs::remove(run + "/provenance.toml");
  fs::remove_all(run + "/control");
  const json data = ReportOf(run + " --per-stage 4", folder / "r.html");
  for (const char* part :
       {"episode 0 has no scores.csv", "episode 0 has no losses.csv", "episode 1 has no checkpoint",
        "prior set has no prior.h5", "provenance.toml", "control run"}) {
    EXPECT_TRUE(Mentions(data["missing"], part)) << part << "\n" << data["missing"];
  }
  EXPECT_EQ(data["run"]["stages"].size(), 3u);
  EXPECT_TRUE(data["run"]["stages"][1]["scores"].is_null());
  EXPECT_FALSE(data["run"]["stages"][1]["graspability"]["mean"].is_null());  // statistics.csv
  ASSERT_EQ(data["groups"].size(), 1u);
  EXPECT_EQ(data["objects"].size(), 4u);  // of episode 0, all drawn at random

  fs::remove(run + "/statistics.csv");
  const json without = ReportOf(run + " --per-stage 0", folder / "r.html");
  EXPECT_FALSE(without["run"]["stages"][2]["graspability"]["mean"].is_null());  // scores.csv
  EXPECT_TRUE(without["run"]["stages"][2]["coverage"].is_null());

  const std::string scores = ReadFile(run + "/episode_1/scores.csv");
  WriteFileAtomic(run + "/episode_1/scores.csv",
                  scores.substr(0, scores.find("\nsample-000002,") + 16));
  ExpectRefused("report " + run + " --out " + dir + "x.html", "scores.csv:4");
  EXPECT_FALSE(fs::exists(folder / "x.html"));

  const json empty = [&] {
    fs::create_directory(folder / "empty");
    WriteFileAtomic(folder / "empty/config.toml", ReadFile(run + "/config.toml"));
    return ReportOf(dir + "empty", folder / "r.html");
  }();
  EXPECT_TRUE(Mentions(empty["missing"], "statistics.csv"));
  EXPECT_TRUE(Mentions(empty["missing"], "episode 1 is not there"));
  EXPECT_EQ(empty["objects"].size(), 0u);
}

// Trains, which no smaller settings make shorter than some seconds: once for all that needs a run.
TEST(ReportCli, ShowsARunWithItsChartsAndTheObjectsItScoredOrWhatItLacks) {
  const TempFolder folder;
  const std::string run = MakeRun(folder.path().string() + "/");
  const json data = ReportOf(run + "/ --per-stage 6", folder / "r.html");
  ExpectHeadAndStages(data, run);
  ExpectTheScoredObjects(data, run);
  ReportOf(run + "/ --per-stage 6 --threads 1", folder / "one.html");
  EXPECT_EQ(ReadFile(folder / "r.html"), ReadFile(folder / "one.html"));
  EXPECT_EQ(ReportOf(run + " --per-stage 0", folder / "r.html")["objects"].size(), 0u);
  const std::string table = ReadFile(run + "/episode_1/scores.csv");
  ExpectTheSameOfOldNames(data, run, folder);
  WriteFileAtomic(run + "/episode_1/scores.csv", table);
  ExpectWhatIsMissing(run, folder);
}

TEST(ReportCli, ShowsPerturbedObjectsBesideTheirOriginals) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  MakeMeshes(folder / "in");
  ASSERT_EQ(Antigrasp("perturb random " + dir + "in --iterations 200 --seed 3" + kQuickReport +
                      "--out " + dir + "p")
                .code,
            0);
  const auto before = ScoresIn(folder / "p/perturb.csv", "graspability_before");
  const auto after = ScoresIn(folder / "p/perturb.csv", "graspability_after");
  const json data = ReportOf(dir + "p", folder / "r.html");
  EXPECT_EQ(data["kind"], "perturbed");
  EXPECT_EQ(data["missing"], json::array());
  ASSERT_EQ(data["objects"].size(), 4u);
  for (const json& object : data["objects"]) {
    const std::string name = object["name"];
    if (!after.contains(name)) {
      EXPECT_NE(object["status"], "ok");
      EXPECT_TRUE(object["score"].is_null());
      continue;
    }
    EXPECT_EQ(object["score"]["graspability"], after.at(name));
    const json& pair = object["pair"];
    EXPECT_EQ(pair["score"]["graspability"], before.at(name));
    EXPECT_EQ(pair["label"], "before");
    EXPECT_GT(pair["max_displacement"], 0.0);
    EXPECT_EQ(pair["displacement"][2], object["mesh"]["vertices"]);
    EXPECT_FALSE(pair["grasps"].is_null());
    EXPECT_GT(object["numbers"].size(), 8u);
  }
  EXPECT_EQ(after.size(), 2u);
  ReportOf(dir + "p --threads 1", folder / "one.html");
  EXPECT_EQ(ReadFile(folder / "r.html"), ReadFile(folder / "one.html"));
  EXPECT_EQ(ReportOf(dir + "p --limit 1", folder / "r.html")["objects"].size(), 1u);
  fs::remove(folder / "p/perturb.toml");
  fs::remove(folder / "p/after/ball.stl");
  const json less = ReportOf(dir + "p", folder / "r.html");
  EXPECT_TRUE(Mentions(less["missing"], "perturb.toml"));
  EXPECT_TRUE(Mentions(less["missing"], "ball.stl has no mesh"));
}

TEST(ReportCli, ShowsTrialsBesideTheObjectsOfTheirNames) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  WriteMesh(folder / "ball.stl", shapes::Sphere(1.0, 2));
  folder.Write("trials/trials.csv",
               "object,protocol,held,held_low,held_high\nball.stl,paper,0.75,0.5,0.875\n");
  folder.Write("trials/executions.csv",
               "object,protocol,grasp,robust_quality,outcome\nball.stl,paper,3,0.002,slipped\n");
  const json data =
      ReportOf(dir + "ball.stl" + kQuickReport + "--trials " + dir + "trials", folder / "r.html");
  const json& trials = data["objects"][0]["trials"];
  EXPECT_EQ(trials["series"][0]["held"], 0.75);
  EXPECT_EQ(trials["grasps"][0]["outcomes"], json::parse(R"([["slipped", 1]])"));
  EXPECT_FALSE(Mentions(data["missing"], "trials"));
  ExpectRefused("report " + dir + "ball.stl --out " + dir + "no.html --trials " + dir,
                "no trials.csv");
  ExpectRefused(
      "report " + dir + "ball.stl --trials " + dir + "trials --out " + dir + "trials/trials.csv",
      "trials.csv");
  EXPECT_FALSE(fs::exists(folder / "no.html"));
}

TEST(ReportCli, RefusesBadInputInOneLineAndWritesNothing) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/", out = " --out " + dir + "r.html";
  WriteMesh(folder / "ball.stl", shapes::Sphere(1.0, 1));
  fs::create_directory(folder / "run");
  folder.Write("run/config.toml", "[cem\n");
  folder.Write("table.csv", "object,graspability\n");
  fs::create_directory(folder / "none");
  ExpectRefused("report " + dir + "ball.stl", "--out");
  ExpectRefused("report " + dir + "missing.stl" + out, "no such file");
  ExpectRefused("report " + dir + "none" + out, "no object");
  ExpectRefused("report " + dir + "run" + out, "config.toml:1");
  ExpectRefused("report " + dir + "run " + dir + "ball.stl" + out, "alone");
  ExpectRefused("report " + dir + "run --friction 0.4" + out, "its own");
  ExpectRefused("report " + dir + "table.csv" + out, "no column status");
  ExpectRefused("report " + dir + "ball.stl --out " + dir + "no/r.html", "folder");
  EXPECT_FALSE(fs::exists(folder / "r.html"));
}

}  // namespace
}  // namespace antigrasp
