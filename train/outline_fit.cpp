#include "antigrasp/train/outline_fit.h"

#include <torch/autograd.h>

#include <algorithm>

#include "antigrasp/models/folding.h"
#include "antigrasp/models/sdf_values.h"

namespace antigrasp {
namespace {

constexpr double kRate = 1e-3, kFalls = 0.6;  // over the last of the fit
constexpr double kBeta1 = 0.9, kBeta2 = 0.99;

}  // namespace

OutlineFit::OutlineFit(const ModelOptions& model, const OutlineEncoder& encoder)
    : model_(model), encoder_(encoder), adam_(encoder->parameters(), kBeta1, kBeta2) {}

LossAndGradients OutlineFit::Gradients(const torch::Tensor& batch, SolidGeneratorImpl* generator) {
  const torch::AutoGradMode gradients(true);
  const auto seen = [&](const torch::Tensor& sdf) {  // as discriminators of grids see them
    return EmphasizeEdges(Fold(UpToDepth(sdf, model_)), model_.edge_gain);
  };
  const torch::Tensor drawn = generator->OfNumbers(encoder_->forward(batch));
  const torch::Tensor difference = seen(drawn) - seen(batch);
  const auto shapes = static_cast<double>(batch.size(0));
  // A half plane's nodes stand for 2 r of the grid's each.
  const torch::Tensor loss = difference.square().sum() / (2.0 * model_.resolution * shapes);
  return {loss, torch::autograd::grad({loss}, adam_.parameters())};
}

double OutlineFit::Take(const std::vector<torch::Tensor>& gradients, double left) {
  const double rate = kRate * std::min(1.0, left / kFalls);
  adam_.Step(gradients, rate);
  return rate;
}

}  // namespace antigrasp
