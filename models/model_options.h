#pragma once

#include <string>

#include "antigrasp/core/options.h"

namespace antigrasp {

// Shape of the two networks. Everything a checkpoint needs to rebuild them.
struct ModelOptions {
  int width = 8;              // c: channels of the generator's last hidden layer at 16^3
  int latent = 200;           // z in R^200 (paper V-A)
  int resolution = 32;        // 32 only
  bool spectral_norm = true;  // on the discriminator; off reproduces VI-D
  // Shapes that the discriminator judges together, as channels of one input (PacGAN, Lin et al.,
  // NeurIPS 2018): a generator that repeats itself is found out. 1 = the paper.
  int pack = 1;
  // Where the shapes of a pack meet: "input" as channels of the first layer (PacGAN), "features" as
  // the deviation over the pack of every feature at 4^3 (Karras et al., ICLR 2018, per channel).
  std::string pack_at = "input";
  int width_d = 0;  // of the discriminator; 0 = width
  // "residual": a 3^3 convolution beside every resolution but 2^3, in both networks;
  // "residual_generator": in the generator alone.
  std::string block = "plain";
  bool batch_norm = true;   // in the generator
  bool output_blur = true;  // [1 2 1]/4 before tanh
  // The discriminator sees x - edge_gain * Laplacian(x), by nodes: creases and bumps stand out that
  // its bounded slope would overlook (folding.h). 0 = x itself, as in the paper.
  double edge_gain = 0.0;
  // "clamp": v = clamp(d / truncation, -1, 1); "tanh": v = tanh(d / truncation), no kink.
  std::string squash = "clamp";
  // A network value v stands for the distance truncation * v, clamped; 0 = raw distances times
  // raw_scale.
  double truncation = 0.1;
  double raw_scale = 1.0;
  // In which the convolutions with stride multiply; sums, weights and all else stay float32.
  // "bfloat16" is for CUDA: CPUs are twice as fast with float32, those with AVX512_BF16 included
  // (docs/performance.md).
  std::string precision = "float32";
};

void Bind(OptionTable* table, ModelOptions* options);  // keys "model.*"

}  // namespace antigrasp
