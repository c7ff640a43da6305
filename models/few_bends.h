#pragma once

#include <ATen/core/Tensor.h>

namespace antigrasp {

struct FewBends {
  double weight = 0.5;  // of the bends, against staying where it is
  double power = 0.3;   // of a bend: 1 rounds creases off, small ones make few
  int rounds = 25;
  int iterations = 12;  // of conjugate gradients in a round
};

// Signed distances in cells, [N, 1, r, r, r] float on the CPU, with few bends in place of many
// small ones: flat faces that meet in creases. Over the nodes x within 2 cells of the surface
//
//   minimise  sum w (x - x0)^2 + weight * sum (|H|^2 + eps^2)^(power / 2),  w = exp(-(x0 / 1.5)^2)
//   + .02
//
// H: second differences at a node, mixed ones those of the cells around it; eps falls from .1 to
// .005. By reweighted least squares, conjugate gradients within. Fairing makes shapes tidy, not
// true (docs/training.md, "Few bends"). Not differentiable; every shape by itself; same bytes for
// any number of threads. 20 to 40 ms a shape of 32^3.
at::Tensor WithFewBends(const at::Tensor& distances, const FewBends& options);

}  // namespace antigrasp
