#include "bench/plain_gan.h"

namespace antigrasp::bench {
namespace {

namespace nn = torch::nn;

constexpr std::size_t kUps = 4, kConvolutions = 4;
constexpr double kDecay = 0.999;

torch::optim::AdamOptions AdamSettings() {
  return torch::optim::AdamOptions(4e-4).betas({0.0, 0.9});
}

torch::Tensor UnitVector(const torch::Tensor& v) { return v / v.norm().clamp_min(1e-12); }

}  // namespace

PlainGeneratorImpl::PlainGeneratorImpl(const ModelOptions& options) : width_(options.width) {
  const std::int64_t c = width_;
  project_ = register_module("project",
                             nn::Linear(nn::LinearOptions(options.latent, 8 * c * 8).bias(false)));
  for (std::size_t i = 0; i < kUps; ++i) {
    const bool last = i + 1 == kUps;
    const std::string name = std::to_string(i);
    norms_.push_back(register_module("norm" + name, nn::BatchNorm3d(8 * c >> i)));
    // The last layer keeps the ring around its grid: the blur takes it away.
    ups_.push_back(register_module(
        "up" + name,
        nn::ConvTranspose3d(nn::ConvTranspose3dOptions(8 * c >> i, last ? 1 : 4 * c >> i, 4)
                                .stride(2)
                                .padding(last ? 0 : 1)
                                .bias(last))));
  }
  const torch::Tensor taps = torch::tensor({0.25F, 0.5F, 0.25F});
  blur_ = (taps.view({3, 1, 1}) * taps.view({3, 1}) * taps).view({1, 1, 3, 3, 3});
}

torch::Tensor PlainGeneratorImpl::forward(const torch::Tensor& z) {
  torch::Tensor x = project_(z).view({-1, 8 * width_, 2, 2, 2});
  for (std::size_t i = 0; i < kUps; ++i) x = ups_[i](torch::relu(norms_[i](x)));
  return torch::tanh(torch::conv3d(x, blur_));
}

void PlainGeneratorImpl::CopyFrom(const Generator& generator) {
  torch::NoGradGuard no_grad;
  const auto ours = generator->named_parameters();
  project_->weight.copy_(ours["project.weight"]);
  for (std::size_t i = 0; i < kUps; ++i) {
    const bool last = i + 1 == kUps;
    const std::string norm = "norm" + std::to_string(i);
    norms_[i]->weight.copy_(ours[norm + ".weight"]);
    norms_[i]->bias.copy_(ours[norm + ".bias"]);
    ups_[i]->weight.copy_(ours[last ? "last_weight" : "up" + std::to_string(i + 1) + "_weight"]);
    if (last) ups_[i]->bias.copy_(ours["last_bias"]);
  }
}

PlainDiscriminatorImpl::PlainDiscriminatorImpl(const ModelOptions& options) : pack_(options.pack) {
  const std::int64_t c = options.width;
  for (std::size_t i = 0; i <= kConvolutions; ++i) {
    const bool head = i == kConvolutions;
    const std::int64_t in = i == 0 ? pack_ : c << (i - 1);
    const torch::Tensor weight =
        head ? torch::randn({1, 8 * c * 8}) : torch::randn({c << i, in, 4, 4, 4});
    const std::string name = std::to_string(i);
    weights_.push_back(register_parameter("weight" + name, 0.02 * weight));
    biases_.push_back(register_parameter("bias" + name, torch::zeros({weight.size(0)})));
    u_.push_back(register_buffer("u" + name, UnitVector(torch::randn({weight.size(0)}))));
  }
}

torch::Tensor PlainDiscriminatorImpl::Normalised(std::size_t layer) {
  const torch::Tensor matrix = weights_[layer].flatten(1);
  torch::Tensor v;
  {
    torch::NoGradGuard no_grad;
    v = UnitVector(matrix.t().mv(u_[layer]));
    u_[layer].copy_(UnitVector(matrix.mv(v)));
    v = UnitVector(matrix.t().mv(u_[layer]));
  }
  return weights_[layer] / u_[layer].clone().dot(matrix.mv(v));
}

torch::Tensor PlainDiscriminatorImpl::forward(const torch::Tensor& sdf) {
  torch::Tensor x = sdf.view({-1, pack_, 32, 32, 32});
  for (std::size_t i = 0; i < kConvolutions; ++i) {
    x = torch::leaky_relu(torch::conv3d(x, Normalised(i), biases_[i], 2, 1), 0.2);
  }
  return torch::linear(x.flatten(1), Normalised(kConvolutions), biases_[kConvolutions]).squeeze(1);
}

void PlainDiscriminatorImpl::CopyFrom(const Discriminator& discriminator) {
  torch::NoGradGuard no_grad;
  const auto ours = discriminator->named_parameters();
  const auto buffers = discriminator->named_buffers();
  for (std::size_t i = 0; i <= kConvolutions; ++i) {
    const std::string name = std::to_string(i + 1);
    weights_[i].copy_(ours["layer" + name + ".weight"]);
    biases_[i].copy_(ours["bias" + name]);
    u_[i].copy_(buffers["layer" + name + ".u"]);
  }
}

PlainTrainer::PlainTrainer(const ModelOptions& options, int batch)
    : latent_(options.latent),
      batch_(batch),
      generator_(options),
      average_(options),
      discriminator_(options),
      adam_g_(generator_->parameters(), AdamSettings()),
      adam_d_(discriminator_->parameters(), AdamSettings()) {}

torch::Tensor PlainTrainer::Fake() { return generator_(torch::randn({batch_, latent_})); }

void PlainTrainer::Step(const torch::Tensor& shapes) {
  const torch::Tensor real =
      shapes.index_select(0, torch::randint(shapes.size(0), {batch_}, torch::kLong));
  adam_d_.zero_grad();
  const torch::Tensor real_score = discriminator_(real);
  const torch::Tensor fake_score = discriminator_(Fake().detach());
  (torch::relu(1.0 - real_score).mean() + torch::relu(1.0 + fake_score).mean()).backward();
  adam_d_.step();

  adam_g_.zero_grad();
  (-discriminator_(Fake()).mean()).backward();
  adam_g_.step();

  torch::NoGradGuard no_grad;
  auto target = average_->parameters();
  const auto source = generator_->parameters();
  for (std::size_t i = 0; i < target.size(); ++i) target[i].lerp_(source[i], 1.0 - kDecay);
}

}  // namespace antigrasp::bench
