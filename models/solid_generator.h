#pragma once

#include <torch/nn/modules/linear.h>

#include <vector>

#include "antigrasp/models/shape_generator.h"

namespace antigrasp {

// G : z -> the union of model.parts solids (solid_field.h), as CvxNet and BSP-Net make shapes of
// half-spaces (Deng et al.; Chen et al.; both CVPR 2020). Four linear layers, 32 model.width units
// wide, draw where each lies, how large it is and of what form: flat faces, straight edges and
// round walls are the form's, not learnt node by node. With model.form = "turned" they draw one
// outline of model.parts frusta instead (turned_outline.h). The bounding box is in the middle of
// the cube, as that of every set's shapes. No convolutions, batch norm or blur.
// In evaluation what does not hang together with the largest piece is left out (largest_piece.h).
class SolidGeneratorImpl : public ShapeGenerator {
 public:
  explicit SolidGeneratorImpl(const ModelOptions& options);  // weights of a fixed stream
  torch::Tensor forward(const torch::Tensor& z) override;
  torch::Tensor ForwardJudged(const torch::Tensor& z) override;
  std::int64_t PartNumbers() const override;

  // Fresh weights: parts of middle size about the centre, each z another union.
  void Initialize(RngStream* rng) override;

  // What is drawn: z [N, latent] or [N, latent + PartNumbers()] -> [N, parts, kPartColumns], usable
  // as SolidField takes them whatever is added.
  torch::Tensor Parts(const torch::Tensor& z);

  // The same of turned solids: outlines as TurnedField takes them.
  torch::Tensor Outlines(const torch::Tensor& z);

  // Network values [N, 1, r, r, r] of numbers [N, PartNumbers()], in evaluation too all of them.
  torch::Tensor OfNumbers(const torch::Tensor& numbers);

  // Of turned solids the layers draw standardised numbers: what these stand for, [PartNumbers()]
  // each. It is saved with the weights.
  void Standardise(const torch::Tensor& mean, const torch::Tensor& deviation);

 private:
  torch::Tensor Layers(const torch::Tensor& z);   // [N, PartNumbers()]
  torch::Tensor Numbers(const torch::Tensor& z);  // those that are meant, those behind z added
  bool IsTurned() const { return options_.form == PartForm::kTurned; }

  ModelOptions options_;
  torch::Tensor mean_, deviation_;  // buffers of turned solids
  std::vector<torch::nn::Linear> layers_;
};
TORCH_MODULE(SolidGenerator);

}  // namespace antigrasp
