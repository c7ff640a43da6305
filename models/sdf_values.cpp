#include "antigrasp/models/sdf_values.h"

#include <ATen/ATen.h>

#include <cmath>

namespace antigrasp {
namespace {

constexpr double kLargestTanh = 0.9999;  // atanh of it is 5; beyond, rounding decides

double ValuePerDistance(const ModelOptions& options) {
  return options.truncation > 0.0 ? 1.0 / options.truncation : options.raw_scale;
}

}  // namespace

at::Tensor NetworkValues(const at::Tensor& distances, const ModelOptions& options) {
  const at::Tensor values = at::mul(distances, ValuePerDistance(options));
  return options.squash == Squash::kTanh ? at::tanh(values) : at::clamp(values, -1.0, 1.0);
}

at::Tensor Distances(const at::Tensor& network_values, const ModelOptions& options) {
  if (options.squash == Squash::kClamp) return at::div(network_values, ValuePerDistance(options));
  return at::atanh(network_values.clamp(-kLargestTanh, kLargestTanh))
      .div_(ValuePerDistance(options));
}

at::Tensor UpToDepth(const at::Tensor& network_values, const ModelOptions& options) {
  if (options.depth == 0.0) return network_values;
  const at::Tensor deepest = at::full({}, options.depth, at::kDouble);
  return network_values.clamp_max(NetworkValues(deepest, options).item<double>());
}

double LargestDistance(const ModelOptions& options) {
  return (options.squash == Squash::kTanh ? std::atanh(kLargestTanh) : 1.0) /
         ValuePerDistance(options);
}

}  // namespace antigrasp
