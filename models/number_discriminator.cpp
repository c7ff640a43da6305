#include "antigrasp/models/number_discriminator.h"

#include <string>

#include "antigrasp/models/pack_deviation.h"
#include "antigrasp/models/random_tensor.h"
#include "antigrasp/models/turned_outline.h"

namespace antigrasp {
namespace {

constexpr std::int64_t kUnitsOfWidth = 32;
constexpr std::size_t kPacksMeet = 2;  // layers
constexpr double kNumberLeak = 0.2;

}  // namespace

NumberDiscriminatorImpl::NumberDiscriminatorImpl(const ModelOptions& options)
    : options_(options), encoder_(register_module("encoder", OutlineEncoder(options))) {
  const std::int64_t units =
      kUnitsOfWidth * (options.width_d > 0 ? options.width_d : options.width);
  const std::int64_t sets = options.pack > 1 ? 2 : 1;
  const std::vector<std::vector<std::int64_t>> shapes = {
      {units, OutlineNumbers(options.parts)}, {units, units}, {units, sets * units}, {1, units}};
  for (const std::vector<std::int64_t>& shape : shapes) {
    const std::string name = std::to_string(weights_.size() + 1);
    weights_.push_back(register_parameter("weight" + name, torch::zeros(shape)));
    biases_.push_back(register_parameter("bias" + name, torch::zeros({shape[0]})));
    trained_.insert(trained_.end(), {weights_.back(), biases_.back()});
  }
  RngStream rng(0, "discriminator");
  Initialize(&rng);
}

void NumberDiscriminatorImpl::Initialize(RngStream* rng) {
  torch::NoGradGuard no_grad;
  FreshLayers(&weights_, &biases_, rng);
  encoder_->Initialize(rng);
}

torch::Tensor NumberDiscriminatorImpl::Judged(const torch::Tensor& sdf) {
  torch::NoGradGuard no_grad;
  return encoder_->Standardised(sdf);
}

torch::Tensor NumberDiscriminatorImpl::Score(const torch::Tensor& judged) {
  torch::Tensor x = judged;
  for (std::size_t i = 0; i < weights_.size(); ++i) {
    if (i > 0) x = torch::leaky_relu(x, kNumberLeak);
    if (i == kPacksMeet && options_.pack > 1) x = WithPackDeviation(x, options_.pack);
    x = torch::linear(x, weights_[i], biases_[i]);
  }
  return x.squeeze(1);
}

}  // namespace antigrasp
