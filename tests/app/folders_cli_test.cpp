// Commands that fill a folder: one rule for all of them (datasets/result_folder.h).
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/datasets/prior_set.h"
#include "antigrasp/datasets/shape_set.h"
#include "antigrasp/mesh/mesh_file.h"
#include "tests/app/run_binary.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;
using cli::Antigrasp;
using cli::ExpectRefused;
using cli::Outcome;
using shapes::FileContents;
using shapes::TempFolder;

struct Command {
  std::string words;          // before the objects
  std::string options;        // behind them
  std::string table, a_mesh;  // of what it writes; `a_mesh` of the first objects alone
  int code_of_nothing = 1;    // when no object succeeds
};
// All of them. train has more ways to begin in a used folder (docs/reliability.md).
std::vector<Command> Commands() {
  const std::string quick = " --num-grasps 5 --num-draws 3";
  std::vector<Command> commands{// What cannot be exported is bad input, and nothing is written.
                                {"export", "", "print.csv", "first.stl", 2},
                                {"export", " --format ply", "print.csv", "first.ply", 2},
                                {"remesh", "", "remesh.csv", "first.obj"}};
  for (const std::string method : {"exhaustive --iterations 1", "random --iterations 3 --history",
                                   "rotation --iterations 3"}) {
    commands.push_back({"perturb " + method, quick, "perturb.csv", "before/first.stl"});
  }
  commands.push_back(
      {"perturb search --steps 2 --grasps 5", quick, "perturb.csv", "after/first.stl"});
  return commands;
}

// Two sets without a name in common, and one of grids that are no solid.
void WriteInputs(const TempFolder& folder) {
  PriorSetOptions options;
  options.count = 2;
  WritePriorSet(folder / "first.h5", options);
  ShapeSet set = ReadShapeSet(folder / "first.h5");
  set.names = {"first", "other"};
  WriteShapeSet(folder / "first.h5", set);
  set.names = {"second", "another"};
  WriteShapeSet(folder / "second.h5", set);
  for (SdfGrid& grid : set.grids) grid.values.assign(grid.values.size(), -0.5F);
  WriteShapeSet(folder / "none.h5", set);
}

TEST(FoldersCli, AUsedFolderIsRefusedAndOverwrittenOnlyWhenAskedAndOnlyItsOwnFiles) {
  for (const Command& command : Commands()) {
    const TempFolder folder;
    WriteInputs(folder);
    const std::string dir = folder.path().string() + "/";
    const auto call = [&](const std::string& set, const std::string& out) {
      return command.words + " " + dir + set + ".h5" + command.options + " --out " + dir + out;
    };
    SCOPED_TRACE(call("", ""));
    ASSERT_EQ(Antigrasp(call("first", "out")).code, 0);
    ASSERT_EQ(Antigrasp(call("second", "fresh")).code, 0);
    ASSERT_TRUE(fs::exists(folder / "out" / command.a_mesh));
    const auto first = FileContents(folder / "out");
    // With the same objects and with others; the line is the whole output.
    for (const char* set : {"first", "second"}) {
      ExpectRefused(call(set, "out"), "antigrasp: holds " + command.table + " already (" + dir +
                                          "out): expected a new folder, or --overwrite to replace "
                                          "what an earlier call wrote\n");
    }
    EXPECT_TRUE(FileContents(folder / "out") == first);
    folder.Write("out/mine.txt", "mine");
    const Outcome over = Antigrasp(call("second", "out") + " --overwrite");
    EXPECT_EQ(over.code, 0) << over.text;
    auto expected = FileContents(folder / "fresh");
    expected["mine.txt"] = "mine";
    EXPECT_TRUE(FileContents(folder / "out") == expected);
  }
}

TEST(FoldersCli, WhenNothingSucceedsTheExitCodeSaysSoAndNoOldMeshLooksLikeAResult) {
  for (const Command& command : Commands()) {
    const TempFolder folder;
    WriteInputs(folder);
    const std::string dir = folder.path().string() + "/", out = " --out " + dir + "out";
    ASSERT_EQ(Antigrasp(command.words + " " + dir + "first.h5" + command.options + out).code, 0);
    const auto first = FileContents(folder / "out");
    const Outcome none =
        Antigrasp(command.words + " " + dir + "none.h5" + command.options + out + " --overwrite");
    SCOPED_TRACE(command.words + "\n" + none.text);
    EXPECT_EQ(none.code, command.code_of_nothing);
    EXPECT_EQ(none.text.find(" in " + dir + "out\n"), std::string::npos);
    if (command.code_of_nothing == 2) {
      EXPECT_TRUE(FileContents(folder / "out") == first);
      continue;
    }
    EXPECT_NE(none.text.find("/" + command.table + " says why\n"), std::string::npos);
    const auto left = FileContents(folder / "out");
    EXPECT_NE(left.at(command.table).find("second,"), std::string::npos);
    for (const auto& [file, bytes] : left) {
      EXPECT_FALSE(IsMeshFile(file) || file.ends_with(".png")) << file;
    }
  }
}

}  // namespace
}  // namespace antigrasp
