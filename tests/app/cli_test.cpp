// The binary as a user meets it: every command, exit codes, one-line errors, nothing half-written.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/csv_reader.h"
#include "antigrasp/datasets/shape_set.h"
#include "antigrasp/mesh/inspect.h"
#include "antigrasp/mesh/mesh_file.h"
#include "antigrasp/sdf/remesh.h"
#include "tests/app/run_binary.h"
#include "tests/support/csv_rows.h"
#include "tests/support/shapes.h"
#include "tests/support/temp_folder.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;
using cli::Antigrasp;
using cli::ExpectRefused;
using cli::Outcome;
using cli::Shell;
using shapes::TempFolder;

const std::string kSmoke = std::string(ANTIGRASP_CONFIGS) + "/smoke.toml";

// The first words below "Subcommands:".
std::vector<std::string> CommandsIn(const std::string& help) {
  std::istringstream lines(help.substr(std::min(help.size(), help.find("Subcommands:"))));
  std::vector<std::string> commands;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("  ") || line[2] == ' ') continue;
    commands.push_back(line.substr(2, line.find(' ', 2) - 2));
  }
  return commands;
}

TEST(Cli, HelpNamesEveryCommandAndEveryCommandHasHelp) {
  const Outcome help = Antigrasp("help");
  EXPECT_EQ(help.code, 0);
  const std::vector<std::string> commands = CommandsIn(help.text);
  for (const char* command : {"dataset", "train", "sample", "remesh", "evaluate", "compare",
                              "quality", "perturb", "shape", "poses", "trial", "gripper", "sheet",
                              "figure", "export", "generator", "info", "doctor"}) {
    EXPECT_TRUE(std::find(commands.begin(), commands.end(), command) != commands.end()) << command;
  }
  for (const std::string& command : commands) {
    const Outcome own = Antigrasp("help " + command);
    EXPECT_EQ(own.code, 0) << command;
    EXPECT_NE(own.text.find("Usage: antigrasp " + command + " "), std::string::npos) << own.text;
  }
  const Outcome bare = Antigrasp("");
  EXPECT_EQ(bare.code, 0);
  EXPECT_EQ(bare.text, help.text);
}

TEST(Cli, HelpFollowsCommandsOfCommands) {
  for (const char* of : {"dataset", "perturb", "figure"}) {
    const std::vector<std::string> commands = CommandsIn(Antigrasp(std::string("help ") + of).text);
    EXPECT_GE(commands.size(), 2u) << of;
    for (const std::string& command : commands) {
      const std::string path = std::string(of) + " " + command;
      const Outcome own = Antigrasp("help " + path);
      EXPECT_EQ(own.code, 0) << path;
      EXPECT_NE(own.text.find("Usage: antigrasp " + path + " "), std::string::npos) << own.text;
      EXPECT_NE(own.text.find("--out"), std::string::npos) << own.text;
    }
  }
  ExpectRefused("help fly", "no command fly (antigrasp)");
  ExpectRefused("help dataset imprt",
                "no command imprt (antigrasp dataset): expected a known command; the nearest is "
                "import\n");
  ExpectRefused("help info fly", "no command fly (antigrasp info): expected nothing behind it");
}

TEST(Cli, AnUnknownWordNamesTheNearestThatIsKnown) {
  ExpectRefused("evalute a.stl",
                "no command evalute (antigrasp): expected a known command; the nearest is "
                "evaluate\n");
  ExpectRefused("trian", "; the nearest is train\n");
  ExpectRefused("evaluate --num-grasp 3 a.stl",
                "no option --num-grasp (antigrasp evaluate): expected a known option; the nearest "
                "is --num-grasps\n");
  // An option that is missing because another's name was misspelt, a value behind "=", a flag.
  ExpectRefused("export a.stl --otu=x", "no option --otu (antigrasp export)");
  ExpectRefused("export a.stl --otu=x", "; the nearest is --out\n");
  ExpectRefused("evaluate a.stl --no-adaptiv", "; the nearest is --no-adaptive\n");
  ExpectRefused("perturb serach a.stl",
                "no command serach (antigrasp perturb): expected a known command; the nearest is "
                "search\n");
  ExpectRefused("dataset import a.stl --ou x", "(antigrasp dataset import): expected a known");
  ExpectRefused("--versoin",
                "no option --versoin (antigrasp): expected a known option; the "
                "nearest is --version\n");
  // Not a word that could be one.
  ExpectRefused("info a.stl b.stl", "b.stl");
  ExpectRefused("dataset", "subcommand");
}

