#pragma once

#include <torch/types.h>

#include <cstdint>

#include "antigrasp/core/rng.h"
#include "antigrasp/models/shape_discriminator.h"
#include "antigrasp/models/shape_generator.h"
#include "antigrasp/train/flat_gradients.h"
#include "antigrasp/train/gan_options.h"

namespace antigrasp {

// A batch, or a part of one: which random numbers, what was drawn with them, what was generated.
struct GanPart {
  RngStream rng;         // of the augmentation once real and z are drawn
  torch::Tensor real;    // what is judged of shapes of the set
  torch::Tensor z;       // [n, latent]
  torch::Tensor fake{};  // the same of n generated ones; with a graph where gradients are on
};

// The two losses of a part of a batch and their gradients. Refers to the networks, which its
// owner keeps and changes.
class GanGradients {
 public:
  GanGradients(const ModelOptions& model, const GanOptions& options, ShapeGenerator* generator,
               ShapeDiscriminator* discriminator, torch::Device device);

  // As many of `shapes` [N, 1, r, r, r], network values, as a part has, each under a symmetry.
  torch::Tensor RandomShapes(const torch::Tensor& shapes, RngStream* rng) const;

  // What is real and z of a part.
  void Draw(const torch::Tensor& shapes, GanPart* part) const;

  // By the discriminator's parameters. Leaves in the part what was generated.
  LossAndGradients OfDiscriminator(GanPart* part);

  // By the generator's, on what is in the part.
  LossAndGradients OfGenerator(GanPart* part);

 private:
  torch::Tensor Seen(const torch::Tensor& shapes, GanPart* part) const;

  GanOptions options_;
  std::int64_t latent_, size_;  // of a part
  torch::Device device_;
  ShapeGenerator* generator_;
  ShapeDiscriminator* discriminator_;
  std::vector<torch::Tensor> generator_parameters_, discriminator_parameters_;
};

}  // namespace antigrasp
