// The command bundle: what it writes and what it refuses.
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

TEST(BundleCli, WritesAFolderAnObjectWhateverItsNameAndReplacesNothingUnasked) {
  const shapes::TempFolder folder;
  const std::string box = folder / "a&b's.stl", out = folder / "out";
  WriteMesh(box, shapes::Box({40.0, 60.0, 80.0}));
  const std::string call =
      "bundle \"" + box + "\" --scale true --units mm --mass 0.05 --out " + out;
  const cli::Outcome outcome = cli::Antigrasp(call);
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_NE(outcome.text.find("1 of 1 objects in " + out), std::string::npos) << outcome.text;
  const auto rows = shapes::CsvRows(out + "/bundle.csv");
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].at("parts"), "1");
  EXPECT_EQ(rows[0].at("mass"), "0.05");
  const std::string mjcf = ReadFile(out + "/a&b's/a&b's.xml");
  EXPECT_NE(mjcf.find("a&amp;b&#39;s"), std::string::npos) << mjcf;
  EXPECT_TRUE(fs::exists(out + "/a&b's/a&b's.urdf"));
  EXPECT_TRUE(fs::exists(out + "/a&b's/self_check.xml"));
  const std::string usd = ReadFile(out + "/a&b's/a&b's.usda");
  EXPECT_NE(usd.find("def Xform \"a_b_s\""), std::string::npos) << usd;
  EXPECT_NE(ReadFile(out + "/a&b's/model.sdf").find("<uri>a&amp;b&#39;s.stl</uri>"),
            std::string::npos);
  cli::ExpectRefused(call, "holds bundle.csv already");
  EXPECT_EQ(cli::Antigrasp(call + " --for urdf --overwrite").code, 0);
  EXPECT_FALSE(fs::exists(out + "/a&b's/self_check.xml"));
}

TEST(BundleCli, RefusesBadInputInOneLineAndWritesNothing) {
  const shapes::TempFolder folder;
  const std::string box = folder / "box.stl", out = folder / "out";
  WriteMesh(box, shapes::Box({40.0, 60.0, 80.0}));
  cli::ExpectRefused("bundle " + box + " --parts 0 --out " + out, "bundle.parts = 0");
  cli::ExpectRefused("bundle " + box + " --for gazebo --out " + out, "gazebo");
  cli::ExpectRefused("bundle " + box + " --gripper nobody --out " + out, "no gripper nobody");
  cli::ExpectRefused("bundle nothing.stl --out " + out, "no such file");
  // Of metres where millimetres were meant: nowhere narrower than a hand opens.
  const cli::Outcome wide =
      cli::Antigrasp("bundle " + box + " --scale true --gripper panda --out " + out);
  EXPECT_EQ(wide.code, 2);
  EXPECT_NE(wide.text.find("40 m wide where it is narrowest: the gripper opens 80 mm"),
            std::string::npos)
      << wide.text;
  EXPECT_FALSE(fs::exists(out));
}

}  // namespace
}  // namespace antigrasp
