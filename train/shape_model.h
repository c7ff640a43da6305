#pragma once

#include <torch/types.h>

#include <cstdint>
#include <string>
#include <vector>

#include "antigrasp/core/error.h"
#include "antigrasp/models/named_tensors.h"
#include "antigrasp/train/latent_mixture.h"

namespace antigrasp {

// A state that another kind of model saved.
class OtherShapeModel : public InputError {
 public:
  using InputError::InputError;
};

// What the episode loop trains and draws shapes from: p_theta of section V-B. The GAN (gan_model.h)
// is one. Random numbers depend on a seed, the episode, the step and the sample only, so that a
// model that was saved and loaded goes on as one that was not, bit for bit.
class ShapeModel {
 public:
  virtual ~ShapeModel() = default;

  // An episode of `iterations` > 0 steps, from where the model is or, when `restart`, from fresh
  // weights. z is N(0, I).
  virtual void BeginEpisode(int episode, std::int64_t iterations, bool restart) = 0;
  // An episode without steps: the model stays as it is, and z comes from `latent`.
  virtual void BeginFixedEpisode(int episode, const LatentMixture& latent) = 0;

  virtual int episode() const = 0;
  virtual std::int64_t step() const = 0;        // steps done in this episode
  virtual std::int64_t iterations() const = 0;  // of this episode

  // One step on a training set, network values [N, 1, n, n, n] float16 on device(), N > 0.
  // RuntimeFailure when training diverges, before it spoils the state.
  virtual void Step(const torch::Tensor& shapes) = 0;
  virtual torch::Device device() const = 0;

  // The scalars of a step by name, columns of losses.csv behind "step": the same names for the
  // model's whole life. Values are those of the last step of this object; asked for after every
  // tenth step, so that they may cost something. NaN: not known.
  virtual std::vector<std::string> ScalarNames() const = 0;
  virtual std::vector<double> Scalars() = 0;
  virtual std::string ScalarText() const = 0;  // a few of them, beside the progress bar

  // Sample `first + i` of stream `seed`, i in [0, count): network values [count, 1, n, n, n]
  // float32 on the CPU, and the z they are drawn from, [count, latent]. Sample i does not depend on
  // count.
  virtual torch::Tensor Sample(std::uint64_t seed, std::int64_t first, std::int64_t count) = 0;
  virtual torch::Tensor Latents(std::uint64_t seed, std::int64_t first,
                                std::int64_t count) const = 0;
  virtual const LatentMixture& latent() const = 0;  // the distribution of z

  // How many numbers z draws a shape by, where the model tells them apart, else 0: latents may
  // carry as many behind z, which are added to them. Draw: network values [N, 1, n, n, n] float32
  // on the CPU of latents [N, latent] or [N, latent + PartNumbers()].
  virtual std::int64_t PartNumbers() const = 0;
  virtual torch::Tensor Draw(const torch::Tensor& latents) = 0;

  // The whole state by name, progress included. It may share storage with the model.
  virtual NamedTensors State() const = 0;
  // Take a State, or what of it is enough to sample and to begin an episode; more is overlooked.
  // InputError naming `origin`, and nothing changed, when it does not fit; OtherShapeModel when it
  // is of another kind altogether.
  virtual void Load(const NamedTensors& state, const std::string& origin) = 0;
  virtual void LoadNetworks(const NamedTensors& state, const std::string& origin) = 0;
};

}  // namespace antigrasp