TEST(Cli, RefusesBadInputInOneLineAndWritesNothing) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  folder.Write("bad.toml", "[gan]\nbtach = 3\n");
  folder.Write("range.toml", "[gan]\n\nbatch = 0\n");
  folder.Write("broken.toml", "[gan\n");
  folder.Write("not.h5", "no hdf5 at all");
  const int before = shapes::CountFiles(folder.path());
  ExpectRefused("train " + dir + "bad.toml --out " + dir + "run", "bad.toml:2");
  ExpectRefused("train " + dir + "range.toml --out " + dir + "run", "range.toml:3");
  ExpectRefused("train " + dir + "broken.toml --out " + dir + "run", "broken.toml:1");
  ExpectRefused("train " + dir + "missing.toml --out " + dir + "run", "no such file");
  ExpectRefused("train --resume " + dir + "run", "config.toml");
  ExpectRefused("train " + kSmoke + " --out " + dir + "run --set cem.keep=99", "cem.keep = 99");
  ExpectRefused("train " + kSmoke + " --out " + dir + "run --device toaster", "toaster");
  ExpectRefused("train " + kSmoke, "--out");
  ExpectRefused("sample " + dir + "not.h5 --out " + dir + "s.h5", "not a checkpoint");
  ExpectRefused("sample " + dir + "none.pt --out " + dir + "s.h5", "no such networks");
  ExpectRefused("sample cylinders-prior --fairing nan --out " + dir + "s.h5", "not a number");
  for (const char* command : {"sample cylinders-prior", "dataset make prisms"}) {
    ExpectRefused(std::string(command) + " --count 1 --out " + dir + "x.obj", "name of a mesh");
  }
  ExpectRefused("remesh " + dir + "not.h5 --out " + dir + "m", "not.h5");
  ExpectRefused("evaluate " + dir + "not.h5", "not.h5");
  ExpectRefused("evaluate " + dir + "missing.stl", "missing.stl");
  ExpectRefused("evaluate " + dir + "none --friction -1", "metric.friction");
  ExpectRefused("evaluate " + dir + "none --preset eggs", "one of default, settled, dexnet, egad");
  ExpectRefused("quality " + dir + "none.csv", "no such file");
  ExpectRefused("export " + dir + "not.h5 --out " + dir + "e", "not.h5");
  ExpectRefused("export " + dir + "not.h5 --size-mm nan --out " + dir + "e", "nan");
  ExpectRefused("info " + dir + "not.h5", "not.h5");
  ExpectRefused("info " + dir, "not the folder of a run");
  ExpectRefused("dataset make spheres --out " + dir + "x.h5", "spheres");
  ExpectRefused("dataset make cylinders --out " + dir + "no/x.h5", "folder");
  ExpectRefused("dataset make cylinders --count 2 --out " + dir, "a file name, not a folder");
  ExpectRefused("dataset import " + dir + " --out " + dir + "x.h5", "");
  EXPECT_EQ(shapes::CountFiles(folder.path()), before);
}

TEST(Cli, ScoresAreEqualForAnyNumberOfThreadsAndDifferForAnotherSeed) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  ASSERT_EQ(Antigrasp("dataset make prisms --count 6 --seed 3 --out " + dir + "p.h5").code, 0);
  const std::string common = "evaluate " + dir + "p.h5 --num-grasps 30 --grasps " + dir;
  ASSERT_EQ(Antigrasp(common + "1.csv --threads 1").code, 0);
  ASSERT_EQ(Antigrasp(common + "2.csv --threads 2").code, 0);
  ASSERT_EQ(Antigrasp(common + "3.csv --threads 2 --seed 9").code, 0);
  EXPECT_EQ(ReadFile(dir + "1.csv"), ReadFile(dir + "2.csv"));
  EXPECT_NE(ReadFile(dir + "1.csv"), ReadFile(dir + "3.csv"));
}

