#pragma once

#include <torch/types.h>

#include <cstdint>

namespace antigrasp {

// Features of packs of shapes, [pack N, C, ...] -> [pack N, 2 C, ...]: every shape's, then their
// deviation over its pack (Karras et al., ICLR 2018, a channel each).
torch::Tensor WithPackDeviation(const torch::Tensor& features, std::int64_t pack);

}  // namespace antigrasp
