#pragma once

#include <torch/serialize/archive.h>
#include <torch/types.h>

#include <map>
#include <sstream>
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

inline Tensors TensorsOf(torch::serialize::OutputArchive* written) {
  std::stringstream file;
  written->save_to(file);
  torch::serialize::InputArchive archive;
  archive.load_from(file);
  Tensors tensors;
  for (const std::string& key : archive.keys()) archive.read(key, tensors[key], true);
  return tensors;
}
inline Tensors StateOf(const GanTrainer& trainer) {
  torch::serialize::OutputArchive archive;
  trainer.Save(&archive);
  return TensorsOf(&archive);
}
inline Tensors NetworksOf(const GanTrainer& trainer) {
  torch::serialize::OutputArchive archive;
  trainer.SaveNetworks(&archive);
  return TensorsOf(&archive);
}

inline torch::serialize::InputArchive ArchiveOf(const Tensors& tensors) {
  torch::serialize::OutputArchive written;
  for (const auto& [name, tensor] : tensors) written.write(name, tensor, true);
  std::stringstream file;
  written.save_to(file);
  torch::serialize::InputArchive archive;
  archive.load_from(file);
  return archive;
}
inline void SetState(const Tensors& tensors, GanTrainer* trainer) {
  torch::serialize::InputArchive archive = ArchiveOf(tensors);
  trainer->Load(&archive);
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
