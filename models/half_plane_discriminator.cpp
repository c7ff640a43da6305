#include "antigrasp/models/half_plane_discriminator.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "antigrasp/models/folding.h"
#include "antigrasp/models/libtorch.h"
#include "antigrasp/models/pack_deviation.h"
#include "antigrasp/models/random_tensor.h"
#include "antigrasp/models/sdf_values.h"

namespace antigrasp {
namespace {

constexpr double kLeak = 0.2;
constexpr std::int64_t kChannelsPerWidth = 3, kWidest = 4;  // of what the first layer has
constexpr std::int64_t kUnitsPerWidth = 16;                 // of the hidden linear layer
constexpr double kLaplacianGain = 3.0;  // on surfaces about as large as values are
constexpr double kGain = 0.577;         // deviation of fresh weights, by 1 / sqrt(inputs)

torch::Tensor LeakyRelu(const torch::Tensor& x) { return torch::leaky_relu(x, kLeak); }

// [N, 1, r, r / 2] -> [N, 2, r, r / 2]: beside it its Laplacian, nodes beyond it being equal to the
// outermost; across the axis they are.
torch::Tensor WithLaplacian(const torch::Tensor& x) {
  const torch::Tensor ring = torch::replication_pad2d(x, {1, 1, 1, 1});
  const std::int64_t rows = x.size(2), columns = x.size(3);
  const auto moved = [&](std::int64_t down, std::int64_t right) {
    return ring.narrow(2, down, rows).narrow(3, right, columns);
  };
  const torch::Tensor around = moved(0, 1) + moved(2, 1) + moved(1, 0) + moved(1, 2);
  return torch::cat({x, kLaplacianGain * (around - 4.0 * x)}, 1);
}

}  // namespace

HalfPlaneDiscriminatorImpl::HalfPlaneDiscriminatorImpl(const ModelOptions& options)
    : options_(options) {
  const std::int64_t width = options.width_d > 0 ? options.width_d : options.width;
  const std::int64_t c = kChannelsPerWidth * width;
  std::vector<std::vector<std::int64_t>> shapes = {{c, 2, 3, 3}};
  for (int i = 0; i < HiddenLevels(options); ++i) {
    const std::int64_t inputs = shapes.back()[0];
    shapes.push_back({std::min(2 * inputs, kWidest * c), inputs, 4, 4});
  }
  const std::int64_t sets = options.pack > 1 ? 2 : 1;
  shapes.push_back({kUnitsPerWidth * width, 8 * sets * shapes.back()[0]});
  shapes.push_back({1, kUnitsPerWidth * width});
  for (const std::vector<std::int64_t>& shape : shapes) {
    const std::string name = std::to_string(weights_.size() + 1);
    weights_.push_back(register_parameter("weight" + name, torch::zeros(shape)));
    biases_.push_back(register_parameter("bias" + name, torch::zeros({shape[0]})));
  }
  RngStream rng(0, "discriminator");
  Initialize(&rng);
}

void HalfPlaneDiscriminatorImpl::Initialize(RngStream* rng) {
  torch::NoGradGuard no_grad;
  for (torch::Tensor& weight : weights_) {
    const auto inputs = static_cast<double>(weight[0].numel());
    weight.copy_(NormalTensor(weight.sizes(), kGain / std::sqrt(inputs), rng));
  }
  for (torch::Tensor& bias : biases_) bias.zero_();
}

torch::Tensor HalfPlaneDiscriminatorImpl::forward(const torch::Tensor& sdf) {
  const std::int64_t half = sdf.size(4) / 2;
  torch::Tensor x = UpToDepth(sdf.select(3, half - 1).narrow(3, half, half), options_);
  x = WithLaplacian(x);
  const std::size_t convolutions = weights_.size() - 2;
  for (std::size_t i = 0; i < convolutions; ++i) {
    x = LeakyRelu(torch::conv2d(x, weights_[i], biases_[i], i == 0 ? 1 : 2, 1));
  }
  if (options_.pack > 1) x = WithPackDeviation(x, options_.pack);
  x = LeakyRelu(torch::linear(x.flatten(1), weights_[convolutions], biases_[convolutions]));
  return torch::linear(x, weights_[convolutions + 1], biases_[convolutions + 1]).squeeze(1);
}

torch::Tensor HalfPlaneDiscriminatorImpl::ForwardFolded(const torch::Tensor& grids) {
  return forward(Unfold(grids));
}

}  // namespace antigrasp