TEST(Cli, EvaluatePairsChangedObjectsWithTheirOriginalsUnderEqualRandomNumbers) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  for (const char* set : {"before", "after"}) {
    fs::create_directory(folder / set);
    WriteMesh(folder / set / "ball.stl", shapes::Sphere(1.0, 3));
    WriteMesh(folder / set / "same.stl", shapes::Cylinder(1.0, 3.0, 24));
  }
  // A tetrahedron has no opposite sides: it is harder to hold than a ball.
  WriteMesh(folder / "after/ball.obj", shapes::Tetrahedron());
  fs::remove(folder / "after/ball.stl");
  const Outcome outcome = Antigrasp("evaluate " + dir + "after --baseline " + dir +
                                    "before --num-grasps 20 --out " + dir + "s.csv");
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_NE(outcome.text.find("paired difference -"), std::string::npos) << outcome.text;
  EXPECT_NE(outcome.text.find("candidate grasps"), std::string::npos) << outcome.text;
  const std::string csv = ReadFile(folder / "s.csv");
  EXPECT_NE(csv.find("seconds,baseline,difference,metres_per_unit,"), std::string::npos) << csv;
  const auto same = shapes::CsvRows(folder / "s.csv").back();
  EXPECT_EQ(same.at("object"), "same.stl");
  EXPECT_EQ(same.at("difference"), "0");  // not a draw differs
  const Outcome unpaired =
      Antigrasp("evaluate " + dir + "before --baseline " + dir + "before/ball.stl");
  EXPECT_EQ(unpaired.code, 2);
  EXPECT_NE(unpaired.text.find("antigrasp: 0 originals (--baseline for same.stl): expected exactly "
                               "one object named same\n"),
            std::string::npos)
      << unpaired.text;
}

TEST(Cli, QualityReadsTheGraspsThatEvaluateWrites) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  WriteMesh(folder / "box.stl", shapes::Box({1.0, 1.5, 2.0}));
  ASSERT_EQ(Antigrasp("evaluate " + dir + "box.stl --num-grasps 1 --noise none --num-draws 1 " +
                      "--grasps " + dir + "g.csv --out " + dir + "s.csv")
                .code,
            0);
  ASSERT_EQ(Antigrasp("quality " + dir + "g.csv --out " + dir + "q.csv").code, 0);
  // With one grasp and no noise the graspability is that grasp's epsilon.
  const std::string scores = ReadFile(folder / "s.csv"), quality = ReadFile(folder / "q.csv");
  const std::string head = "box.stl,ok,1,";
  const std::size_t at = scores.find(head) + head.size();
  const double graspability = std::stod(scores.substr(at));
  EXPECT_GT(graspability, 0.0);
  EXPECT_NEAR(std::stod(quality.substr(quality.find("\n1,") + 3)), graspability,
              1e-9 * graspability);
}

TEST(Cli, EvaluateWritesARowPerObjectAndNamesTheBadOnes) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  fs::create_directory(folder / "meshes");
  WriteMesh(folder / "meshes/ball.stl", shapes::Sphere(1.0, 2));
  WriteMesh(folder / "meshes/inside_out.obj", shapes::Inverted(shapes::Sphere(1.0, 2)));
  WriteMesh(folder / "meshes/open.ply", shapes::FlatSquare());
  folder.Write("meshes/noise.off", "rubbish");
  const Outcome outcome = Antigrasp("evaluate " + dir + "meshes --out " + dir + "s.csv");
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  const std::string csv = ReadFile(folder / "s.csv");
  EXPECT_TRUE(
      csv.starts_with("object,status,num_grasps,graspability,ci_low,ci_high,mean,"
                      "fraction_nonzero,seconds,metres_per_unit,extent_x,extent_y,extent_z,"
                      "harder_than_cylinders_pct,harder_than_cylinders_adversarial_pct,"
                      "harder_than_prisms_pct,harder_than_prisms_adversarial_pct,"
                      "harder_than_bottles_pct,harder_than_bottles_adversarial_pct\n"));
  EXPECT_NE(csv.find("ball.stl,ok,1000,"), std::string::npos) << csv;
  EXPECT_NE(csv.find("inside_out.obj,ok,1000,"), std::string::npos) << csv;
  EXPECT_NE(csv.find("noise.off,not readable,0,,"), std::string::npos) << csv;
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 5);
  EXPECT_NE(ReadFile(folder / "s.csv.metric.toml").find("friction = 0.5"), std::string::npos);
}

