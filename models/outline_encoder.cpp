#include "antigrasp/models/outline_encoder.h"

#include <string>

#include "antigrasp/models/random_tensor.h"
#include "antigrasp/models/turned_outline.h"

namespace antigrasp {
namespace {

constexpr std::int64_t kChannels = 12, kUnits = 256, kBlock = 250;  // shapes at a time
constexpr std::size_t kConvolutions = 2;
constexpr double kEncoderLeak = 0.2, kInputGain = 2.0;
constexpr double kLeastDeviation = 1e-3;

}  // namespace

OutlineEncoderImpl::OutlineEncoderImpl(const ModelOptions& options) {
  const std::int64_t numbers = OutlineNumbers(options.parts), r = options.resolution;
  const std::vector<std::vector<std::int64_t>> shapes = {
      {kChannels, 1, 4, 4},
      {2 * kChannels, kChannels, 4, 4},
      {kUnits, 2 * kChannels * (r / 4) * (r / 8)},
      {kUnits, kUnits},
      {numbers, kUnits}};
  for (const std::vector<std::int64_t>& shape : shapes) {
    const std::string name = std::to_string(weights_.size() + 1);
    weights_.push_back(register_parameter("weight" + name, torch::zeros(shape)));
    biases_.push_back(register_parameter("bias" + name, torch::zeros({shape[0]})));
  }
  fitted_ = register_buffer("fitted", torch::zeros({1}));
  mean_ = register_buffer("mean", torch::zeros({numbers}));
  deviation_ = register_buffer("deviation", torch::ones({numbers}));
}

void OutlineEncoderImpl::Initialize(RngStream* rng) {
  torch::NoGradGuard no_grad;
  FreshLayers(&weights_, &biases_, rng);
  fitted_.zero_();
  mean_.zero_();
  deviation_.fill_(1.0);
}

torch::Tensor OutlineEncoderImpl::forward(const torch::Tensor& sdf) {
  const std::int64_t half = sdf.size(4) / 2;
  torch::Tensor x = kInputGain * sdf.select(3, half - 1).narrow(3, half, half);
  for (std::size_t i = 0; i < weights_.size(); ++i) {
    if (i > 0) x = torch::leaky_relu(x, kEncoderLeak);
    x = i < kConvolutions ? torch::conv2d(x, weights_[i], biases_[i], 2, 1)
                          : torch::linear(x.flatten(1), weights_[i], biases_[i]);
  }
  return x;
}

torch::Tensor OutlineEncoderImpl::Standardised(const torch::Tensor& sdf) {
  return (forward(sdf) - mean_) / deviation_;
}

void OutlineEncoderImpl::FittedTo(const torch::Tensor& set) {
  torch::NoGradGuard no_grad;
  std::vector<torch::Tensor> rows;
  for (const torch::Tensor& block : set.split(kBlock)) {
    rows.push_back(forward(block.to(mean_.device(), torch::kFloat)));
  }
  const torch::Tensor numbers = torch::cat(rows);
  mean_.copy_(numbers.mean(0));
  deviation_.copy_((numbers - mean_).square().mean(0).sqrt().clamp_min(kLeastDeviation));
  fitted_.fill_(1.0);
}

bool OutlineEncoderImpl::IsFitted() const { return fitted_.item<float>() > 0.0F; }

}  // namespace antigrasp
