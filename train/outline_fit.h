#pragma once

#include <torch/types.h>

#include <cstdint>

#include "antigrasp/core/rng.h"
#include "antigrasp/models/outline_encoder.h"
#include "antigrasp/models/solid_generator.h"
#include "antigrasp/train/adam.h"

namespace antigrasp {

// Fits the encoder of outlines to a set before networks learn what it says: of shapes of the set
// the numbers whose turned solids are these, by the squares of what their network values,
// sharpened by model.edge_gain, differ by. The encoder is one network for all shapes, so that like
// shapes have like numbers; numbers found for each alone would not.
class OutlineFit {
 public:
  OutlineFit(const ModelOptions& model, const OutlineEncoder& encoder);

  // One update with `batch` [N, 1, r, r, r], network values on the encoder's device, drawn by
  // `generator`; `left` in (0, 1] is the share of the fit that is still to come. -> root of the
  // mean over shapes of the squared differences of a half plane's nodes.
  double Update(const torch::Tensor& batch, SolidGeneratorImpl* generator, double left);

  void Restart() { adam_.Restart(); }
  const Adam& adam() const { return adam_; }
  OutlineEncoder& encoder() { return encoder_; }

 private:
  ModelOptions model_;
  OutlineEncoder encoder_;
  Adam adam_;
};

}  // namespace antigrasp
