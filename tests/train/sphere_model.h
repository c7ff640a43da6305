#pragma once

#include <torch/types.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "antigrasp/models/sdf_values.h"
#include "antigrasp/sdf/sdf_grid.h"
#include "antigrasp/train/averaged_generator.h"
#include "antigrasp/train/network_tensors.h"
#include "antigrasp/train/run_config.h"
#include "antigrasp/train/shape_model.h"

namespace antigrasp::shapes {

// |x| at the nodes of the standard grid, [1, n, n, n].
inline torch::Tensor Radii(int n) {
  const SdfGrid grid = UnitCubeGrid(n);
  torch::Tensor radii = torch::empty({1, n, n, n});
  float* out = radii.data_ptr<float>();
  for (int z = 0; z < n; ++z) {
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) *out++ = static_cast<float>(grid.Node(x, y, z).norm());
    }
  }
  return radii;
}

// A shape model without networks that draws spheres around the origin, of radius
// r (1 + tanh(z_0) / 5), times exp of the first number of parts where it has any. A step goes an
// eighth of the way from r to the mean radius of the training set; r = 0.1 to begin with.
// Everything it does is known on paper.
class SphereModel : public ShapeModel {
 public:
  explicit SphereModel(const RunConfig& config, std::int64_t part_numbers = 0)
      : model_(config.model),
        part_numbers_(part_numbers),
        latent_(StandardNormal(config.model.latent)) {}

  double radius() const { return radius_.item<double>(); }
  static double RadiusOf(double r, double z0) { return r * (1.0 + std::tanh(z0) / 5.0); }

  void BeginEpisode(int episode, std::int64_t iterations, bool restart) override {
    if (restart) radius_.fill_(0.1);
    SetProgress(episode, iterations, 0);
    latent_ = StandardNormal(model_.latent);
  }
  void BeginFixedEpisode(int episode, const LatentMixture& latent) override {
    SetProgress(episode, 0, 0);
    latent_ = latent;
  }
  int episode() const override { return static_cast<int>(At(0)); }
  std::int64_t iterations() const override { return At(1); }
  std::int64_t step() const override { return At(2); }

  void Step(const torch::Tensor& shapes) override {
    gap_ = MeanRadius(shapes) - radius();
    radius_ += gap_ / 8.0;
    SetProgress(episode(), iterations(), step() + 1);
  }
  torch::Device device() const override { return torch::kCPU; }
  std::vector<std::string> ScalarNames() const override { return {"radius", "gap"}; }
  std::vector<double> Scalars() override { return {radius(), gap_}; }
  std::string ScalarText() const override { return "r " + std::to_string(radius()); }

  torch::Tensor Sample(std::uint64_t seed, std::int64_t first, std::int64_t count) override {
    return Draw(Latents(seed, first, count));
  }
  torch::Tensor Latents(std::uint64_t seed, std::int64_t first, std::int64_t count) const override {
    return SampleLatents(latent_, seed, first, count);
  }
  const LatentMixture& latent() const override { return latent_; }
  std::int64_t PartNumbers() const override { return part_numbers_; }
  torch::Tensor Draw(const torch::Tensor& latents) override {
    std::vector<torch::Tensor> spheres;
    for (const torch::Tensor& z : latents.unbind()) {
      const double part = z.size(0) > model_.latent ? z[model_.latent].item<double>() : 0.0;
      const double r = RadiusOf(radius(), z[0].item<double>()) * std::exp(part);
      spheres.push_back(NetworkValues(r - Radii(model_.resolution), model_));
    }
    return torch::stack(spheres);
  }

  NamedTensors State() const override { return StateWith(latent_); }
  void Load(const NamedTensors& state, const std::string& origin) override {
    const torch::Tensor* const weights = FindTensor(state, "latent/weights");
    const std::int64_t n = weights != nullptr ? weights->size(0) : 1;
    const LatentMixture read = {torch::empty({n}), torch::empty({n, model_.latent}),
                                torch::empty({n, model_.latent})};
    TakeTensors(state, origin, StateWith(read));
    latent_ = read;
  }
  void LoadNetworks(const NamedTensors& state, const std::string& origin) override {
    Load(state, origin);
  }

  // Of spheres around the origin, by the nodes whose distance is not cut off.
  double MeanRadius(const torch::Tensor& shapes) const {
    const torch::Tensor values = shapes.to(torch::kFloat);
    const torch::Tensor known = (values.abs() < 1.0).to(torch::kDouble);
    const torch::Tensor radii = (Radii(model_.resolution) + Distances(values, model_)) * known;
    return (radii.sum({1, 2, 3, 4}) / known.sum({1, 2, 3, 4})).mean().item<double>();
  }

 private:
  std::int64_t At(std::int64_t i) const { return progress_[i].item<std::int64_t>(); }
  void SetProgress(std::int64_t episode, std::int64_t iterations, std::int64_t step) {
    progress_.copy_(torch::tensor(std::vector<std::int64_t>{episode, iterations, step}));
  }
  NamedTensors StateWith(const LatentMixture& latent) const {
    NamedTensors state = {{"sphere/radius", radius_}, {"progress", progress_}};
    AppendMixture("latent/", latent, &state);
    return state;
  }

  ModelOptions model_;
  std::int64_t part_numbers_;
  LatentMixture latent_;
  torch::Tensor radius_ = torch::full({}, 0.1, torch::kDouble);
  torch::Tensor progress_ = torch::zeros({3}, torch::kLong);
  double gap_ = 0.0;
};

inline std::unique_ptr<ShapeModel> MakeSpheres(const RunConfig& config) {
  return std::make_unique<SphereModel>(config);
}

}  // namespace antigrasp::shapes
