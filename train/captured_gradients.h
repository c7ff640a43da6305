#pragma once

#include <torch/types.h>

#include <memory>

#include "antigrasp/train/gan_gradients.h"

namespace antigrasp {

// GanGradients that a GPU need not be told twice: a step launches several hundred small kernels,
// which takes the host longer than the GPU. After a few calls each of the two is recorded as a CUDA
// graph and from then on replayed by one launch. Only where this was built with LibTorch 2 for
// CUDA, on such a device, and where a step is always the same work (gan.augment = "none", no
// gan.micro_batches, one discriminator step); elsewhere it is GanGradients. Gradients are the next
// call's storage: use them before it.
class CapturedGradients {
 public:
  CapturedGradients(const GanGradients& gradients, const GanOptions& options, torch::Device device);
  ~CapturedGradients();

  const GanGradients& launched() const { return gradients_; }
  void Draw(const torch::Tensor& shapes, GanPart* part) const { gradients_.Draw(shapes, part); }
  LossAndGradients OfDiscriminator(GanPart* part);
  LossAndGradients OfGenerator(GanPart* part);

 private:
  struct Graphs;
  GanGradients gradients_;
  std::unique_ptr<Graphs> graphs_;  // null where nothing is recorded
};

// Whether this program can record steps at all.
bool HasCapture();

}  // namespace antigrasp
