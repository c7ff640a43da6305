// `antigrasp figure` as a user meets it.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/csv_reader.h"
#include "antigrasp/mesh/mesh_file.h"
#include "antigrasp/render/image.h"
#include "tests/app/run_binary.h"
#include "tests/app/svg_text.h"
#include "tests/support/read_png.h"
#include "tests/support/shapes.h"
#include "tests/support/well_formed.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;
using cli::Antigrasp;
using cli::ExpectRefused;
using cli::Outcome;
using shapes::TempFolder;

// Runs the figure twice, with one thread and with two: the same bytes, well-formed.
void ExpectSvg(const TempFolder& folder, const std::string& arguments) {
  const std::string out = " --dpi 60 --out " + folder.path().string() + "/";
  for (const char* threads : {"1", "2"}) {
    const Outcome outcome =
        Antigrasp("figure " + arguments + out + threads + ".svg --threads " + threads);
    ASSERT_EQ(outcome.code, 0) << arguments << "\n" << outcome.text;
  }
  const std::string svg = ReadFile(folder / "1.svg");
  EXPECT_EQ(svg, ReadFile(folder / "2.svg")) << arguments;
  EXPECT_EQ(shapes::WhyNotWellFormed(svg), "") << arguments;
  EXPECT_EQ(svg.find("<script"), std::string::npos) << arguments;
  EXPECT_NE(svg.find("data:image/png;base64,"), std::string::npos) << arguments;
}

TEST(FigureCli, Figure1DrawsObjectsWithHostileNamesAndTheHistoryOfAPerturbation) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  fs::create_directories(folder / "in");
  WriteMesh(folder / "in/<script>alert('\xe6\x97\xa5')&\".stl", shapes::Cylinder(0.2, 0.6, 16));
  WriteMesh(folder / "in/open.stl", shapes::FlatSquare());
  WriteMesh(folder / "cube.stl", shapes::Cube());
  ASSERT_EQ(Antigrasp("perturb exhaustive " + dir + "cube.stl --iterations 4 --history --out " +
                      dir + "perturbed --num-grasps 10 --num-draws 2")
                .code,
            0);
  const std::string metric = " --num-grasps 20 --num-draws 2 --shown 5 --cone-angle 10";
  ExpectSvg(folder, "1 " + dir + "in" + metric);
  ExpectSvg(folder, "1 " + dir + "perturbed/before " + dir + "perturbed/after --history " + dir +
                        "perturbed/history.csv --label one two" + metric);
  const Outcome png = Antigrasp("figure 1 " + dir + "cube.stl --width-mm 50 --dpi 127 --out " +
                                dir + "f.png" + metric);
  ASSERT_EQ(png.code, 0) << png.text;
  EXPECT_EQ(ReadPng(folder / "f.png").width, 250);
  const Outcome labels =
      Antigrasp("figure 1 " + dir + "cube.stl --label a b --out " + dir + "x.svg");
  EXPECT_EQ(labels.code, 2);
  EXPECT_NE(labels.text.find("antigrasp: 2 labels (--label): expected 1, one each"),
            std::string::npos)
      << labels.text;
  ExpectRefused("figure 1 " + dir + "cube.stl --history " + dir + "perturbed/perturb.csv --out " +
                    dir + "x.svg",
                "no column iteration");
  EXPECT_FALSE(fs::exists(folder / "x.svg"));
}

TEST(FigureCli, Figure2DrawsAMeshItsGridAndASection) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  WriteMesh(folder / "ball.stl", Transformed(shapes::Sphere(20.0, 3), 1.0, {500.0, 0.0, 0.0}));
  WriteMesh(folder / "foil.stl", shapes::Box({1.0, 1.0, 0.001}));
  WriteMesh(folder / "open.stl", shapes::FlatSquare());
  ExpectSvg(folder, "2 " + dir + "ball.stl --axis y --position 0.1 --resolution 16");
  ExpectRefused("figure 2 " + dir + "foil.stl --out " + dir + "x.svg", "too thin");
  ExpectRefused("figure 2 " + dir + "open.stl --out " + dir + "x.svg", "boundary edges");
  ExpectRefused("figure 2 " + dir + "ball.stl --position 0.7 --out " + dir + "x.svg", "0.7");
}

