#include "antigrasp/train/latent_mixture.h"

#include <torch/types.h>

#include <cmath>

#include "antigrasp/core/check.h"
#include "antigrasp/models/random_tensor.h"

namespace antigrasp {

LatentMixture StandardNormal(std::int64_t latent) {
  return {torch::ones({1}), torch::zeros({1, latent}), torch::ones({1, latent})};
}

torch::Tensor DrawLatent(const LatentMixture& mixture, double share, RngStream* rng) {
  const torch::Tensor normal = NormalTensor({mixture.means.size(1)}, 1.0, rng);
  double left = share;
  std::int64_t component = 0;
  while (component + 1 < mixture.weights.size(0)) {
    left -= mixture.weights[component].item<double>();
    if (left < 0.0) break;
    ++component;
  }
  return mixture.means[component] + mixture.deviations[component] * normal;
}

LatentMixture AroundElites(const torch::Tensor& elites, std::int64_t latent, double step,
                           double part_step, double fresh) {
  AG_CHECK(elites.dim() == 2 && elites.size(0) > 0, "elites [n, latent + numbers], n > 0");
  AG_CHECK(step > 0.0 && step <= 1.0 && fresh >= 0.0, "0 < step <= 1, fresh >= 0");
  const std::int64_t n = elites.size(0), numbers = elites.size(1) - latent;
  LatentMixture mixture{torch::full({n}, 1.0 / (static_cast<double>(n) * (1.0 + fresh))),
                        elites.clone(), torch::full_like(elites, step)};
  mixture.means.narrow(1, 0, latent).mul_(std::sqrt(1.0 - step * step));
  mixture.deviations.narrow(1, latent, numbers).fill_(part_step);
  if (fresh > 0.0) {
    LatentMixture standard = StandardNormal(elites.size(1));
    standard.deviations.narrow(1, latent, numbers).fill_(part_step);
    mixture.weights = torch::cat({mixture.weights, standard.weights * (fresh / (1.0 + fresh))});
    mixture.means = torch::cat({mixture.means, standard.means});
    mixture.deviations = torch::cat({mixture.deviations, standard.deviations});
  }
  return mixture;
}

}  // namespace antigrasp
