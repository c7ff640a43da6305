#include "antigrasp/models/largest_piece.h"

#include <gtest/gtest.h>
#include <torch/types.h>

namespace antigrasp {
namespace {

// Two shapes of 4^3 nodes, outside everywhere.
torch::Tensor Outside() { return torch::full({2, 1, 4, 4, 4}, -0.5); }

TEST(LargestPiece, ANodeThatOnlyMeetsTheShapeAtACornerIsLeftOut) {
  torch::Tensor values = Outside();
  values[0][0].narrow(0, 0, 2).narrow(1, 0, 2).narrow(2, 0, 2).fill_(0.25);
  values[0][0][2][2][2] = 0.125;  // along the diagonal from the block
  values[1][0][3][3][0] = 0.75;   // the row's end and the next row's beginning are no neighbours
  values[1][0][3][2][3] = 0.5;
  values[1][0][3][2][2] = 0.5;
  const torch::Tensor kept = LargestPiece(values);
  torch::Tensor expected = values.clone();
  expected[0][0][2][2][2] = -0.125;
  expected[1][0][3][3][0] = -0.75;
  EXPECT_TRUE(torch::equal(kept, expected));
  EXPECT_EQ(values[0][0][2][2][2].item<float>(), 0.125F) << "the values that were given stay";
}

TEST(LargestPiece, RowsEndWhereTheyEnd) {
  torch::Tensor values = Outside().narrow(0, 0, 1);
  for (const int y : {0, 1, 2}) values[0][0][1][y][0] = 0.25;
  values[0][0][1][0][3] = values[0][0][1][1][3] = 0.25;  // before the next row's beginning
  const torch::Tensor kept = LargestPiece(values);
  EXPECT_EQ(kept[0][0][1][0][3].item<float>(), -0.25F);
  EXPECT_EQ(kept[0][0][1][1][3].item<float>(), -0.25F);
  EXPECT_EQ((kept > 0).sum().item<int>(), 3);
}

TEST(LargestPiece, OfEqualPiecesTheFirstStaysAndOneOrNonePieceAsItIs) {
  torch::Tensor values = Outside();
  values[0][0][1][1][3] = values[0][0][3][0][0] = 0.25;
  const torch::Tensor kept = LargestPiece(values);
  EXPECT_EQ(kept[0][0][1][1][3].item<float>(), 0.25F);
  EXPECT_EQ(kept[0][0][3][0][0].item<float>(), -0.25F);
  EXPECT_TRUE(torch::equal(kept[1], values[1]));
  EXPECT_TRUE(
      torch::equal(LargestPiece(torch::ones({1, 1, 4, 4, 4})), torch::ones({1, 1, 4, 4, 4})));
}

}  // namespace
}  // namespace antigrasp
