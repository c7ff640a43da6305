// perturb search --objective: a judge named on the command line.
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/csv_reader.h"
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
using shapes::TempFolder;

constexpr const char* kQuickSearch =
    " --friction 0.25 --starts 1 --descent-steps 10 --generations 1 --judge-grasps 4 "
    "--judge-draws 1 --num-grasps 6 --num-draws 2 --subdivide 12 ";

TEST(JudgedSearchCli, TriesBothMeshesAsTrialDoesAndDoesNotDependOnTheThreads) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  WriteMesh(folder / "box.stl", shapes::Box({30, 40, 60}));
  WriteMesh(folder / "cube.stl", shapes::Box({40, 40, 40}));
  const std::string search = "perturb search --objective trial" + std::string(kQuickSearch) + dir +
                             "box.stl " + dir + "cube.stl ";
  const Outcome outcome = Antigrasp(search + "--threads 1 --out " + dir + "one");
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_NE(outcome.text.find("judge trial:six-ways, 2 of 2 objects: "), std::string::npos)
      << outcome.text;
  ASSERT_EQ(Antigrasp(search + "--threads 3 --out " + dir + "three").code, 0);
  for (const char* file : {"perturb.csv", "after/box.stl", "perturb.toml", "summary.csv"}) {
    EXPECT_EQ(ReadFile(folder / "one" / file), ReadFile(folder / "three" / file)) << file;
  }
  EXPECT_NE(ReadFile(folder / "one/perturb.toml").find("objective = 'trial'"), std::string::npos);
  // The same numbers as the command trial's at equal mass.
  ASSERT_EQ(Antigrasp("trial " + dir + "one/after --baseline " + dir +
                      "one/before --friction 0.25 --num-grasps 6 --num-draws 2 --out " + dir + "t")
                .code,
            0);
  CsvReader judged(folder / "one/perturb.csv"), tried(folder / "t/means.csv");
  double before = 0.0, after = 0.0;
  while (judged.Next()) {
    EXPECT_EQ(judged.Field(judged.RequiredColumn("judge")), "trial:six-ways");
    before += 50.0 * judged.NumberOrGap(judged.RequiredColumn("judge_before"));
    after += 50.0 * judged.NumberOrGap(judged.RequiredColumn("judge_after"));
  }
  bool found = false;
  while (tried.Next()) {
    if (tried.Field(tried.RequiredColumn("masses")) != "equal" ||
        tried.Field(tried.RequiredColumn("stage")) != "1 g" ||
        tried.Field(tried.RequiredColumn("grasps")) != "all") {
      continue;
    }
    found = true;
    EXPECT_NEAR(tried.NumberOrGap(tried.RequiredColumn("held_before")), before, 1e-9);
    EXPECT_NEAR(tried.NumberOrGap(tried.RequiredColumn("held")), after, 1e-9);
  }
  EXPECT_TRUE(found);
}

TEST(JudgedSearchCli, RefusesAnUnknownProtocolAndOptionsOfTheOtherSearch) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  WriteMesh(folder / "cube.stl", shapes::Cube());
  const std::string search = "perturb search " + dir + "cube.stl --out " + dir + "out ";
  ExpectRefused(search + "--objective trial:robot", "no protocol robot");
  ExpectRefused(search + "--objective trial --alpha 20", "--alpha 20");
  ExpectRefused(search + "--hausdorff 3", "--objective settled");
  EXPECT_FALSE(fs::exists(folder / "out/perturb.csv"));
}

TEST(JudgedSearchCli, ListensToAProgram) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  WriteMesh(folder / "cube.stl", shapes::Box({40, 40, 40}));
  // Every object has the score 0.5: nothing is better than the original.
  const std::string judge =
      "sed -u 's/.*\\\"id\\\": *\\([0-9]*\\).*/{\\\"id\\\": \\1, \\\"score\\\": 0.5}/'";
  const Outcome outcome = Antigrasp("perturb search --objective \"" + judge + "\"" + kQuickSearch +
                                    dir + "cube.stl --out " + dir + "out");
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  CsvReader rows(folder / "out/perturb.csv");
  ASSERT_TRUE(rows.Next());
  EXPECT_EQ(rows.NumberOrGap(rows.RequiredColumn("judge_after")), 0.5);
  EXPECT_NE(ReadFile(folder / "out/perturb.toml").find("\n[judge]\nname = "), std::string::npos);
  EXPECT_EQ(rows.NumberOrGap(rows.RequiredColumn("moved")), 0.0);
}

}  // namespace
}  // namespace antigrasp
