#pragma once

#include <torch/types.h>

#include "antigrasp/train/gan_options.h"

namespace antigrasp {

// Of scores [n] of real and of generated shapes, scalars. Hinge (section V-A):
// -E[min(0, -1 + D(x))] - E[min(0, -1 - D(G(z)))] and -E[D(G(z))]. Relativistic
// (Jolicoeur-Martineau, ICLR 2019, paired as in R3GAN, Huang et al., NeurIPS 2024): with s the
// softplus, E[s(D(G(z)) - D(x))] and E[s(D(x) - D(G(z)))], each generated shape beside a real one.
torch::Tensor DiscriminatorLoss(GanLoss loss, const torch::Tensor& real,
                                const torch::Tensor& generated);
torch::Tensor GeneratorLoss(GanLoss loss, const torch::Tensor& real,
                            const torch::Tensor& generated);

// Shapes a step up the gradients of their scores, and how long the step is: the largest moves by a
// norm of `move` in network values (ShapeDiscriminator::SmallMove).
struct Uphill {
  torch::Tensor shapes;  // without a graph
  torch::Tensor step;    // scalar; the shapes have moved by it times their gradients
};
// `shapes` has requires_grad, `scores` is of them and keeps its graph.
Uphill StepUphill(const torch::Tensor& shapes, const torch::Tensor& scores, double move);

// gamma / 2 times the mean over shapes of |gradient of the scores by the shape|^2: R1 and R2 in one
// (Mescheder et al., ICML 2018). Its gradient needs no second derivatives: that of |g|^2 / 2 is the
// derivative of the scores' slope along g, which is a difference of scores here and uphill. Exact
// where the network is linear between the two.
torch::Tensor GradientPenalty(double gamma, const torch::Tensor& scores,
                              const torch::Tensor& scores_uphill, const torch::Tensor& step);

}  // namespace antigrasp
