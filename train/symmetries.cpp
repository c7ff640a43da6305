#include "antigrasp/train/symmetries.h"

#include "antigrasp/core/check.h"

namespace antigrasp {

torch::Tensor RandomSymmetries(const torch::Tensor& batch, Symmetries symmetries, RngStream* rng) {
  if (symmetries == Symmetries::kNone) return batch;
  AG_CHECK(batch.dim() == 5, "grids [N, 1, z, y, x]");
  const bool upside_down = symmetries == Symmetries::kAroundZAndUp;
  std::vector<torch::Tensor> shown;
  for (std::int64_t i = 0; i < batch.size(0); ++i) {
    torch::Tensor grid = batch[i];  // [1, z, y, x]
    const std::uint64_t choice = rng->Below(upside_down ? 16 : 8);
    if ((choice & 1) != 0) grid = grid.transpose(2, 3);
    std::vector<std::int64_t> mirrored;
    for (std::int64_t axis = 3; axis >= 1; --axis) {
      if ((choice >> (4 - axis) & 1) != 0) mirrored.push_back(axis);
    }
    shown.push_back(mirrored.empty() ? grid : grid.flip(mirrored));
  }
  return torch::stack(shown);
}

}  // namespace antigrasp