TEST(FigureCli, Figure3DrawsPerturbedFoldersAndLeavesGapsWhereNumbersAreMissing) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  WriteMesh(folder / "a.stl", shapes::Cylinder(0.2, 0.6, 16));
  WriteMesh(folder / "b.stl", shapes::Sphere(0.5, 2));
  ASSERT_EQ(Antigrasp("perturb random " + dir + "a.stl " + dir + "b.stl --num-grasps 10 " +
                      "--num-draws 2 --out " + dir + "random")
                .code,
            0);
  ExpectSvg(folder, "3 " + dir + "random --examples 2");
  const std::string head = "object,status,graspability_before,graspability_after\n";
  folder.Write("none/perturb.csv", head + "x,after: open,0.1,\ny,ok,nan,0.2\n");
  folder.Write("empty/perturb.csv", head);
  ExpectSvg(folder, "3 " + dir + "random " + dir + "none " + dir + "empty/");
  ExpectSvg(folder, "3 " + dir + "random " + dir + "none --label '<&>' '\xce\xb1 \"15\"'");
  folder.Write("other/perturb.csv", "object,status\n");
  ExpectRefused("figure 3 " + dir + "other --out " + dir + "x.svg",
                "no column graspability_before");
  ExpectRefused("figure 3 " + dir + "nowhere --out " + dir + "x.svg", "perturb.csv");
  EXPECT_FALSE(fs::exists(folder / "x.svg"));
}

// The captions of the first `count` usable samples, as the table of their scores has them.
std::vector<std::string> FirstCaptions(const fs::path& scores, std::size_t count) {
  std::vector<std::string> captions;
  CsvReader csv(scores);
  while (csv.Next() && captions.size() < count) {
    const double value = csv.NumberOrGap(*csv.Column("graspability"));
    char text[32];
    std::snprintf(text, sizeof text, "g = %.5f", value);
    if (std::isfinite(value)) captions.emplace_back(text);
  }
  return captions;
}

TEST(FigureCli, Figure4DrawsTheFirstUsableSamplesOfARunsStages) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  ASSERT_EQ(Antigrasp("train " ANTIGRASP_CONFIGS "/smoke.toml --set cem.control=false " +
                      std::string("--set cem.episodes=0 --set cem.prior_iterations=10 --set ") +
                      "cem.samples=8 --set cem.keep=2 --set prior.count=16 --set cem.compared=4 " +
                      "--set cem.prior_scored=3 --out " + dir + "run")
                .code,
            0);
  ExpectSvg(folder, "4 " + dir + "run --examples 2");
  std::vector<std::string> expected = FirstCaptions(folder / "run/prior_scores.csv", 2);
  const std::size_t of_prior = expected.size();
  EXPECT_EQ(of_prior, 2u);
  for (const std::string& text : FirstCaptions(folder / "run/episode_0/scores.csv", 2)) {
    expected.push_back(text);
  }
  std::vector<std::string> captions = cli::TextsIn(ReadFile(folder / "1.svg"));
  std::erase_if(captions, [](const std::string& text) { return !text.starts_with("g = "); });
  EXPECT_EQ(captions, expected);
  fs::remove(folder / "run/episode_0/scores.csv");
  fs::remove(folder / "run/prior_scores.csv");
  ExpectRefused("figure 4 " + dir + "run --out " + dir + "x.svg", "no stage has been scored");
  ExpectRefused("figure 4 " + dir + "nowhere --out " + dir + "x.svg", "nowhere");
}

TEST(FigureCli, RefusesBadInputInOneLineAndWritesNothing) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  WriteMesh(folder / "cube.stl", shapes::Cube());
  folder.Write("bad.csv", "object,iteration,pairs\n");
  const int before = shapes::CountFiles(folder.path());
  ExpectRefused("figure", "");
  ExpectRefused("figure 5 " + dir + "cube.stl --out " + dir + "x.svg", "");
  ExpectRefused("figure 1 " + dir + "cube.stl", "--out");
  ExpectRefused("figure 1 " + dir + "cube.stl --out " + dir + "x.pdf", ".svg or .png");
  ExpectRefused("figure 1 " + dir + "cube.stl --out " + dir + "no/x.svg", "folder");
  ExpectRefused("figure 1 " + dir + "none.stl --out " + dir + "x.svg", "none.stl");
  ExpectRefused("figure 1 " + dir + "cube.stl --width-mm nan --out " + dir + "x.svg", "nan");
  ExpectRefused("figure 1 " + dir + "cube.stl --width-mm 2000 --dpi 1200 --out " + dir + "x.png",
                "30000");
  ExpectRefused("figure 1 " + dir + "cube.stl --history " + dir + "bad.csv --out " + dir + "x.svg",
                "no rows");
  ExpectRefused("figure 2 " + dir + "cube.stl --axis w --out " + dir + "x.svg", "w");
  EXPECT_EQ(shapes::CountFiles(folder.path()), before);
}

}  // namespace
}  // namespace antigrasp
