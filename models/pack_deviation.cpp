#include "antigrasp/models/pack_deviation.h"

namespace antigrasp {

torch::Tensor WithPackDeviation(const torch::Tensor& features, std::int64_t pack) {
  std::vector<std::int64_t> sizes = features.sizes().vec();
  sizes.insert(sizes.begin() + 1, pack);
  sizes.front() = -1;
  const torch::Tensor packs = features.view(sizes);
  const torch::Tensor deviation =
      ((packs - packs.mean(1, true)).square().mean(1, true) + 1e-8).sqrt();
  return torch::cat({features, deviation.expand_as(packs).reshape(features.sizes())}, 1);
}

}  // namespace antigrasp
