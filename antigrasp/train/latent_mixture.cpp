#include "antigrasp/train/latent_mixture.h"

#include <torch/torch.h>

#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "antigrasp/core/check.h"
#include "antigrasp/models/random_tensor.h"

namespace antigrasp {
namespace {

constexpr int kIterations = 20;  // of expectation-maximisation

// Log density of every row of z [n, d] under every component, up to a constant: [n, components].
torch::Tensor LogDensity(const LatentMixture& mixture, const torch::Tensor& z) {
  const torch::Tensor scaled = (z.unsqueeze(1) - mixture.means) / mixture.deviations;
  return mixture.weights.clamp_min(1e-12).log() - mixture.deviations.log().sum(1) -
         0.5 * scaled.square().sum(2);
}

// Each component begins on an elite of its own, as far as there are enough.
torch::Tensor DistinctElites(const torch::Tensor& elites, std::int64_t components, RngStream* rng) {
  std::vector<std::int64_t> order(static_cast<std::size_t>(elites.size(0)));
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[rng->Below(i)]);
  std::vector<std::int64_t> chosen;
  for (std::int64_t c = 0; c < components; ++c) {
    chosen.push_back(order[static_cast<std::size_t>(c) % order.size()]);
  }
  return elites.index_select(0, torch::tensor(chosen, torch::kLong));
}

}  // namespace

LatentMixture StandardNormal(std::int64_t components, std::int64_t latent) {
  return {torch::full({components}, 1.0 / static_cast<double>(components)),
          torch::zeros({components, latent}), torch::ones({components, latent})};
}

torch::Tensor DrawLatent(const LatentMixture& mixture, RngStream* rng) {
  const torch::Tensor normal = NormalTensor({mixture.means.size(1)}, 1.0, rng);
  double left = rng->Uniform();
  std::int64_t component = 0;
  while (component + 1 < mixture.weights.size(0)) {
    left -= mixture.weights[component].item<double>();
    if (left < 0.0) break;
    ++component;
  }
  return mixture.means[component] + mixture.deviations[component] * normal;
}

LatentMixture FitToElites(const LatentMixture& before, const torch::Tensor& elites,
                          double smoothing, double floor, RngStream* rng) {
  AG_CHECK(elites.dim() == 2 && elites.size(0) > 0, "elites [n, latent], n > 0");
  const torch::NoGradGuard no_grad;
  const std::int64_t components = before.weights.size(0);
  LatentMixture fit{before.weights.clone(), before.means.clone(), before.deviations.clone()};
  if (components > 1) {
    fit.means.add_(0.5 * (DistinctElites(elites, components, rng) - fit.means));
  }
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    const torch::Tensor share = torch::softmax(LogDensity(fit, elites), 1);  // [n, components]
    const torch::Tensor count = share.sum(0);                                // [components]
    const torch::Tensor used = (count >= 1.0).unsqueeze(1);
    const torch::Tensor total = count.clamp_min(1e-6).unsqueeze(1);
    const torch::Tensor mean = torch::mm(share.t(), elites) / total;
    const torch::Tensor square = torch::mm(share.t(), elites.square()) / total;
    const torch::Tensor deviation = (square - mean.square()).clamp_min(0.0).sqrt();
    fit.weights = count / count.sum();
    fit.means = torch::where(used, mean, before.means);
    fit.deviations = torch::where(used, deviation, before.deviations).clamp_min(floor);
  }
  fit.weights = torch::lerp(before.weights, fit.weights, smoothing);
  fit.means = torch::lerp(before.means, fit.means, smoothing);
  fit.deviations = torch::lerp(before.deviations, fit.deviations, smoothing).clamp_min(floor);
  return fit;
}

}  // namespace antigrasp
