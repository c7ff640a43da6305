// The command evaluate with grasps and judges that are given to it.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/mesh/mesh_file.h"
#include "tests/app/run_binary.h"
#include "tests/support/csv_rows.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;
using cli::Antigrasp;
using cli::ExpectRefused;
using cli::Outcome;
using shapes::CsvRows;
using shapes::TempFolder;

// Far from the origin: what belongs to the object and what to its frame differ.
void WriteBoxAside(const fs::path& path) {
  WriteMesh(path, Transformed(shapes::Box({1.0, 1.5, 2.0}), 1.0, {5.0, 5.0, 5.0}));
}

// Every column of the result by its name, against the table that it was made of.
TEST(EvaluateCli, GraspsThatItWroteScoreTheSameAgainToTheLastBit) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  WriteBoxAside(folder / "box.stl");
  WriteMesh(folder / "torus.stl", shapes::Torus(1.0, 0.4, 24, 12));
  const std::string common = "evaluate " + dir + "box.stl " + dir + "torus.stl --seed 5" +
                             " --num-grasps 12 --num-draws 3 --friction 0.3 ";
  for (const char* frame : {"metres", "mesh"}) {
    ASSERT_EQ(Antigrasp(common + "--grasps " + dir + "g.csv --frame " + frame).code, 0);
    const Outcome outcome =
        Antigrasp(common + "--grasps-in " + dir + "g.csv --out " + dir + "again.csv");
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_NE(outcome.text.find("24 grasps of 2 objects: 24 ok\n"), std::string::npos)
        << outcome.text;
    const auto given = CsvRows(folder / "g.csv"), again = CsvRows(folder / "again.csv");
    ASSERT_EQ(again.size(), 24U);
    int other = 0;  // both are 0 of some
    for (std::size_t i = 0; i < again.size(); ++i) {
      EXPECT_EQ(again[i].at("object"), given[i].at("object"));
      EXPECT_EQ(again[i].at("grasp"), given[i].at("grasp"));
      EXPECT_EQ(again[i].at("robust_quality"), given[i].at("robust_quality"));
      EXPECT_EQ(again[i].at("reachable"), "1");
      other += again[i].at("epsilon") != again[i].at("robust_quality") ? 1 : 0;
      EXPECT_EQ(given[i].at("frame"), frame);
    }
    EXPECT_GT(other, 12);
  }
  EXPECT_TRUE(fs::exists(folder / "again.csv.metric.toml"));
  EXPECT_FALSE(fs::exists(folder / "again.csv.trial.toml"));
}

// By extension and by name; both objects of the call, in a file each or in one.
TEST(EvaluateCli, GraspsOfSeveralObjectsGoIntoAFolderOfFilesThatAreReadAgain) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  WriteBoxAside(folder / "box.stl");
  WriteMesh(folder / "torus.stl", shapes::Torus(1.0, 0.4, 24, 12));
  const std::string common = "evaluate " + dir + "box.stl " + dir + "torus.stl --gripper panda" +
                             " --num-grasps 8 --num-draws 2 ";
  for (const std::string flags : {"all.hdf5", "set --grasp-format isaac"}) {
    ASSERT_EQ(Antigrasp(common + "--grasps " + dir + flags).code, 0) << flags;
    const Outcome again =
        Antigrasp(common + "--grasps-in " + dir + flags.substr(0, flags.find(' ')));
    EXPECT_NE(again.text.find("16 grasps of 2 objects: 16 ok\n"), std::string::npos) << again.text;
  }
  EXPECT_TRUE(fs::exists(folder / "set/torus.yaml"));
  cli::ExpectRefused(common + "--grasps " + dir + "set --grasp-format isaac", "an empty folder");
  cli::ExpectRefused(common + "--grasps " + dir + "g.json", "2 objects in one file");
  cli::ExpectRefused(common + "--grasp-format csv", "--grasp-format requires --grasps");
  cli::ExpectRefused(common + "--success-quality 0.1", "--success-quality requires --grasps");
  cli::ExpectRefused("evaluate " + dir + "box.stl --grasps-in " + dir + "all.hdf5",
                     "grasps of the gripper panda, scored with yumi");
}

