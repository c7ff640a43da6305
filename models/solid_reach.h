#pragma once

#include <ATen/core/Tensor.h>

namespace antigrasp {

// How far parts (solid_field.h) reach from their centres along the cube's axes, [N, M, 3] each.
struct SolidReach {
  at::Tensor up, down;  // towards larger coordinates, towards smaller ones
};

// What of a part says its form: axes [N, M, 3, 3], half [N, M, 3], round, fillet [N, M, 1], slope
// [N, M, 2], as the columns of solid_field.h.
struct SolidForm {
  at::Tensor axes, half, round, slope, fillet;
};

// Exact with upright walls; with leaning ones exact but for what a fillet rounds off.
SolidReach ReachOf(const SolidForm& form);

}  // namespace antigrasp
