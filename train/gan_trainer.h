#pragma once

#include <torch/types.h>

#include <cstdint>
#include <memory>
#include <string>

#include "antigrasp/models/discriminator.h"
#include "antigrasp/models/named_tensors.h"
#include "antigrasp/models/shape_generator.h"
#include "antigrasp/train/batch_share.h"
#include "antigrasp/train/gan_options.h"
#include "antigrasp/train/latent_mixture.h"

namespace antigrasp {

// What one step was like. Gradient: 2-norm over all parameters of the network.
struct StepReport {
  double loss_discriminator = 0.0;      // L_D^data + L_D^gen (hinge, V-A)
  double loss_generator = 0.0;          // L_G
  double gradient_discriminator = 0.0;  // also where it rests: gan.rest_below
  double gradient_generator = 0.0;
  double rate_discriminator = 0.0;  // Adam's learning rates
  double rate_generator = 0.0;
};

// The networks, their average, their optimisers and the step count: all that training changes.
// Random numbers of step t depend on (seed, episode, t) only, so there is no generator state.
// Same seed, same bits, with any number of threads where ThreadsOfLibTorch gives LibTorch one.
class GanTrainer {
 public:
  GanTrainer(const ModelOptions& model, const GanOptions& options, std::uint64_t seed,
             torch::Device device);
  GanTrainer(GanTrainer&& other) noexcept;
  ~GanTrainer();

  // Begins an episode: Adam's moments and the average restart; networks go on from where they are,
  // or from fresh weights when `restart_networks`.
  void BeginEpisode(int episode, std::int64_t iterations, bool restart_networks);

  // Begins an episode without updates: the averaged generator stays as it is, and z comes from
  // `latent` (latent-space CEM, or networks trained elsewhere).
  void BeginFixedEpisode(int episode, const LatentMixture& latent);

  // One update of D (discriminator_steps of them) and of G. `shapes`: [N, 1, r, r, r] float16 or
  // float32 network values, fastest on the trainer's own device. A loss or gradient that is not
  // finite: RuntimeFailure before it reaches the weights.
  StepReport Step(const torch::Tensor& shapes);

  // Parts of batches (gan.micro_batches) are shared with other processes, whose trainers have had
  // the same calls. Keeps the pointer.
  void ShareBatches(BatchShare* share);

  // The largest singular value of a discriminator's weight, undivided; nan without spectral norm.
  double LargestSigma() const;

  std::int64_t step() const;        // steps done in this episode
  std::int64_t iterations() const;  // of this episode
  int episode() const;
  torch::Device device() const;

  // Sample `first + i` of stream `seed` from the averaged generator, i in [0, count): network
  // values [count, 1, r, r, r] float32 on the CPU. Sample i does not depend on count or batch.
  torch::Tensor Sample(std::uint64_t seed, std::int64_t first, std::int64_t count);

  // Values [n, 1, r, r, r] of latents [n, ...] that are none of a sample's.
  torch::Tensor Draw(const torch::Tensor& latents);
  std::int64_t PartNumbers() const;  // shape_generator.h

  // The z of these samples, [count, latent]; the mixture they are drawn from.
  torch::Tensor Latents(std::uint64_t seed, std::int64_t first, std::int64_t count) const;
  const LatentMixture& latent() const;

  // All tensors by name, flat: generator/..., discriminator/..., average/... (parameters and
  // buffers), adam_generator/first/<i>, second/<i>, steps, adam_discriminator/..., adam_encoder/...
  // of turned solids, latent/..., progress (int64: episode, iterations, step); shared. Going on
  // after Load equals going on without, bit for bit. Load throws InputError naming `origin` and
  // changes nothing when a tensor is missing or does not fit.
  NamedTensors State() const;
  void Load(const NamedTensors& state, const std::string& origin);

  // What is enough to sample and to begin an episode: average/..., discriminator/... and
  // latent/..., float16. LoadNetworks takes these from either; the generator goes on from the
  // average.
  NamedTensors Networks() const;
  void LoadNetworks(const NamedTensors& state, const std::string& origin);

  // Takes the networks of `other`, which has batch norm, where this one has none but is otherwise
  // like it (GeneratorImpl::TakeFolded): the same samples up to rounding.
  void TakeFolded(GanTrainer* other);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace antigrasp
