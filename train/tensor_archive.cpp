#include "antigrasp/train/tensor_archive.h"

#include <torch/serialize/input-archive.h>
#include <torch/serialize/output-archive.h>
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

}  // namespace

void WriteTensors(const NamedTensors& tensors, torch::serialize::OutputArchive* archive) {
  for (const auto& [name, tensor] : tensors) {
    archive->write(name, tensor.detach().cpu(), /*is_buffer=*/true);
  }
}

void ReadTensors(const NamedTensors& tensors, const std::string& where,
                 torch::serialize::InputArchive* archive) {
  std::vector<torch::Tensor> values(tensors.size());
  for (std::size_t i = 0; i < tensors.size(); ++i) {
    const auto& [name, target] = tensors[i];
    if (!archive->try_read(name, values[i], /*is_buffer=*/true) || !values[i].defined()) {
      throw InputError("no tensor " + name, where, Describe(target));
    }
    const bool shorter =  // float16 stands for float32 in files that are to be small
        values[i].scalar_type() == torch::kHalf && target.scalar_type() == torch::kFloat;
    if (values[i].sizes() != target.sizes() ||
        (!shorter && values[i].scalar_type() != target.scalar_type())) {
      throw InputError("tensor " + name + " is " + Describe(values[i]), where,
                       Describe(target) + " (were the model options changed?)");
    }
    if (values[i].is_floating_point() && !values[i].isfinite().all().item<bool>()) {
      throw InputError("tensor " + name + " is damaged", where, "finite numbers");
    }
  }
  torch::NoGradGuard no_grad;
  for (std::size_t i = 0; i < tensors.size(); ++i) {
    torch::Tensor target = tensors[i].second;
    target.copy_(values[i]);
  }
}

}  // namespace antigrasp
