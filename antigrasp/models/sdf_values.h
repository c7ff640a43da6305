#pragma once

#include <ATen/core/Tensor.h>

#include "antigrasp/models/model_options.h"

namespace antigrasp {

// The networks work on values in [-1, 1]; grids hold distances in units of the cube's side. Both
// are positive inside. With truncation tau > 0 a distance d becomes clamp(d / tau, -1, 1), else
// clamp(raw_scale * d, -1, 1). Float tensor of any shape in and out.
at::Tensor NetworkValues(const at::Tensor& distances, const ModelOptions& options);

// The inverse where nothing was clamped; the zero level never moves.
at::Tensor Distances(const at::Tensor& network_values, const ModelOptions& options);

}  // namespace antigrasp
