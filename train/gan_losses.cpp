#include "antigrasp/train/gan_losses.h"

#include <torch/autograd.h>

namespace antigrasp {
namespace {

constexpr double kLeastGradient = 1e-12;

}  // namespace

torch::Tensor DiscriminatorLoss(GanLoss loss, const torch::Tensor& real,
                                const torch::Tensor& generated) {
  if (loss == GanLoss::kRelativistic) return torch::softplus(generated - real).mean();
  return torch::relu(1.0 - real).mean() + torch::relu(1.0 + generated).mean();
}

torch::Tensor GeneratorLoss(GanLoss loss, const torch::Tensor& real,
                            const torch::Tensor& generated) {
  if (loss == GanLoss::kRelativistic) return torch::softplus(real - generated).mean();
  return -generated.mean();
}

Uphill StepUphill(const torch::Tensor& shapes, const torch::Tensor& scores, double move) {
  const torch::Tensor gradient =
      torch::autograd::grad({scores.sum()}, {shapes}, {}, /*retain_graph=*/true)[0];
  const torch::Tensor largest = gradient.flatten(1).norm(2, 1).max().clamp_min(kLeastGradient);
  const torch::Tensor step = move / largest;
  return {shapes.detach() + step * gradient, step};
}

torch::Tensor GradientPenalty(double gamma, const torch::Tensor& scores,
                              const torch::Tensor& scores_uphill, const torch::Tensor& step) {
  // Sum of |g|^2 in value; its gradient by the weights is half of that sum's.
  const torch::Tensor slope = (scores_uphill.sum() - scores.sum()) / step;
  const double share = gamma / static_cast<double>(scores.size(0));
  return share * (slope - 0.5 * slope.detach());
}

}  // namespace antigrasp
