#pragma once

#include <torch/serialize/archive.h>
#include <torch/types.h>

#include <string>
#include <utility>
#include <vector>

namespace antigrasp {

// Tensors by name ("generator/last_weight"): the state of something that trains.
using NamedTensors = std::vector<std::pair<std::string, torch::Tensor>>;

void WriteTensors(const NamedTensors& tensors, torch::serialize::OutputArchive* archive);

// Overwrites the values of all tensors, or of none: InputError when a name is missing or its shape,
// type (float16 will do for float32) or numbers (not finite) are wrong. `where` names the file in
// the message.
void ReadTensors(const NamedTensors& tensors, const std::string& where,
                 torch::serialize::InputArchive* archive);

}  // namespace antigrasp
