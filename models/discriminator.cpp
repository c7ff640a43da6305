#include "antigrasp/models/discriminator.h"

#include "antigrasp/models/folding.h"
#include "antigrasp/models/libtorch.h"
#include "antigrasp/models/pack_deviation.h"
#include "antigrasp/models/sdf_values.h"

namespace antigrasp {
namespace {

constexpr double kWeightSd = 0.02;
constexpr double kLeak = 0.2;

torch::Tensor LeakyRelu(torch::Tensor x) { return torch::leaky_relu_(x, kLeak); }

}  // namespace

DiscriminatorImpl::DiscriminatorImpl(const ModelOptions& options) : options_(options) {
  const std::int64_t c = options_.width_d > 0 ? options_.width_d : options_.width;
  const std::int64_t inputs = PacksFeatures() ? 1 : options.pack;
  const std::int64_t sets = PacksFeatures() ? 2 : 1;
  const int levels = HiddenLevels(options_);
  std::vector<std::vector<std::int64_t>> shapes = {{c, inputs, 4, 4, 4}};
  for (int i = 1; i < levels; ++i) shapes.push_back({c << i, c << (i - 1), 4, 4, 4});
  shapes.push_back({c << levels, sets * (c << (levels - 1)), 4, 4, 4});
  shapes.push_back({1, (c << levels) * 8});
  for (const std::vector<std::int64_t>& shape : shapes) {
    const std::string name = std::to_string(weights_.size() + 1);
    weights_.push_back(
        register_module("layer" + name, SpectralWeight(shape, options_.spectral_norm)));
    biases_.push_back(register_parameter("bias" + name, torch::zeros({shape[0]})));
  }
  for (int i = 0; options_.block == Block::kResidual && i < levels; ++i) {
    const std::int64_t channels = c << i;
    refine_.push_back(
        register_module("refine" + std::to_string(i + 1),
                        SpectralWeight(std::vector<std::int64_t>{channels, channels, 3, 3, 3},
                                       options_.spectral_norm)));
  }
  RngStream rng(0, "discriminator");
  Initialize(&rng);
}

void DiscriminatorImpl::Initialize(RngStream* rng) {
  torch::NoGradGuard no_grad;
  for (SpectralWeight& weight : weights_) {
    weight->Initialize(kWeightSd, rng);
  }
  for (SpectralWeight& weight : refine_) {
    weight->Initialize(kWeightSd, rng);
  }
  for (torch::Tensor& bias : biases_) {
    bias.zero_();
  }
}

torch::Tensor DiscriminatorImpl::Refine(std::size_t level, const torch::Tensor& x) {
  if (refine_.empty()) return LeakyRelu(x);
  const torch::Tensor y = torch::conv3d(torch::leaky_relu(x, kLeak), refine_[level](), {}, 1, 1);
  return LeakyRelu(x + y);
}

double DiscriminatorImpl::LargestSigma() {
  if (!options_.spectral_norm) return ShapeDiscriminator::LargestSigma();
  torch::NoGradGuard no_grad;
  std::vector<torch::Tensor> sigmas;
  for (auto* weights : {&weights_, &refine_}) {
    for (SpectralWeight& weight : *weights) sigmas.push_back(weight->Sigma());
  }
  return torch::stack(sigmas).max().item<double>();  // one wait for the device
}

void DiscriminatorImpl::IterateSigma() {
  for (auto* weights : {&weights_, &refine_}) {
    for (SpectralWeight& weight : *weights) weight->Iterate();
  }
}

torch::Tensor DiscriminatorImpl::forward(const torch::Tensor& sdf) { return Score(Judged(sdf)); }

torch::Tensor DiscriminatorImpl::Judged(const torch::Tensor& sdf) { return Fold(sdf); }

torch::Tensor DiscriminatorImpl::Score(const torch::Tensor& judged) {
  const at::ScalarType compute = ConvolutionType(options_);
  const torch::Tensor folded = EmphasizeEdges(UpToDepth(judged, options_), options_.edge_gain);
  const std::int64_t inputs = PacksFeatures() ? 1 : options_.pack;
  const std::int64_t h = folded.size(2);
  const auto packed = folded.view({-1, inputs, 8, h, h, h})
                          .permute({0, 3, 4, 5, 2, 1})
                          .reshape({-1, h, h, h, 8 * inputs})
                          .permute({0, 4, 1, 2, 3});  // a phase of all shapes, then the next
  const auto levels = static_cast<std::size_t>(HiddenLevels(options_));
  const auto down = [&](std::size_t i, const torch::Tensor& cells) {
    return DownConv(cells, weights_[i](), biases_[i], compute);
  };
  torch::Tensor x = down(0, packed);           // [N, c, r / 2, r / 2, r / 2], not yet cut
  for (std::size_t i = 1; i <= levels; ++i) {  // to 2^3
    const bool deviates = PacksFeatures() && i == levels;
    if (refine_.empty() && !deviates) {
      x = DownConvLeaky(x, kLeak, weights_[i](), biases_[i], compute);
      continue;
    }
    x = Refine(i - 1, x);
    x = down(i, Fold(deviates ? WithPackDeviation(x, options_.pack) : x));  // of twice the channels
  }
  x = LeakyRelu(x);
  return torch::linear(x.flatten(1), weights_[levels + 1](), biases_[levels + 1]).squeeze(1);
}

}  // namespace antigrasp
