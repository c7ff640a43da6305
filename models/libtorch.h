#pragma once

#include <torch/nn/options/batchnorm.h>
#include <torch/types.h>

#include <type_traits>
#include <utility>

#include "antigrasp/models/model_options.h"

// The one place that knows that LibTorch 1.13 (c10::optional) and 2.x (std::optional) differ: an
// argument left out, in whichever type this LibTorch takes.
namespace antigrasp {

inline const at::OptionalIntArrayRef kNoBiasSizes;
inline const std::decay_t<decltype(std::declval<const torch::nn::BatchNormOptions&>().momentum())>
    kCumulativeMomentum;

// model.precision.
inline at::ScalarType ConvolutionType(const ModelOptions& options) {
  return options.precision == Precision::kBfloat16 ? at::kBFloat16 : at::kFloat;
}

}  // namespace antigrasp
