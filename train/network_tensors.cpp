#include "antigrasp/train/network_tensors.h"

#include <algorithm>

namespace antigrasp {

void AppendModule(const std::string& prefix, const torch::nn::Module& module, NamedTensors* out) {
  for (const auto& tensors : {module.named_parameters(), module.named_buffers()}) {
    for (const auto& item : tensors) {
      std::string name = prefix + item.key();
      std::replace(name.begin(), name.end(), '.', '/');
      out->emplace_back(name, item.value());
    }
  }
}

void AppendAdam(const std::string& prefix, const Adam& adam, NamedTensors* out) {
  for (std::size_t i = 0; i < adam.parameters().size(); ++i) {
    out->emplace_back(prefix + "first/" + std::to_string(i), adam.first_moments()[i]);
    out->emplace_back(prefix + "second/" + std::to_string(i), adam.second_moments()[i]);
  }
  out->emplace_back(prefix + "steps", adam.steps());
}

void AppendMixture(const std::string& prefix, const LatentMixture& mixture, NamedTensors* out) {
  out->emplace_back(prefix + "weights", mixture.weights);
  out->emplace_back(prefix + "means", mixture.means);
  out->emplace_back(prefix + "deviations", mixture.deviations);
}

void CopyModule(const torch::nn::Module& from, const torch::nn::Module& to) {
  torch::NoGradGuard no_grad;
  NamedTensors source, target;
  AppendModule("", from, &source);
  AppendModule("", to, &target);
  for (std::size_t i = 0; i < source.size(); ++i) target[i].second.copy_(source[i].second);
}

}  // namespace antigrasp
