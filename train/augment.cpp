#include "antigrasp/train/augment.h"

#include <torch/types.h>

#include <vector>

#include "antigrasp/models/folding.h"

namespace antigrasp {

torch::Tensor Augment(const torch::Tensor& folded, Augmentation kind, RngStream* rng) {
  if (kind == Augmentation::kNone) return folded;
  torch::Tensor grid = Unfold(folded);  // [N, 1, r, r, r]
  if (kind != Augmentation::kFlips) {
    const std::int64_t n = grid.size(2), most = kLargestShift;
    grid = torch::replication_pad3d(grid, std::vector<std::int64_t>(6, most));
    for (std::int64_t axis = 2; axis < 5; ++axis) {
      const auto first = static_cast<std::int64_t>(rng->Below(2 * most + 1));
      grid = grid.slice(axis, first, first + n);
    }
  }
  if (kind != Augmentation::kShifts) {
    std::vector<std::int64_t> mirrored;
    for (std::int64_t axis = 2; axis < 5; ++axis) {
      if (rng->Below(2) == 1) mirrored.push_back(axis);
    }
    if (!mirrored.empty()) grid = grid.flip(mirrored);
  }
  return Fold(grid.contiguous());
}

}  // namespace antigrasp
