// The numbers of `antigrasp report`, of hand-made tables with another number in every field.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/mesh/mesh_file.h"
#include "tests/app/run_binary.h"
#include "tests/support/shapes.h"
#include "tests/support/temp_folder.h"

namespace antigrasp {
namespace {

using nlohmann::json;
using shapes::TempFolder;

json ReportOf(const TempFolder& folder, const std::string& input) {
  const std::string page = (folder / "r.html").string();
  const cli::Outcome outcome =
      cli::Antigrasp("report " + (folder / input).string() + " --out " + page);
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  const std::string html = ReadFile(page), opening = "id=\"antigrasp-report\">";
  const std::size_t start = html.find(opening) + opening.size();
  return json::parse(html.substr(start, html.find("</script>", start) - start));
}

TEST(ReportNumbersCli, EveryColumnOfAPerturbationStandsUnderItsWords) {
  const TempFolder folder;
  folder.Write(
      "p/perturb.csv",
      "object,status,faces_before,faces_after,pairs_before,pairs_after,graspability_before,"
      "graspability_after,difference,normal_max_deg,normal_mean_deg,hausdorff_pct,"
      "chamfer_pct,volume_change_pct,center_of_mass_pct,iterations,moved,no_gain,refused\n"
      "a.stl,ok,320,318,66,55,0.75,0.25,-0.5,15.51234,3.5,1.25,0.5,-2.5,0.125,100,61,30,9\n"
      "b.stl,after: open,20,21,,,0.3,,,,,,,,,,,,\n");
  const json data = ReportOf(folder, "p");
  const json& a = data["objects"][0];
  EXPECT_EQ(a["score"]["graspability"], 0.25);
  EXPECT_EQ(a["pair"]["score"]["graspability"], 0.75);
  EXPECT_EQ(a["numbers"], json::parse(R"([
      ["change of graspability", "-0.5"],
      ["faces before", "320"],
      ["faces after", "318"],
      ["antipodal pairs of faces before", "66"],
      ["antipodal pairs of faces after", "55"],
      ["largest turn of a normal, degrees", "15.51"],
      ["mean turn of a normal, degrees", "3.5"],
      ["Hausdorff distance, % of the diagonal", "1.25"],
      ["Chamfer distance, % of the diagonal", "0.5"],
      ["shift of the centre of mass, % of the diagonal", "0.125"],
      ["change of volume, %", "-2.5"],
      ["moves", "61"]])"));
  const json& b = data["objects"][1];
  EXPECT_TRUE(b["score"].is_null());
  EXPECT_EQ(b["pair"]["score"]["graspability"], 0.3);
  EXPECT_EQ(b["status"], "after: open");
  EXPECT_EQ(b["numbers"], json::parse(R"([["faces before", "20"], ["faces after", "21"]])"));
}

TEST(ReportNumbersCli, TheMeshesBeforeAndAfterAreNotExchanged) {
  const TempFolder folder;
  folder.Write("p/perturb.csv",
               "object,status,graspability_before,graspability_after\na.stl,ok,0.75,0.25\n");
  for (const char* part : {"before", "after"})
    std::filesystem::create_directories(folder / "p" / part);
  WriteMesh(folder / "p/before/a.stl", shapes::Box({1.0, 2.0, 3.0}));
  WriteMesh(folder / "p/after/a.stl", shapes::Box({1.0, 2.0, 5.0}));
  const json object = ReportOf(folder, "p")["objects"][0];
  EXPECT_EQ(object["mesh"]["extent"], 5.0);
  EXPECT_EQ(object["pair"]["mesh"]["extent"], 3.0);
  EXPECT_NEAR(object["pair"]["max_displacement"], 1.0, 1e-6);
  // Printed with 60 mm along z: the others are 1/5 and 2/5 of it.
  EXPECT_NEAR(object["print"]["size_mm"][0], 12.0, 1e-4);
  EXPECT_NEAR(object["print"]["size_mm"][1], 24.0, 1e-4);
  EXPECT_NEAR(object["print"]["size_mm"][2], 60.0, 1e-4);
  EXPECT_NEAR(object["print"]["wall_mm"], 12.0, 0.1);
  // On its 2 x 5 face: solid angle 4 atan(10 / sqrt(4 * 0.25 + 4 + 25)) of 4 pi.
  EXPECT_NEAR(object["print"]["pose_probability"], 0.3412, 0.02);
}

TEST(ReportNumbersCli, EveryColumnOfAScoreTableBecomesItsNumber) {
  const TempFolder folder;
  folder.Write("s.csv",
               "mean,object,status,num_grasps,graspability,ci_low,ci_high,fraction_nonzero,seconds,"
               "baseline,egad,difference\n"
               "0.06,a,ok,90,0.04,0.03,0.07,0.8,5,0.09,0.11,-0.05\n"
               ",b,disjoint,0,,,,,5,,,\n");
  const json objects = ReportOf(folder, "s.csv")["objects"];
  EXPECT_EQ(objects[0]["score"],
            json::parse(R"({"graspability": 0.04, "ci_low": 0.03, "ci_high": 0.07, "mean": 0.06,
                            "fraction_nonzero": 0.8, "num_grasps": 90})"));
  EXPECT_EQ(objects[0]["numbers"], json::parse(R"([["EGAD's score", "0.11"], ["baseline", "0.09"],
                            ["difference to the baseline", "-0.05"]])"));
  EXPECT_TRUE(objects[1]["score"].is_null());
  EXPECT_EQ(objects[1]["status"], "disjoint");
}

// Two stages, the second of the control, too: its own numbers are told apart by 100.
TEST(ReportNumbersCli, EveryColumnOfARunsTablesBecomesItsNumber) {
  const TempFolder folder;
  const std::string head =
      "stage,samples,ok,non_finite,empty,touches_border,gaps,non_manifold,non_orientable,"
      "self_intersecting,disjoint,scored,without_grasps,graspability,half_width_95,count,"
      "elite_threshold,coverage,nna,duplicates,diversity,flat_share,crease_share\n";
  const auto row = [](const std::string& stage, const std::string& mean) {
    return stage + ",60,50,0,0,1,0,0,0,2,7,49,3," + mean +
           ",0.02,48,0.19,0.51,0.62,0.13,0.94,0.37,0.08\n";
  };
  folder.Write("run/statistics.csv", head + row("0", "0.3") + row("1", "0.2"));
  folder.Write("run/control/statistics.csv", head + row("0", "0.3") + row("1", "0.28"));
  folder.Write(
      "run/episode_1/losses.csv",
      "step,loss_discriminator,loss_generator,gradient_discriminator,gradient_generator,"
      "rate_discriminator,rate_generator,largest_sigma\n10,1,2,3,4,5,6,7\n20,1.5,,3,4,5,6,7\n");
  // Of a model with names of its own.
  folder.Write("run/control/episode_1/losses.csv", "step,radius,gap\n10,0.25,\n20,0.5,8\n");
  const json run = ReportOf(folder, "run")["run"];
  ASSERT_EQ(run["stages"].size(), 3u);
  EXPECT_EQ(run["stages"][1], json::parse(R"({
      "id": "episode-1", "label": "episode 1", "episode": 1, "control": false, "samples": 60,
      "statuses": [["ok", 50], ["touches_border", 1], ["self_intersecting", 2], ["disjoint", 7]],
      "graspability": {"mean": 0.2, "half_width": 0.02, "count": 48},
      "elite_threshold": 0.19, "coverage": 0.51, "nna": 0.62, "duplicates": 0.13,
      "diversity": 0.94, "flat_share": 0.37, "crease_share": 0.08, "scores": null})"));
  EXPECT_EQ(run["stages"][0]["graspability"]["mean"], 0.3);
  const json& control = run["stages"][2];
  EXPECT_EQ(control["id"], "control-1");
  EXPECT_EQ(control["label"], "control, episode 1");
  EXPECT_EQ(control["control"], true);
  EXPECT_EQ(control["graspability"]["mean"], 0.28);
  EXPECT_EQ(run["losses"], json::parse(R"([{"episode": 1, "control": false, "columns": {
      "step": [10, 20], "loss_discriminator": [1, 1.5], "loss_generator": [2, null],
      "gradient_discriminator": [3, 3], "gradient_generator": [4, 4],
      "rate_discriminator": [5, 5], "rate_generator": [6, 6], "largest_sigma": [7, 7]}},
      {"episode": 1, "control": true, "columns": {
      "step": [10, 20], "radius": [0.25, 0.5], "gap": [null, 8]}}])"));
}

}  // namespace
}  // namespace antigrasp
