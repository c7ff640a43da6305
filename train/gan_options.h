#pragma once

#include <array>

#include "antigrasp/core/options.h"

namespace antigrasp {

// Under which symmetries of the cube the real shapes are shown (symmetries.h).
enum class Symmetries { kNone, kAroundZ, kAroundZAndUp };
constexpr auto ChoicesOf(Symmetries) {
  return std::to_array<Choice<Symmetries>>({{Symmetries::kNone, "none"},
                                            {Symmetries::kAroundZ, "around_z"},
                                            {Symmetries::kAroundZAndUp, "around_z_and_up"}});
}

// How batches are moved before the discriminator sees them (augment.h).
enum class Augmentation { kNone, kFlips, kShifts, kShiftsAndFlips };
constexpr auto ChoicesOf(Augmentation) {
  return std::to_array<Choice<Augmentation>>({{Augmentation::kNone, "none"},
                                              {Augmentation::kFlips, "flips"},
                                              {Augmentation::kShifts, "shifts"},
                                              {Augmentation::kShiftsAndFlips, "shifts_and_flips"}});
}

// What the networks are told of a batch (gan_losses.h).
enum class GanLoss { kHinge, kRelativistic };
constexpr auto ChoicesOf(GanLoss) {
  return std::to_array<Choice<GanLoss>>(
      {{GanLoss::kHinge, "hinge"}, {GanLoss::kRelativistic, "relativistic"}});
}

// How one GAN is trained.
struct GanOptions {
  GanLoss loss = GanLoss::kHinge;
  // Weight of the discriminator's squared slope at real and generated shapes (R1 and R2); 0 = none.
  // With it an update takes 1.6 to 1.8 times as long.
  double gradient_penalty = 0.0;
  int batch = 32;
  // A batch is computed in this many parts, each with its own batch statistics and random numbers,
  // whose gradients are added in one order: the same bytes for any number of processes that share
  // them. 0 = in one piece, by one process.
  int micro_batches = 0;
  int discriminator_steps = 1;
  bool cuda_graphs = false;  // steps on a GPU are recorded and replayed (captured_gradients.h)
  double learning_rate_g = 4e-4;
  double learning_rate_d = 4e-4;
  // The discriminator is not updated where its loss is below this: one that is sure of everything
  // has little to teach (3D-GAN, Wu et al., NeurIPS 2016). 0 = always updated; 2 is chance.
  double rest_below = 0.0;
  double later_rate = 1.0;  // learning rates after episode 0, relative to these
  double beta1 = 0.0;
  double beta2 = 0.9;
  double lr_decay_fraction =
      0.25;  // last share of an episode in which the rate falls to 0; 0 = none
  // The same random shift or mirror for all shapes of a batch that the discriminator sees, real and
  // generated, so that it cannot learn the set by heart (DiffAugment, Zhao et al., NeurIPS 2020).
  Augmentation augment = Augmentation::kNone;
  Symmetries symmetries = Symmetries::kNone;
  // Samples are drawn with few bends (models/few_bends.h): weight and power; weight 0 = as drawn.
  double fairing = 0.0;
  double fairing_power = 0.3;
  // Of the updates of new networks of turned solids the first, in which an encoder is fitted to the
  // set (outline_fit.h); the others learn the numbers that it gives.
  double fit_share = 0.3;
  double ema = 0.0;  // decay of the averaged generator; 0 = 1 - 4 / iterations, in [0.9, 0.999]
};

void Bind(OptionTable* table, GanOptions* options);  // keys "gan.*"

}  // namespace antigrasp
