#pragma once

#include <ATen/core/Tensor.h>

#include <cstdint>

namespace antigrasp {

// Distances to solids of revolution about the cube's z axis, positive inside: outlines [N, P, 2] ->
// [N, 1, r, r, r] at the nodes of a cube of side 1 whose centre is the origin, cells' middles, x
// fastest. An outline is half of the section: points (radius >= 0, z) from the axis at the bottom
// round the outside to the axis at the top, with straight pieces between them. Exact inside and
// outside, as the distances to bottles of the prior set are; where an outline crosses itself,
// inside is what a ray crosses an odd number of times to leave. Differentiable once in the points.
// Float on the CPU goes in one pass over the r / 2 (r / 2 + 1) / 2 different radii, with the same
// bits for any number of threads and any CPU; all else through the operations of LibTorch, which
// take P times the memory. 2 <= P <= 4096, r a multiple of 16.
at::Tensor TurnedField(const at::Tensor& outlines, std::int64_t resolution);

// The same by the operations of LibTorch, in any type, on any device.
at::Tensor TurnedFieldByOperations(const at::Tensor& outlines, std::int64_t resolution);

}  // namespace antigrasp
