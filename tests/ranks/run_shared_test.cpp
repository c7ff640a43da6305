#include "antigrasp/ranks/run_shared.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "antigrasp/core/atomic_file.h"
#include "tests/support/temp_folder.h"

namespace antigrasp {
namespace {

using Lines = std::vector<std::string>;

// All but the version.
Lines Same(std::vector<std::string> words) {
  words.insert(words.begin(), "antigrasp");
  Lines lines = SameCall(words);
  EXPECT_TRUE(lines.at(0).starts_with("antigrasp "));
  lines.erase(lines.begin());
  return lines;
}

TEST(SameCall, IsEveryOptionWithItsValuesButForWhatOneRankDecides) {
  EXPECT_EQ(Same({"evaluate", "no.stl", "nor.stl", "--seed", "7", "--noise=low", "--out", "a.csv"}),
            (Lines{"evaluate no.stl nor.stl", "--seed 7", "--noise=low"}));
  EXPECT_EQ(Same({"trial", "--threads", "3", "no.stl", "--processes=4", "--friction", "-0.5"}),
            (Lines{"trial", "no.stl", "--friction -0.5"}));
  EXPECT_EQ(Same({"perturb", "search", "--grasps", "g.csv", "--no-approach", "--report=r"}),
            (Lines{"perturb search", "--no-approach"}));
}

TEST(SameCall, SaysWhatFilesAndFoldersHold) {
  const shapes::TempFolder folder;
  const std::string text = (folder / "a.toml").string(), all = folder.path().string();
  WriteFileAtomic(text, "width = 1\n");
  const Lines one = Same({"evaluate", all, "--gripper", text});
  ASSERT_EQ(one.size(), 4U);
  EXPECT_TRUE(one[2].starts_with(all + ": 1 file, 10 bytes, ")) << one[2];
  EXPECT_TRUE(one[3].starts_with(text + ": 1 file, 10 bytes, ")) << one[3];
  WriteFileAtomic(text, "width = 2\n");  // of the same size
  const Lines other = Same({"evaluate", all, "--gripper", text});
  EXPECT_EQ(other[2], one[2]);
  EXPECT_NE(other[3], one[3]);
  WriteFileAtomic(folder / "b", "1");
  EXPECT_TRUE(Same({"evaluate", all})[1].starts_with(all + ": 2 files, 11 bytes, "));
  // What rank 0 writes over is nobody's input.
  EXPECT_EQ(Same({"evaluate", "--out", text, "--grasps", text}), Lines{"evaluate"});
}

}  // namespace
}  // namespace antigrasp