TEST(EvaluateCli, RefusesGivenGraspsAndJudgesThatCannotBeInOneLine) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  WriteMesh(folder / "cube.stl", shapes::Cube());
  folder.Write("g.csv", "center_x,center_y,center_z,axis_x,axis_y,axis_z\n0,0,0,1,0,0\n");
  folder.Write("empty.csv", "center_x,center_y,center_z,axis_x,axis_y,axis_z\n");
  const std::string cube = "evaluate " + dir + "cube.stl ", given = cube + "--grasps-in " + dir;
  cli::ExpectRefused(given + "empty.csv", "no grasps (" + dir + "empty.csv)");
  cli::ExpectRefused(given + "none.csv", "no such file");
  cli::ExpectRefused(given + "g.csv --out " + dir + "g.csv", "written over a file that is read");
  cli::ExpectRefused(given + "g.csv --judge epsilon", "--judge");
  cli::ExpectRefused(cube + "--trial six-ways", "--trial (evaluate): expected --grasps FILE");
  cli::ExpectRefused(cube + "--trial six-ways --grasps " + dir + "l.csv",
                     "grasps with labels as csv");
  cli::ExpectRefused(cube + "--trial six-ways --hardest 1", "--hardest");
  cli::ExpectRefused(cube + "--tip pad", "--trial PROTOCOL beside them");
  cli::ExpectRefused(given + "g.csv --trial paper --series 3", "--series 3");
  cli::ExpectRefused(given + "g.csv --trial shake", "--trial");
  cli::ExpectRefused(cube + "--judge trial:shake", "no protocol shake");
  cli::ExpectRefused(cube + "--judge-limit 3", "--judge-limit requires --judge");
  cli::ExpectRefused(cube + "--judge x --judge-limit nan", "--judge-limit");
}

// Three times started, three times gone: what the metric says is written, the exit code tells.
TEST(EvaluateCli, AJudgeThatIsGivenUpCostsNoScore) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  WriteMesh(folder / "cube.stl", shapes::Cube());
  const Outcome outcome =
      Antigrasp("evaluate " + dir + "cube.stl --num-grasps 5 --num-draws 1 --judge 'exit 3'" +
                " --judge-restarts 0 --out " + dir + "s.csv");
  EXPECT_EQ(outcome.code, 1) << outcome.text;
  EXPECT_NE(outcome.text.find("judge exit 3: 0 scored, 1 judge stopped\n"), std::string::npos)
      << outcome.text;
  EXPECT_NE(outcome.text.find("antigrasp: the judge stopped: exit 3: ended with exit code 3 after "
                              "0 restarts\n"),
            std::string::npos)
      << outcome.text;
  const auto rows = CsvRows(folder / "s.csv");
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_GT(std::stod(rows[0].at("graspability")), 0.0);
  EXPECT_EQ(rows[0].at("judge"), "");
  EXPECT_EQ(rows[0].at("judge_status"), "judge stopped");
  EXPECT_TRUE(fs::exists(folder / "s.csv.metric.toml"));
}

// What the metric says is written, too; the exit code is that of a set without a score.
TEST(EvaluateCli, AJudgeThatScoresNothingIsTold) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  WriteMesh(folder / "cube.stl", shapes::Cube());
  folder.Write("null.sh", "sed -u 's/.*\"id\":\\([0-9]*\\).*/{\"id\": \\1, \"score\": null}/'\n");
  const Outcome outcome =
      Antigrasp("evaluate " + dir + "cube.stl --num-grasps 5 --num-draws 1 --judge 'sh " + dir +
                "null.sh' --judge-limit 20 --out " + dir + "s.csv");
  EXPECT_EQ(outcome.code, 2) << outcome.text;
  EXPECT_NE(outcome.text.find("antigrasp: the judge scored no object: 0 scored, 1 no score"),
            std::string::npos)
      << outcome.text;
  EXPECT_EQ(CsvRows(folder / "s.csv")[0].at("judge_status"), "no score");
  const std::string toml = ReadFile(folder / "s.csv.metric.toml");
  EXPECT_NE(toml.find("null.sh"), std::string::npos) << toml;
  EXPECT_NE(toml.find("\nlimit = 20"), std::string::npos) << toml;
}

// Planned at true size, asked about at 40 mm, and about another object.
TEST(EvaluateCli, GraspsOfAnotherSizeOrObjectAreRefused) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  WriteMesh(folder / "box.stl", shapes::Box({30.0, 40.0, 50.0}));
  WriteMesh(folder / "other.stl", shapes::Box({30.0, 40.0, 50.0}));
  const std::string size = " --units mm --true-size --num-grasps 4 ";
  ASSERT_EQ(Antigrasp("evaluate " + dir + "box.stl --grasps " + dir + "g.csv" + size).code, 0);
  const std::string given = " --grasps-in " + dir + "g.csv ";
  EXPECT_EQ(Antigrasp("evaluate " + dir + "box.stl" + given + size).code, 0);
  cli::ExpectRefused("evaluate " + dir + "box.stl" + given,
                     "grasps of box.stl at metres_per_unit 0.001, which is scored at 0.00133");
  cli::ExpectRefused("evaluate " + dir + "other.stl" + given + size,
                     "grasps of box.stl, no grasp of other.stl");
}

}  // namespace
}  // namespace antigrasp
