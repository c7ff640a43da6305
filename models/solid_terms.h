#pragma once

#include <ATen/ATen.h>

#include <cstdint>

namespace antigrasp {

// What unions of parts and turned solids are both drawn with.

// Along a side of the cube, whose centre is the origin: the middles of r cells, [r].
inline at::Tensor NodeCoordinates(std::int64_t r, const at::TensorOptions& options) {
  return (at::arange(r, options) + 0.5) / static_cast<double>(r) - 0.5;
}

// In [0, 1], both ends included.
inline at::Tensor Share(const at::Tensor& x) {
  return (1.2 * at::sigmoid(1.5 * x) - 0.1).clamp(0.0, 1.0);
}

}  // namespace antigrasp
