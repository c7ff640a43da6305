#pragma once

#include <torch/types.h>

#include <map>
#include <string>

#include "antigrasp/train/gan_trainer.h"

// Networks whose answers are known on paper, and a trainer's state as tensors by name.
namespace antigrasp::tiny_gan {

using Tensors = std::map<std::string, torch::Tensor>;

// No normalisation and no blur: every number of it can be set.
inline ModelOptions PlainModel() {
  ModelOptions options;
  options.width = 2;
  options.latent = 3;
  options.batch_norm = options.spectral_norm = options.output_blur = false;
  return options;
}

inline GanOptions StillOptions() {  // no network moves
  GanOptions options;
  options.batch = 4;
  options.learning_rate_g = options.learning_rate_d = 0.0;
  options.lr_decay_fraction = 0.0;
  return options;
}

inline Tensors TensorsOf(const NamedTensors& named) {  // copies
  Tensors tensors;
  for (const auto& [name, tensor] : named) tensors[name] = tensor.detach().clone();
  return tensors;
}
inline Tensors StateOf(const GanTrainer& trainer) { return TensorsOf(trainer.State()); }
inline Tensors NetworksOf(const GanTrainer& trainer) { return TensorsOf(trainer.Networks()); }

inline NamedTensors NamedOf(const Tensors& tensors) { return {tensors.begin(), tensors.end()}; }
inline void SetState(const Tensors& tensors, GanTrainer* trainer) {
  trainer->Load(NamedOf(tensors), "state");
}

inline torch::Tensor Solids() { return torch::ones({3, 1, 32, 32, 32}); }  // +1 at every node

// A discriminator that scores Solids() as `solid`, grids of -1 as `empty`, and grids of v between
// them in proportion: every convolution passes node (0, 0, 0) on, made positive by bias1. The
// generator gives tanh(`output`) everywhere.
inline void SetNetworks(double solid, double empty, double output, GanTrainer* trainer) {
  Tensors state = StateOf(*trainer);
  for (auto& [name, tensor] : state) {
    if (name.starts_with("discriminator/")) tensor.zero_();
  }
  for (const std::string layer : {"1", "2", "3", "4"}) {
    state["discriminator/layer" + layer + "/weight"][0][0][1][1][1] = 1.0;
  }
  state["discriminator/bias1"][0] = 1.0;
  state["discriminator/layer5/weight"][0][0] = (solid - empty) / 2.0;
  state["discriminator/bias5"][0] = empty;
  state["generator/last_weight"].zero_();
  state["generator/last_bias"].fill_(output);
  SetState(state, trainer);
}
inline constexpr double kEmpty = -20.0;  // an output whose tanh is -1

}  // namespace antigrasp::tiny_gan
