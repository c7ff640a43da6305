#include "antigrasp/models/generator.h"

#include <array>
#include <cmath>

#include "antigrasp/core/check.h"
#include "antigrasp/models/elementwise.h"
#include "antigrasp/models/folding.h"
#include "antigrasp/models/libtorch.h"
#include "antigrasp/models/norm_relu.h"
#include "antigrasp/models/random_tensor.h"

namespace antigrasp {
namespace {

constexpr double kKernelNoise = 0.02;  // of the channel mix's deviation
constexpr double kLastLayerSd = 0.3;   // at width 8
constexpr double kRefineScale = 0.1;   // a residual branch begins small
constexpr double kOutsideBias = -0.5;  // tanh(-0.5): every node starts outside
constexpr std::array<float, 4> kLinearTaps = {0.25F, 0.75F, 0.75F, 0.25F};

// [in, out, 4, 4, 4]: each pair of channels linked by trilinear interpolation times a N(0, sd^2)
// factor, plus 2 % noise to break the symmetry.
torch::Tensor TrilinearKernel(at::IntArrayRef shape, double sd, RngStream* rng) {
  const torch::Tensor mix = NormalTensor({shape[0], shape[1], 1, 1, 1}, sd, rng);
  const torch::Tensor taps = torch::tensor(at::ArrayRef<float>(kLinearTaps.data(), 4));
  return mix * taps.view({4, 1, 1}) * taps.view({4, 1}) * taps +
         NormalTensor(shape, kKernelNoise * sd, rng);
}

}  // namespace

GeneratorImpl::GeneratorImpl(const ModelOptions& options) : options_(options) {
  const int levels = HiddenLevels(options_);
  const std::int64_t c = options_.width, deepest = c << levels;
  project_ = register_module(
      "project",
      torch::nn::Linear(torch::nn::LinearOptions(options_.latent, deepest * 8).bias(false)));
  for (int i = 0; i < levels; ++i) {  // at 32^3: 8c -> 4c -> 2c -> c
    up_weights_.push_back(
        register_parameter("up" + std::to_string(i + 1) + "_weight",
                           torch::zeros({deepest >> i, deepest >> (i + 1), 4, 4, 4})));
  }
  for (int i = 0; i <= levels; ++i) {
    if (options_.batch_norm) {
      norms_.push_back(
          register_module("norm" + std::to_string(i), torch::nn::BatchNorm3d(deepest >> i)));
    } else {
      biases_.push_back(
          register_parameter("bias" + std::to_string(i), torch::zeros({deepest >> i, 1, 1, 1})));
    }
  }
  for (int i = 0; options_.block != Block::kPlain && i < levels; ++i) {
    const std::int64_t channels = deepest >> (i + 1);
    refine_weights_.push_back(register_parameter("refine" + std::to_string(i + 1) + "_weight",
                                                 torch::zeros({channels, channels, 3, 3, 3})));
    refine_norms_.push_back(register_module("refine" + std::to_string(i + 1) + "_norm",
                                            torch::nn::BatchNorm3d(channels)));
  }
  last_weight_ = register_parameter("last_weight", torch::zeros({c, 1, 4, 4, 4}));
  last_bias_ = register_parameter("last_bias", torch::zeros({1}));
  RngStream rng(0, "generator");
  Initialize(&rng);
}

void GeneratorImpl::Initialize(RngStream* rng) {
  torch::NoGradGuard no_grad;
  project_->weight.copy_(
      NormalTensor(project_->weight.sizes(), 1.0 / std::sqrt(options_.latent), rng));
  for (torch::Tensor& weight : up_weights_) {
    const double sd = std::sqrt(2.0 / static_cast<double>(weight.size(0)));
    weight.copy_(TrilinearKernel(weight.sizes(), sd, rng));
  }
  for (torch::Tensor& weight : refine_weights_) {
    weight.copy_(
        NormalTensor(weight.sizes(), std::sqrt(2.0 / (27.0 * double(weight.size(1)))), rng));
  }
  for (auto* norms : {&norms_, &refine_norms_}) {
    for (torch::nn::BatchNorm3d& norm : *norms) {
      norm->reset_parameters();  // scale 1, shift 0, statistics restarted
    }
  }
  for (torch::nn::BatchNorm3d& norm : refine_norms_) {
    norm->weight.fill_(kRefineScale);
  }
  for (torch::Tensor& bias : biases_) {
    bias.zero_();
  }
  last_weight_.copy_(
      TrilinearKernel(last_weight_.sizes(), kLastLayerSd * std::sqrt(8.0 / options_.width), rng));
  last_bias_.fill_(kOutsideBias);
}

void GeneratorImpl::RestartStatistics() {
  for (auto* norms : {&norms_, &refine_norms_}) {
    for (torch::nn::BatchNorm3d& norm : *norms) {
      norm->options.momentum(kCumulativeMomentum);
      norm->reset_running_stats();
    }
  }
}

void GeneratorImpl::TakeFolded(const GeneratorImpl& other) {
  AG_CHECK(other.options_.batch_norm && !options_.batch_norm && options_.block == Block::kPlain &&
               options_.resolution == other.options_.resolution &&
               options_.width == other.options_.width && options_.latent == other.options_.latent,
           "batch norm is folded into networks of equal shape without it");
  torch::NoGradGuard no_grad;
  for (std::size_t i = 0; i < other.norms_.size(); ++i) {
    const torch::nn::BatchNorm3d& norm = other.norms_[i];
    const torch::Tensor scale = norm->weight / (norm->running_var + norm->options.eps()).sqrt();
    biases_[i].copy_((norm->bias - norm->running_mean * scale).view({-1, 1, 1, 1}));
    if (i == 0) {  // rows of the linear layer: 2^3 nodes of a channel, then the next channel's
      project_->weight.copy_(other.project_->weight * scale.repeat_interleave(8).view({-1, 1}));
    } else {
      up_weights_[i - 1].copy_(other.up_weights_[i - 1] * scale.view({-1, 1, 1, 1}));
    }
  }
  last_weight_.copy_(other.last_weight_);
  last_bias_.copy_(other.last_bias_);
}

torch::Tensor GeneratorImpl::Activate(std::size_t layer, const torch::Tensor& x) {
  return options_.batch_norm ? NormRelu(norms_[layer], x) : (x + biases_[layer]).relu_();
}

// x: activated. Adds a convolution of itself, normalised and activated.
torch::Tensor GeneratorImpl::Refine(std::size_t level, const torch::Tensor& x) {
  if (refine_weights_.empty()) return x;
  const torch::Tensor y = torch::conv3d(x, refine_weights_[level], {}, 1, 1);
  return (x + refine_norms_[level](y)).relu_();
}

torch::Tensor GeneratorImpl::ForwardJudged(const torch::Tensor& z) {
  const at::ScalarType compute = ConvolutionType(options_);
  torch::Tensor x = Activate(0, project_(z).view({-1, up_weights_[0].size(0), 2, 2, 2}));
  for (std::size_t i = 0; i < up_weights_.size(); ++i) {  // to [N, c, r / 2, r / 2, r / 2]
    x = Refine(i, Activate(i + 1, UpConvUnfolded(x, up_weights_[i], compute)));
  }
  x = AddNumber(UpConv(x, last_weight_, compute), last_bias_);  // [N, 8, h, h, h], h = r / 2 + 1
  return Tanh(BlurAndClearRing(x, options_.output_blur));
}

torch::Tensor GeneratorImpl::forward(const torch::Tensor& z) { return Unfold(ForwardJudged(z)); }

}  // namespace antigrasp
