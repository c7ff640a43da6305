// What perturb writes and says, of hand-made results with another number in every field.
#include "antigrasp/perturb/perturb_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <sstream>

#include "antigrasp/mesh/mesh_file.h"
#include "antigrasp/render/image.h"
#include "tests/support/read_png.h"
#include "tests/support/shapes.h"
#include "tests/support/temp_folder.h"

namespace antigrasp {
namespace {

PerturbedObject Changed() {
  PerturbedObject item;
  item.object.name = "ball.stl";
  item.object.status = "ok";
  item.object.mesh = shapes::Cube();  // 12 faces
  ScoredPerturbation& s = item.scored;
  s.before = shapes::Cube();
  s.result.mesh = shapes::Sphere(1.0, 0);  // 20 faces
  s.result.iterations = 100;
  s.result.moved = 61;
  s.result.no_gain = 30;
  s.result.refused.fill(0);
  s.result.refused.front() = 4;
  s.result.refused.back() = 5;
  s.result.history = {{0, 70, 8}, {50, 40, -1}};
  s.graspability_before = 0.75;
  s.graspability_after = 0.25;
  s.pairs_before = 66;
  s.pairs_after = 55;
  s.normals = {15.5, 3.5};
  s.change = {1.25, 0.5, -2.5, 0.125};
  s.seconds = 2.0;
  return item;
}

PerturbedObject Refused(const std::string& name, const std::string& status) {
  PerturbedObject item;
  item.object.name = name;
  item.object.status = status;
  item.scored.graspability_before = item.scored.graspability_after = 7.0;  // to be left out
  return item;
}

// The fields of row `number` by the header's names.
std::map<std::string, std::string> RowOf(const std::string& csv, int number) {
  std::istringstream lines(csv);
  std::string header, line, name, field;
  std::getline(lines, header);
  for (int i = 0; i <= number; ++i) std::getline(lines, line);
  EXPECT_EQ(std::count(header.begin(), header.end(), ','),
            std::count(line.begin(), line.end(), ','));
  std::map<std::string, std::string> row;
  std::istringstream names(header), fields(line);
  while (std::getline(names, name, ',')) {
    field.clear();
    std::getline(fields, field, ',');
    row[name] = field;
  }
  return row;
}

using Row = std::map<std::string, std::string>;

std::string Csv(const std::vector<PerturbedObject>& objects) {
  std::vector<PerturbRow> rows;
  for (const PerturbedObject& item : objects) rows.push_back(antigrasp::RowOf(item));
  return PerturbCsv(rows);
}

TEST(PerturbFolder, EveryColumnHoldsWhatItsNameSays) {
  EXPECT_EQ(RowOf(Csv({Changed()}), 0), (Row{{"object", "ball.stl"},
                                             {"status", "ok"},
                                             {"faces_before", "12"},
                                             {"faces_after", "20"},
                                             {"pairs_before", "66"},
                                             {"pairs_after", "55"},
                                             {"graspability_before", "0.75"},
                                             {"graspability_after", "0.25"},
                                             {"difference", "-0.5"},
                                             {"normal_max_deg", "15.5"},
                                             {"normal_mean_deg", "3.5"},
                                             {"hausdorff_pct", "1.25"},
                                             {"chamfer_pct", "0.5"},
                                             {"volume_change_pct", "-2.5"},
                                             {"center_of_mass_pct", "0.125"},
                                             {"iterations", "100"},
                                             {"moved", "61"},
                                             {"no_gain", "30"},
                                             {"refused", "9"}}));
}

TEST(PerturbFolder, NumbersThatDoNotExistAreEmptyFields) {
  PerturbedObject failed = Changed(), cut = Changed();
  failed.scored.result.failure = "after: open: 3 boundary edges";
  failed.scored.graspability_after = std::nan("");
  failed.scored.pairs_after = -1;
  cut.interrupted = true;
  const std::string csv = Csv({failed, Refused("open.ply", "open: 4 boundary edges"), cut});
  Row row = RowOf(csv, 0);
  EXPECT_EQ(row["status"], "after: open: 3 boundary edges");
  EXPECT_EQ(row["graspability_before"], "0.75");
  EXPECT_EQ(row["graspability_after"] + row["difference"] + row["pairs_after"], "");
  EXPECT_EQ(row["pairs_before"], "66");
  row = RowOf(csv, 1);
  EXPECT_EQ(row["status"], "before: open: 4 boundary edges");
  EXPECT_EQ(row["graspability_before"] + row["graspability_after"], "");
  row = RowOf(csv, 2);
  EXPECT_EQ(row["status"], "interrupted");
  EXPECT_EQ(row["graspability_before"] + row["normal_max_deg"], "");
}

TEST(PerturbFolder, AHistoryHasPairsAndThoseBelowTheConeByIteration) {
  EXPECT_EQ(PerturbHistoryCsv({HistoryOf(Changed())}),
            "object,iteration,pairs,pairs_below_cone\nball.stl,0,70,8\nball.stl,50,40,\n");
}

// Means over the two that worked: 0.75 and 0.45 before, 0.25 and 0.41 after: 0.6 -> 0.33, 45 %
// less. Residuals a - 0.55 b: -+0.1625, their deviation 0.1625 sqrt 2, of the mean 0.1625; by 0.6
// and 1.96: 53.1 %.
TEST(PerturbFolder, TheSummaryIsOfThoseThatWorkedAndCountsTheOthersByReason) {
  PerturbedObject other = Changed(), failed = Changed();
  other.scored.graspability_before = 0.45;
  other.scored.graspability_after = 0.41;
  other.scored.normals = {5.5, 9.0};
  other.scored.change.hausdorff = 2.75;
  other.scored.seconds = 5.0;
  failed.scored.result.failure = "after: open: 3 boundary edges";
  failed.scored.graspability_before = 100.0;
  EXPECT_EQ(
      PerturbSummary({Changed(), failed, other, Refused("a", "disjoint pieces: 2")}),
      "2 of 4 objects perturbed: mean graspability 0.60000 -> 0.33000, kappa reduced by 45.0 "
      "+-53.1 %\n"
      "mean over objects: largest turn of a normal 10.5 degrees, Hausdorff distance 2.00 % of "
      "the diagonal, 3.5 s of one thread\n"
      "failed: 1 after: open, 1 before: disjoint pieces\n");
  EXPECT_EQ(PerturbSummary({failed}), "no object perturbed\nfailed: 1 after: open\n");
  EXPECT_NE(PerturbSummary({Changed()}).find("kappa reduced by 66.7 %\n"), std::string::npos);
}

TEST(PerturbFolder, MeshesAndTheSheetShowBeforeAndAfterInTheirPlaces) {
  const shapes::TempFolder folder;
  PerturbedObject failed = Changed();
  failed.object.name = "failed.stl";
  failed.scored.result.failure = "after: open";
  WritePerturbFiles({Changed(), failed}, {"seed = 1\n", false, 1}, folder.path());
  EXPECT_EQ(ReadMesh(folder / "before/ball.stl").faces.size(), 12u);
  EXPECT_EQ(ReadMesh(folder / "after/ball.stl").faces.size(), 20u);
  EXPECT_TRUE(std::filesystem::exists(folder / "before/failed.stl"));
  EXPECT_FALSE(std::filesystem::exists(folder / "after/failed.stl"));

  // A plate above, a pillar below: the upper picture is wider than it is high.
  PerturbedObject flat = Changed();
  flat.scored.before = shapes::Box({3.0, 3.0, 0.2});
  flat.scored.result.mesh = shapes::Box({0.2, 0.2, 3.0});
  WritePerturbFiles({failed, flat}, {"seed = 1\n", false, 1}, folder.path());
  const Image sheet = ReadPng(folder / "sheet.png");
  ASSERT_EQ(sheet.height, 2 * sheet.width);  // one column: the failed one is left out
  const auto dark = [&](int first) {         // width of what is drawn in half of the sheet
    int columns = 0;
    for (int x = 0; x < sheet.width; ++x) {
      bool any = false;
      for (int y = first; y < first + sheet.width; ++y) any |= sheet.At(x, y) != Rgb{255, 255, 255};
      columns += any ? 1 : 0;
    }
    return columns;
  };
  EXPECT_GT(dark(0), 3 * dark(sheet.width));
}

// As perturb does when its folder may be overwritten.
std::vector<std::string> Fill(const shapes::TempFolder& folder,
                              const std::vector<PerturbedObject>& objects) {
  WriteMesh(folder / "ball.stl", shapes::Cube());
  const ObjectSource source({(folder / "ball.stl").string()});
  ResultFolder results(folder / "out", PerturbFiles(), source, /*overwrite=*/true);
  std::vector<std::string> notes = WritePerturbFiles(objects, {"", false, 1}, results.path());
  results.Commit(PerturbCsv(RowsOf(objects)));
  return notes;
}

TEST(PerturbFolder, WhatAnEarlierCallLeftOfAnObjectThatFailsNowIsNotTakenForItsResult) {
  const shapes::TempFolder folder;
  Fill(folder, {Changed()});
  ASSERT_TRUE(std::filesystem::exists(folder / "out/after/ball.stl"));
  PerturbedObject failed = Changed();
  failed.scored.result.failure = "after: self-intersecting";
  Fill(folder, {failed});
  EXPECT_TRUE(std::filesystem::exists(folder / "out/before/ball.stl"));
  EXPECT_FALSE(std::filesystem::exists(folder / "out/after/ball.stl"));
  Fill(folder, {Refused("ball.stl", "open: 1 boundary edge")});
  EXPECT_FALSE(std::filesystem::exists(folder / "out/before/ball.stl"));
}

TEST(PerturbFolder, AnObjectThatStlWouldSpoilIsWrittenAsPlyWhereItLies) {
  const shapes::TempFolder folder;
  const Eigen::Vector3d place(0.0, 900000.0, 0.0);
  PerturbedObject far = Changed();
  EXPECT_TRUE(Fill(folder, {far}).empty());  // near: STL
  const TriangleMesh before = Transformed(far.scored.before, 1.0, place);
  const TriangleMesh after = Transformed(far.scored.result.mesh, 1.0, place);
  far.scored.before = before;
  far.scored.result.mesh = after;
  const std::vector<std::string> notes = Fill(folder, {far});
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_EQ(notes[0].find("ball.stl: written as PLY"), 0u) << notes[0];
  EXPECT_EQ(ReadMesh(folder / "out/before/ball.ply").vertices, before.vertices);
  EXPECT_EQ(ReadMesh(folder / "out/after/ball.ply").vertices, after.vertices);
  // What the first call left would be taken for the result of the second.
  EXPECT_FALSE(std::filesystem::exists(folder / "out/before/ball.stl"));
  EXPECT_FALSE(std::filesystem::exists(folder / "out/after/ball.stl"));
  Fill(folder, {Changed()});
  EXPECT_EQ(ReadMesh(FindMeshFile(folder / "out/after", "ball")).faces.size(), 20u);
  EXPECT_FALSE(std::filesystem::exists(folder / "out/after/ball.ply"));
}

}  // namespace
}  // namespace antigrasp
