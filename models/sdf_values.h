#pragma once

#include <ATen/core/Tensor.h>

#include "antigrasp/models/model_options.h"

namespace antigrasp {

// The networks work on values in [-1, 1]; grids hold distances in units of the cube's side. Both
// are positive inside. A distance d becomes s(d / tau) with truncation tau > 0, s(raw_scale * d)
// without; s cuts off at +-1: a clamp or tanh (model.squash). Float tensor of any shape in and out.
at::Tensor NetworkValues(const at::Tensor& distances, const ModelOptions& options);

// The inverse, within +-LargestDistance; the zero level never moves.
at::Tensor Distances(const at::Tensor& network_values, const ModelOptions& options);

// No distance inside larger than model.depth, unless that is 0: network values in and out.
at::Tensor UpToDepth(const at::Tensor& network_values, const ModelOptions& options);

// Of what Distances returns: the truncation, or 5 times that with tanh.
double LargestDistance(const ModelOptions& options);

}  // namespace antigrasp
