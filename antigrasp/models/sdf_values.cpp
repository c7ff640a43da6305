#include "antigrasp/models/sdf_values.h"

#include <ATen/ATen.h>

namespace antigrasp {
namespace {

double ValuePerDistance(const ModelOptions& options) {
  return options.truncation > 0.0 ? 1.0 / options.truncation : options.raw_scale;
}

}  // namespace

at::Tensor NetworkValues(const at::Tensor& distances, const ModelOptions& options) {
  return at::mul(distances, ValuePerDistance(options)).clamp_(-1.0, 1.0);
}

at::Tensor Distances(const at::Tensor& network_values, const ModelOptions& options) {
  return at::div(network_values, ValuePerDistance(options));
}

}  // namespace antigrasp
