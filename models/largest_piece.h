#pragma once

#include <ATen/core/Tensor.h>

namespace antigrasp {

// Values [N, 1, r, r, r], positive inside, in which the largest piece of each shape alone is left:
// nodes inside that reach it along no chain of neighbours inside (six a node) change their sign.
// The sharp corner of a turned box often has one such node, less than a grid can say. Ties go to
// the piece of the first node, x fastest. On the CPU, float; not differentiable. Linear in the
// nodes.
at::Tensor LargestPiece(const at::Tensor& values);

}  // namespace antigrasp
