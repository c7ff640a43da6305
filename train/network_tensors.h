#pragma once

#include <torch/nn/module.h>

#include <string>

#include "antigrasp/models/named_tensors.h"
#include "antigrasp/train/adam.h"
#include "antigrasp/train/latent_mixture.h"

namespace antigrasp {

// The tensors of each part of a trainer by name, for checkpoints. They share storage with the part.
void AppendModule(const std::string& prefix, const torch::nn::Module& module, NamedTensors* out);
void AppendAdam(const std::string& prefix, const Adam& adam, NamedTensors* out);
void AppendMixture(const std::string& prefix, const LatentMixture& mixture, NamedTensors* out);

// Copies the parameters and buffers of a module into another of the same shape.
void CopyModule(const torch::nn::Module& from, const torch::nn::Module& to);

}  // namespace antigrasp