TEST(Cli, EgadPresetAddsItsScoreAndOtherFlagsWinOverThePreset) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  WriteMesh(folder / "box.stl", shapes::Box(Eigen::Vector3d(1.0, 1.0, 1.0)));
  const std::string evaluate = "evaluate " + dir + "box.stl --out " + dir;
  ASSERT_EQ(Antigrasp(evaluate + "egad.csv --preset egad --noise default --num-grasps 30").code, 0);
  const std::string constants = ReadFile(folder / "egad.csv.metric.toml");
  for (const char* line : {"torque_scale = 100", "num_draws = 1", "num_grasps = 30",
                           "object_translation_std = 0.0025"}) {
    EXPECT_NE(constants.find(line), std::string::npos) << line << "\n" << constants;
  }
  ASSERT_EQ(Antigrasp(evaluate + "egad.csv --preset egad").code, 0);
  const std::string csv = ReadFile(folder / "egad.csv");
  ASSERT_NE(csv.find(",seconds,egad,metres_per_unit,"), std::string::npos) << csv;
  const std::string row = csv.substr(csv.find('\n') + 1);
  ASSERT_TRUE(row.starts_with("box.stl,ok,100,")) << row;
  const double graspability = std::stod(row.substr(std::string("box.stl,ok,100,").size()));
  EXPECT_GT(graspability, 0.002);  // of at most 0.003927, the torsion cap
  EXPECT_LT(graspability, 0.003927);
  EXPECT_NEAR(std::stod(shapes::CsvRows(folder / "egad.csv").front().at("egad")),
              (graspability - 0.0005) / 0.0035 * 100.0, 1e-9);
  ASSERT_EQ(Antigrasp(evaluate + "plain.csv --num-grasps 10").code, 0);
  EXPECT_EQ(ReadFile(folder / "plain.csv").find("egad"), std::string::npos);
}

TEST(Cli, QualityScoresATableOfContactsAlikeForAnyNumberOfThreads) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  const std::string quality = "quality " ANTIGRASP_TEST_DATA "/quality/contacts.csv --out " + dir;
  const Outcome outcome = Antigrasp(quality + "1.csv --threads 1");
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_NE(outcome.text.find("500 grasps: 366 with epsilon > 0, 371 in"), std::string::npos)
      << outcome.text;
  EXPECT_NE(outcome.text.find("102 of 500 wrenches resisted"), std::string::npos) << outcome.text;
  ASSERT_EQ(Antigrasp(quality + "2.csv --threads 2").code, 0);
  const std::string csv = ReadFile(folder / "1.csv");
  EXPECT_EQ(csv, ReadFile(folder / "2.csv"));
  EXPECT_TRUE(csv.starts_with(
      "id,epsilon,force_closure,force_closure_signed,wrench_resisted,wrench_resistance\np0000,"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 501);
  EXPECT_NE(ReadFile(folder / "1.csv.quality.toml").find("regularizer = 1e-10"), std::string::npos);
  ASSERT_EQ(Antigrasp(quality + "hard.csv --torsion none --oppose-target").code, 0);
  EXPECT_NE(ReadFile(folder / "hard.csv.quality.toml").find("oppose_target = true"),
            std::string::npos);
}

TEST(Cli, QualityNamesABadRowAndWritesNothing) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  const std::string header = "p1x,p1y,p1z,n1x,n1y,n1z,p2x,p2y,p2z,n2x,n2y,n2z,comx,comy,comz\n";
  const std::string good = "-0.02,0,0,-1,0,0,0.02,0,0,1,0,0,0,0,0\n";
  folder.Write("bad.csv", header + good + "-0.02,0,0,-1,0,0,0.02,oops,0,1,0,0,0,0,0\n");
  folder.Write("columns.csv", "id,p1x\na,1\n");
  folder.Write("good.csv", header + good);
  const int before = shapes::CountFiles(folder.path());
  const std::string out = " --out " + dir + "out.csv";
  ExpectRefused("quality " + dir + "bad.csv" + out, "bad.csv:3): expected a finite number");
  ExpectRefused("quality " + dir + "columns.csv" + out, "no column p1y p1z n1x");
  ExpectRefused("quality " + dir + "good.csv --out " + dir + "no/out.csv", "folder");
  ExpectRefused("quality " + dir + "good.csv --torsion rubber" + out, "contact.torsion");
  EXPECT_EQ(shapes::CountFiles(folder.path()), before);
  const Outcome printed = Antigrasp("quality " + dir + "good.csv");
  EXPECT_EQ(printed.code, 0);
  EXPECT_NE(printed.text.find("\n1,0.03909"), std::string::npos) << printed.text;
}

TEST(Cli, ExportsSolidsInMillimetresAndLeavesTheRestOut) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  WriteMesh(folder / "ball.ply", shapes::Sphere(0.3, 2));
  WriteMesh(folder / "open.ply", shapes::FlatSquare());
  const Outcome outcome =
      Antigrasp("export " + dir + "ball.ply " + dir + "open.ply --size-mm 80 --out " + dir + "out");
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_EQ(shapes::CountFiles(folder / "out"), 2);  // the ball and print.csv
  const TriangleMesh mesh = ReadMesh(folder / "out/ball.stl");
  EXPECT_NEAR(Bounds(mesh).Extent().maxCoeff(), 80.0, 1e-4);
  EXPECT_NEAR(Bounds(mesh).min.z(), 0.0, 1e-4);
  EXPECT_EQ(WhyNotSolid(Inspect(mesh)), "");
  const Outcome refused = Antigrasp("export " + dir + "open.ply --out " + dir + "none");
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.text.find("open.ply: open: 4 boundary edges"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder / "none"));
}

