#include <torch/types.h>
#include <torch/version.h>

#include <algorithm>
#include <cmath>

#include "antigrasp/doctor/network_facts.h"
#include "antigrasp/sdf/sdf_grid.h"
#include "antigrasp/train/gan_trainer.h"
#include "antigrasp/train/torch_threads.h"

namespace antigrasp {
namespace {

// As in self_test.cpp, of Debian 12's LibTorch 1.13 and OpenBLAS, with the kernels of AVX2.
constexpr std::uint64_t kUpdated = 0xbff53689ddb9268a, kSampled = 0x88ffd929f024ef7a;
constexpr bool kKnown = TORCH_VERSION_MAJOR == 1 && TORCH_VERSION_MINOR == 13;

// Network values of four balls, [4, 1, 16, 16, 16].
torch::Tensor Balls() {
  constexpr int kCount = 4, kSide = 16;
  const SdfGrid grid = UnitCubeGrid(kSide);
  std::vector<float> values;
  for (int ball = 0; ball < kCount; ++ball) {
    for (int z = 0; z < kSide; ++z) {
      for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
          const double depth = 0.2 + 0.05 * ball - grid.Node(x, y, z).norm();
          values.push_back(static_cast<float>(std::clamp(10 * depth, -1.0, 1.0)));
        }
      }
    }
  }
  return torch::from_blob(values.data(), {kCount, 1, kSide, kSide, kSide}).clone();
}

void Add(const torch::Tensor& tensor, HashedBytes* bytes) {
  const torch::Tensor flat = tensor.contiguous();
  bytes->Add(static_cast<const char*>(flat.data_ptr()), flat.nbytes());
}

SelfTestStep Step(const char* name, const HashedBytes& bytes, std::uint64_t expected) {
  SelfTestStep step{name, bytes.Hash(), {}};
  if (kKnown) step.expected = expected;
  return step;
}

}  // namespace

std::vector<SelfTestStep> RunNetworkSelfTest() {
  SetTorchThreads(1, 1);
  ModelOptions model;
  model.width = 4;
  model.resolution = 16;
  GanOptions options;
  options.batch = 4;
  GanTrainer trainer(model, options, 1, torch::kCPU);
  trainer.BeginEpisode(0, 3, true);
  const torch::Tensor balls = Balls();
  for (int update = 0; update < 3; ++update) trainer.Step(balls);
  HashedBytes state, samples;
  for (const auto& [name, tensor] : trainer.State()) Add(tensor, &state);
  Add(trainer.Sample(1, 0, 2), &samples);
  return {Step("updated", state, kUpdated), Step("sampled", samples, kSampled)};
}

}  // namespace antigrasp
