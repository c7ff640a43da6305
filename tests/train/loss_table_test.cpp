#include "antigrasp/train/loss_table.h"

#include <gtest/gtest.h>

#include <cmath>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "tests/support/temp_folder.h"

namespace antigrasp {
namespace {

using shapes::TempFolder;

LossTable Losses() { return {{"radius", "gap"}, {{10, 0.25, std::nan("")}, {20, 0.5, 1.0 / 3}}}; }

TEST(LossTable, ReadsBackWhatWasWrittenUnderTheModelsOwnNames) {
  const TempFolder folder;
  EXPECT_EQ(LossesCsv(Losses()), "step,radius,gap\n10,0.25,\n20,0.5,0.3333333333333333\n");
  WriteFileAtomic(folder / "losses.csv", LossesCsv(Losses()));
  const LossTable read = ReadLosses(folder / "losses.csv");
  EXPECT_EQ(read.scalars, Losses().scalars);
  ASSERT_EQ(read.rows.size(), 2U);
  EXPECT_TRUE(std::isnan(read.rows[0][2]));
  EXPECT_EQ(read.rows[1], Losses().rows[1]);
}

TEST(LossTable, TheStepComesFirstWhereverItStoodInTheFile) {
  const TempFolder folder;
  WriteFileAtomic(folder / "losses.csv", "a,step,b\n1,2,3\n");
  const LossTable read = ReadLosses(folder / "losses.csv");
  EXPECT_EQ(read.scalars, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(read.rows, (std::vector<LossRow>{{2, 1, 3}}));
}

TEST(LossTable, SurvivesACheckpointsTensor) {
  const torch::Tensor tensor = LossTensor(Losses());
  EXPECT_EQ(tensor.sizes(), (torch::IntArrayRef{2, 3}));
  const std::vector<LossRow> rows = LossRows(tensor, 2, "x.pt");
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[1], Losses().rows[1]);
  EXPECT_EQ(rows[0][1], 0.25);
  EXPECT_TRUE(std::isnan(rows[0][2]));
  EXPECT_THROW(LossRows(tensor, 3, "x.pt"), InputError);
  EXPECT_THROW(LossRows(tensor.flatten(), 2, "x.pt"), InputError);
  EXPECT_EQ(LossTensor({{"a"}, {}}).sizes(), (torch::IntArrayRef{0, 2}));
}

}  // namespace
}  // namespace antigrasp
