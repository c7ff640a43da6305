#pragma once

#include <torch/types.h>

#include <vector>

#include "antigrasp/models/outline_encoder.h"
#include "antigrasp/models/solid_generator.h"
#include "antigrasp/train/adam.h"
#include "antigrasp/train/flat_gradients.h"

namespace antigrasp {

// Fits the encoder of outlines to a set before networks learn what it says: of shapes of the set
// the numbers whose turned solids are these, by the squares of what their network values,
// sharpened by model.edge_gain, differ by. The encoder is one network for all shapes, so that like
// shapes have like numbers; numbers found for each alone would not.
class OutlineFit {
 public:
  OutlineFit(const ModelOptions& model, const OutlineEncoder& encoder);

  // Of `batch` [N, 1, r, r, r], network values on the encoder's device, drawn by `generator`: the
  // mean over shapes of the squared differences that a half plane's nodes have, and its gradients.
  LossAndGradients Gradients(const torch::Tensor& batch, SolidGeneratorImpl* generator);

  // An update; `left` in (0, 1] is the share of the fit that is still to come. -> its rate.
  double Take(const std::vector<torch::Tensor>& gradients, double left);

  void Restart() { adam_.Restart(); }
  const Adam& adam() const { return adam_; }
  OutlineEncoder& encoder() { return encoder_; }

 private:
  ModelOptions model_;
  OutlineEncoder encoder_;
  Adam adam_;
};

}  // namespace antigrasp
