#include "antigrasp/models/discriminator.h"

#include <limits>

#include "antigrasp/models/folding.h"

namespace antigrasp {
namespace {

constexpr double kWeightSd = 0.02;
constexpr double kLeak = 0.2;

torch::Tensor LeakyRelu(torch::Tensor x) { return torch::leaky_relu_(x, kLeak); }

}  // namespace

DiscriminatorImpl::DiscriminatorImpl(const ModelOptions& options) : options_(options) {
  const std::int64_t c = options_.width;
  const std::vector<std::vector<std::int64_t>> shapes = {{c, options.pack, 4, 4, 4},
                                                         {2 * c, c, 4, 4, 4},
                                                         {4 * c, 2 * c, 4, 4, 4},
                                                         {8 * c, 4 * c, 4, 4, 4},
                                                         {1, 8 * c * 8}};
  for (const std::vector<std::int64_t>& shape : shapes) {
    const std::string name = std::to_string(weights_.size() + 1);
    weights_.push_back(
        register_module("layer" + name, SpectralWeight(shape, options_.spectral_norm)));
    biases_.push_back(register_parameter("bias" + name, torch::zeros({shape[0]})));
  }
  RngStream rng(0, "discriminator");
  Initialize(&rng);
}

void DiscriminatorImpl::Initialize(RngStream* rng) {
  torch::NoGradGuard no_grad;
  for (SpectralWeight& weight : weights_) {
    weight->Initialize(kWeightSd, rng);
  }
  for (torch::Tensor& bias : biases_) {
    bias.zero_();
  }
}

double DiscriminatorImpl::LargestSigma() {
  if (!options_.spectral_norm) return std::numeric_limits<double>::quiet_NaN();
  torch::NoGradGuard no_grad;
  std::vector<torch::Tensor> sigmas;
  for (SpectralWeight& weight : weights_) sigmas.push_back(weight->Sigma());
  return torch::stack(sigmas).max().item<double>();  // one wait for the device
}

torch::Tensor DiscriminatorImpl::forward(const torch::Tensor& sdf) {
  return ForwardFolded(Fold(sdf));  // [N, 8, 17, 17, 17]
}

torch::Tensor DiscriminatorImpl::ForwardFolded(const torch::Tensor& folded) {
  const auto packed = folded.reshape({-1, 8 * options_.pack, 17, 17, 17});
  torch::Tensor x = LeakyRelu(DownConv(packed, weights_[0](), biases_[0]));  // [N, c, 16, 16, 16]
  x = LeakyRelu(DownConv(Fold(x), weights_[1](), biases_[1]));               // [N, 2c, 8, 8, 8]
  x = LeakyRelu(DownConv(Fold(x), weights_[2](), biases_[2]));               // [N, 4c, 4, 4, 4]
  x = LeakyRelu(DownConv(Fold(x), weights_[3](), biases_[3]));               // [N, 8c, 2, 2, 2]
  return torch::linear(x.flatten(1), weights_[4](), biases_[4]).squeeze(1);  // [N]
}

}  // namespace antigrasp
