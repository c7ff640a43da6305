#pragma once

#include <string>
#include <vector>

#include "antigrasp/train/gan_trainer.h"
#include "antigrasp/train/shape_model.h"

namespace antigrasp {

// Names and values of the GAN's scalars: a StepReport in its order, then
// GanTrainer::LargestSigma.
std::vector<std::string> GanScalarNames();
std::vector<double> GanScalars(const StepReport& report, double largest_sigma);
std::string GanScalarText(const StepReport& report);  // "L_D 1.50  L_G +2.50"

// The GAN as the episode loop sees it.
class GanModel : public ShapeModel {
 public:
  explicit GanModel(GanTrainer trainer);

  void BeginEpisode(int episode, std::int64_t iterations, bool restart) override;
  void BeginFixedEpisode(int episode, const LatentMixture& latent) override;
  int episode() const override { return trainer_.episode(); }
  std::int64_t step() const override { return trainer_.step(); }
  std::int64_t iterations() const override { return trainer_.iterations(); }

  void Step(const torch::Tensor& shapes) override { last_ = trainer_.Step(shapes); }
  torch::Device device() const override { return trainer_.device(); }
  std::vector<std::string> ScalarNames() const override { return GanScalarNames(); }
  std::vector<double> Scalars() override { return GanScalars(last_, trainer_.LargestSigma()); }
  std::string ScalarText() const override { return GanScalarText(last_); }

  torch::Tensor Sample(std::uint64_t seed, std::int64_t first, std::int64_t count) override;
  torch::Tensor Latents(std::uint64_t seed, std::int64_t first, std::int64_t count) const override;
  const LatentMixture& latent() const override { return trainer_.latent(); }
  std::int64_t PartNumbers() const override { return trainer_.PartNumbers(); }
  torch::Tensor Draw(const torch::Tensor& latents) override { return trainer_.Draw(latents); }

  NamedTensors State() const override { return trainer_.State(); }
  void Load(const NamedTensors& state, const std::string& origin) override;
  void LoadNetworks(const NamedTensors& state, const std::string& origin) override;

 private:
  GanTrainer trainer_;
  StepReport last_;
};

}  // namespace antigrasp
