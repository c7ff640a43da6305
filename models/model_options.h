#pragma once

#include <array>

#include "antigrasp/core/options.h"

namespace antigrasp {

enum class ModelKind { kSngan, kSolids };
constexpr auto ChoicesOf(ModelKind) {
  return std::to_array<Choice<ModelKind>>(
      {{ModelKind::kSngan, "sngan"}, {ModelKind::kSolids, "solids"}});
}

// What a solid is made of: kBoxes and kCylinders are unions of parts that begin as these and may
// become all else that solid_field.h has; kTurned is one piece, as made on a lathe, whose parts are
// frusta on each other (turned_outline.h).
enum class PartForm { kBoxes, kCylinders, kTurned };
constexpr auto ChoicesOf(PartForm) {
  return std::to_array<Choice<PartForm>>({{PartForm::kBoxes, "boxes"},
                                          {PartForm::kCylinders, "cylinders"},
                                          {PartForm::kTurned, "turned"}});
}

enum class PackAt { kInput, kFeatures };
constexpr auto ChoicesOf(PackAt) {
  return std::to_array<Choice<PackAt>>(
      {{PackAt::kInput, "input"}, {PackAt::kFeatures, "features"}});
}

enum class Block { kPlain, kResidual, kResidualGenerator };
constexpr auto ChoicesOf(Block) {
  return std::to_array<Choice<Block>>({{Block::kPlain, "plain"},
                                       {Block::kResidual, "residual"},
                                       {Block::kResidualGenerator, "residual_generator"}});
}

enum class Squash { kClamp, kTanh };
constexpr auto ChoicesOf(Squash) {
  return std::to_array<Choice<Squash>>({{Squash::kClamp, "clamp"}, {Squash::kTanh, "tanh"}});
}

enum class Precision { kFloat32, kBfloat16 };
constexpr auto ChoicesOf(Precision) {
  return std::to_array<Choice<Precision>>(
      {{Precision::kFloat32, "float32"}, {Precision::kBfloat16, "bfloat16"}});
}

// Shape of the two networks. Everything a checkpoint needs to rebuild them.
struct ModelOptions {
  // kSngan: the paper's transposed convolutions; kSolids: a union of prisms, cylinders and cones
  // whose measures are drawn (solid_generator.h).
  ModelKind kind = ModelKind::kSngan;
  int parts = 6;                     // of a solid
  PartForm form = PartForm::kBoxes;  // of its parts
  int width = 8;                     // c: channels of the generator's last hidden layer
  int latent = 200;                  // z in R^200 (paper V-A)
  int resolution = 32;               // nodes along a side: 16, 32, 64 or 128
  bool spectral_norm = true;         // on the discriminator; off reproduces VI-D
  // Shapes that the discriminator judges together, as channels of one input (PacGAN, Lin et al.,
  // NeurIPS 2018): a generator that repeats itself is found out. 1 = the paper.
  int pack = 1;
  // Where the shapes of a pack meet: kInput as channels of the first layer (PacGAN), kFeatures as
  // the deviation over the pack of every feature at 4^3 (Karras et al., ICLR 2018, per channel).
  PackAt pack_at = PackAt::kInput;
  int width_d = 0;  // of the discriminator; 0 = width
  // kResidual: a 3^3 convolution beside every resolution but 2^3, in both networks;
  // kResidualGenerator: in the generator alone.
  Block block = Block::kPlain;
  bool batch_norm = true;   // in the generator
  bool output_blur = true;  // [1 2 1]/4 before tanh
  // The discriminator sees x - edge_gain * Laplacian(x), by nodes: creases and bumps stand out that
  // its bounded slope would overlook (folding.h). 0 = x itself, as in the paper.
  double edge_gain = 0.0;
  // How far into shapes the discriminator sees: it is shown every distance inside as at most this,
  // unit cube. Deeper, distances of a union are not those of a mesh (solid_field.h). 0 = all.
  double depth = 0.0;
  // kClamp: v = clamp(d / truncation, -1, 1); kTanh: v = tanh(d / truncation), no kink.
  Squash squash = Squash::kClamp;
  // A network value v stands for the distance truncation * v, clamped; 0 = raw distances times
  // raw_scale.
  double truncation = 0.1;
  double raw_scale = 1.0;
  // In which the convolutions with stride multiply; sums, weights and all else stay float32.
  // kBfloat16 is for CUDA: CPUs are twice as fast with float32, those with AVX512_BF16 included
  // (docs/performance.md).
  Precision precision = Precision::kFloat32;
};

void Bind(OptionTable* table, ModelOptions* options);  // keys "model.*"

// InputError naming `origin` for a resolution that is no power of two: every layer halves or
// doubles it.
void CheckResolution(const ModelOptions& options, const std::string& origin);

// Layers between 2^3 and half the resolution: 3 at 32^3. AG_CHECKs the resolution.
int HiddenLevels(const ModelOptions& options);

}  // namespace antigrasp
