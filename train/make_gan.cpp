#include "antigrasp/train/make_gan.h"

#include <torch/cuda.h>
#include <torch/types.h>

#include "antigrasp/core/error.h"
#include "antigrasp/core/parallel.h"
#include "antigrasp/train/gan_model.h"
#include "antigrasp/train/torch_threads.h"

namespace antigrasp {

std::unique_ptr<ShapeModel> MakeGan(const RunConfig& config) {
  return std::make_unique<GanModel>(MakeTrainer(config));
}

GanTrainer MakeTrainer(const RunConfig& config) {
  const int asked = config.torch_threads > 0 ? config.torch_threads : config.threads;
  const int threads = asked > 0 ? asked : HardwareThreads();
  const std::string expected = "a device this LibTorch offers: cpu" +
                               std::string(torch::cuda::is_available() ? ", cuda" : " only");
  try {
    const torch::Device device(config.device);
    if (device.is_cuda() && !torch::cuda::is_available()) {
      throw InputError("run.device = " + config.device, "--device", expected);
    }
    SetTorchThreads(threads, ThreadsOfLibTorch(config.model, device.is_cpu(), threads));
    // Every step convolves the same shapes: trying cuDNN's algorithms once pays.
    if (device.is_cuda()) at::globalContext().setBenchmarkCuDNN(true);
    return GanTrainer(config.model, config.gan, config.seed, device);
  } catch (const c10::Error&) {
    throw InputError("run.device = " + config.device, "--device", expected);
  }
}

}  // namespace antigrasp
