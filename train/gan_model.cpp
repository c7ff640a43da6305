#include "antigrasp/train/gan_model.h"

#include <cstdio>
#include <utility>

namespace antigrasp {

std::vector<std::string> GanScalarNames() {
  return {"loss_discriminator", "loss_generator", "gradient_discriminator", "gradient_generator",
          "rate_discriminator", "rate_generator", "largest_sigma"};
}

std::vector<double> GanScalars(const StepReport& r, double largest_sigma) {
  return {r.loss_discriminator, r.loss_generator,     r.gradient_discriminator,
          r.gradient_generator, r.rate_discriminator, r.rate_generator,
          largest_sigma};
}

std::string GanScalarText(const StepReport& report) {
  char text[64];
  std::snprintf(text, sizeof text, "L_D %.2f  L_G %+.2f", report.loss_discriminator,
                report.loss_generator);
  return text;
}

GanModel::GanModel(GanTrainer trainer) : trainer_(std::move(trainer)) {}

void GanModel::BeginEpisode(int episode, std::int64_t iterations, bool restart) {
  trainer_.BeginEpisode(episode, iterations, restart);
}

void GanModel::BeginFixedEpisode(int episode, const LatentMixture& latent) {
  trainer_.BeginFixedEpisode(episode, latent);
}

torch::Tensor GanModel::Sample(std::uint64_t seed, std::int64_t first, std::int64_t count) {
  return trainer_.Sample(seed, first, count);
}

torch::Tensor GanModel::Latents(std::uint64_t seed, std::int64_t first, std::int64_t count) const {
  return trainer_.Latents(seed, first, count);
}

void GanModel::Load(const NamedTensors& state, const std::string& origin) {
  trainer_.Load(state, origin);
}

void GanModel::LoadNetworks(const NamedTensors& state, const std::string& origin) {
  trainer_.LoadNetworks(state, origin);
}

}  // namespace antigrasp
