#pragma once

#include <ATen/core/Tensor.h>

#include <cstdint>

namespace antigrasp {

// The outlines of model.form = "turned" (turned_field.h): a stack of frusta, each on the one below,
// whose corners are rounded, on a base that may be hollow. What a lathe makes of one piece: bodies
// with waists, shoulders that swing in and out again, necks, caps.

// How many numbers, of about 1 and any allowed, say what the outline of `frusta` is: for the base
// and for every frustum four, and one more.
constexpr std::int64_t OutlineNumbers(std::int64_t frusta) { return 4 * (frusta + 1) + 1; }

// Numbers [N, OutlineNumbers(frusta)] -> [N, P, 2]. From z = -h / 2 to h / 2, within `room` of the
// origin, nowhere nearer to the axis than one cell of 32^3, the top frustum two of them high. What
// would be higher is scaled down as a whole.
at::Tensor Outlines(const at::Tensor& numbers, std::int64_t frusta, double room);

// Corners [N, K, 2] of an outline between its first and its last, each rounded: `rounding` [N, K -
// 2] in [0, 1] of the shorter piece beside it, `skew` [N, K - 2] how much farther it begins ahead
// of the corner than behind (logarithm of both; 0: alike). -> [N, 2 + 9 (K - 2), 2].
at::Tensor RoundedCorners(const at::Tensor& corners, const at::Tensor& rounding,
                          const at::Tensor& skew);

}  // namespace antigrasp