TEST(Cli, ExportChecksThePrintAndTurnsTheObjectWhenAsked) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  WriteMesh(folder / "slab \"a,b\".stl", shapes::Box({1.0, 0.01, 0.5}));
  WriteMesh(folder / "cube.stl", shapes::Cube());
  const std::string common = "export " + dir + " --size-mm 50 --out " + dir;
  const Outcome as_is = Antigrasp(common + "a --threads 1");
  ASSERT_EQ(as_is.code, 0) << as_is.text;
  EXPECT_NE(as_is.text.find("2 watertight; 1 with a wall below 0.8 mm, the thinnest 0.5 mm"),
            std::string::npos)
      << as_is.text;
  ASSERT_EQ(Antigrasp("export " + dir + "cube.stl '" + dir + "slab \"a,b\".stl' --size-mm 50" +
                      " --out " + dir + "p --pose print --format off --threads 2")
                .code,
            0);
  std::string turned = ReadFile(folder / "p/print.csv");  // the same but for the format
  for (std::size_t at = 0; (at = turned.find(".off", at)) != std::string::npos;) {
    turned.replace(at, 4, ".stl");
  }
  EXPECT_EQ(ReadFile(folder / "a/print.csv"), turned);
  CsvReader csv(folder / "a/print.csv");
  ASSERT_TRUE(csv.Next());
  EXPECT_EQ(csv.Field(0), "cube.stl");
  EXPECT_NEAR(*csv.Number(*csv.Column("wall_mm")), 50.0, 1e-3);
  ASSERT_TRUE(csv.Next());
  EXPECT_EQ(csv.Field(0), "slab \"a,b\".stl");
  EXPECT_NEAR(*csv.Number(*csv.Column("wall_mm")), 0.5, 1e-3);
  EXPECT_NEAR(*csv.Number(*csv.Column("size_y_mm")), 0.5, 1e-6);
  EXPECT_NEAR(*csv.Number(*csv.Column("print_z_mm")), 0.5, 1e-6);
  EXPECT_EQ(*csv.Number(*csv.Column("overhang_share")), 0.0);
  EXPECT_NE(csv.Field(*csv.Column("notes")).find("thinnest wall is 0.5 mm"), std::string::npos);
  EXPECT_FALSE(csv.Next());
  // As it is the slab stands on its edge, in the suggested pose it lies.
  EXPECT_NEAR(Bounds(ReadMesh(folder / "a/slab \"a,b\".stl")).max.z(), 25.0, 1e-4);
  EXPECT_NEAR(Bounds(ReadMesh(folder / "p/slab \"a,b\".off")).max.z(), 0.5, 1e-4);
  ExpectRefused("export " + dir + "cube.stl --out " + dir + "x --pose sideways", "sideways");
  ExpectRefused("export " + dir + "cube.stl --out " + dir + "x --min-wall-mm -1", "min_wall_mm");
  EXPECT_FALSE(fs::exists(folder / "x"));
}

// Over ten seconds: all networks that ship, at their full width.
TEST(Cli, PretrainedNetworksAreSampledByNameAndMakeSolids) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  const Outcome unknown = Antigrasp("sample nobody-made-this --out " + dir + "x.h5");
  std::set<std::string> names;
  for (const auto& entry :
       fs::directory_iterator(fs::path(ANTIGRASP_CONFIGS) / "../checkpoints/pretrained")) {
    names.insert(entry.path().stem().string());
  }
  EXPECT_TRUE(names.contains("cylinders-prior"));
  for (const std::string& name : names) {
    EXPECT_NE(unknown.text.find(name), std::string::npos) << unknown.text;
    const Outcome sample = Antigrasp("sample " + name + " --count 16 --out " + dir + "batch.h5");
    ASSERT_EQ(sample.code, 0) << sample.text;
    int solids = 0;
    for (const SdfGrid& grid : ReadShapeSet(folder / "batch.h5").grids) {
      solids += Remesh(grid).ok() ? 1 : 0;
    }
    EXPECT_GE(solids, 14) << name;
  }
}

}  // namespace
}  // namespace antigrasp
