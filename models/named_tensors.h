#pragma once

#include <ATen/core/Tensor.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace antigrasp {

// Tensors by name ("generator/last_weight"): the state of something that trains.
using NamedTensors = std::vector<std::pair<std::string, at::Tensor>>;

// The tensor of this name; nullptr when there is none.
const at::Tensor* FindTensor(const NamedTensors& tensors, std::string_view name);

// Overwrites the values of all tensors of `to` with those of the same names in `from`, which may
// hold more, or of none: InputError naming `origin` when a name is missing or its shape, type
// (float16 will do for float32) or numbers (not finite) are wrong.
void TakeTensors(const NamedTensors& from, const std::string& origin, const NamedTensors& to);

}  // namespace antigrasp
