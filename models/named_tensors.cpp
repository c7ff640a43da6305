#include "antigrasp/models/named_tensors.h"

#include <torch/types.h>
#include <torch/utils.h>

#include <sstream>

#include "antigrasp/core/error.h"

namespace antigrasp {
namespace {

std::string Describe(const torch::Tensor& tensor) {
  std::ostringstream text;
  text << c10::toString(tensor.scalar_type()) << " " << tensor.sizes();
  return text.str();
}

void RequireFit(const torch::Tensor& value, const std::string& name, const torch::Tensor& target,
                const std::string& origin) {
  const bool shorter =  // float16 stands for float32 in files that are to be small
      value.scalar_type() == torch::kHalf && target.scalar_type() == torch::kFloat;
  if (value.sizes() != target.sizes() ||
      (!shorter && value.scalar_type() != target.scalar_type())) {
    throw InputError("tensor " + name + " is " + Describe(value), origin,
                     Describe(target) + " (were the model options changed?)");
  }
  if (value.is_floating_point() && !value.isfinite().all().item<bool>()) {
    throw InputError("tensor " + name + " is damaged", origin, "finite numbers");
  }
}

}  // namespace

const torch::Tensor* FindTensor(const NamedTensors& tensors, std::string_view name) {
  for (const auto& [other, tensor] : tensors) {
    if (other == name && tensor.defined()) return &tensor;
  }
  return nullptr;
}

void TakeTensors(const NamedTensors& from, const std::string& origin, const NamedTensors& to) {
  std::vector<const torch::Tensor*> values;
  for (const auto& [name, target] : to) {
    values.push_back(FindTensor(from, name));
    if (values.back() == nullptr) throw InputError("no tensor " + name, origin, Describe(target));
    RequireFit(*values.back(), name, target, origin);
  }
  torch::NoGradGuard no_grad;
  for (std::size_t i = 0; i < to.size(); ++i) {
    torch::Tensor target = to[i].second;
    target.copy_(*values[i]);
  }
}

}  // namespace antigrasp
