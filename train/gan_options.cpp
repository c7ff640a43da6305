#include "antigrasp/train/gan_options.h"

namespace antigrasp {

void Bind(OptionTable* table, GanOptions* options) {
  table->Add("gan.loss", &options->loss,
             "hinge, or relativistic: scores of real and generated shapes in pairs");
  table->Add("gan.gradient_penalty", &options->gradient_penalty, 0, 1e6,
             "weight of the discriminator's squared slope at real and generated shapes (R1, R2); "
             "0 = none");
  table->Add("gan.batch", &options->batch, 2, 4096, "shapes in one update");
  table->Add("gan.micro_batches", &options->micro_batches, 0, 1024,
             "parts that a batch is computed in, which processes can share: the same bytes for any "
             "number of them; 0 = in one piece");
  table->Add("gan.discriminator_steps", &options->discriminator_steps, 1, 100,
             "discriminator updates for each generator update");
  table->Add(
      "gan.cuda_graphs", &options->cuda_graphs,
      "steps on a GPU are recorded once and replayed (LibTorch 2 for CUDA); written, not yet run");
  table->Add("gan.learning_rate_g", &options->learning_rate_g, 0, 1, "Adam's rate, generator");
  table->Add("gan.learning_rate_d", &options->learning_rate_d, 0, 1, "Adam's rate, discriminator");
  table->Add("gan.rest_below", &options->rest_below, 0, 2,
             "the discriminator is not updated while its loss is below this; 0 = always updated");
  table->Add("gan.later_rate", &options->later_rate, 0, 1,
             "learning rates after episode 0, relative to those of episode 0");
  table->Add("gan.beta1", &options->beta1, 0, 0.999999, "Adam's decay of the first moment");
  table->Add("gan.beta2", &options->beta2, 0, 0.999999, "Adam's decay of the second moment");
  table->Add("gan.lr_decay_fraction", &options->lr_decay_fraction, 0, 1,
             "last share of an episode in which the learning rates fall to 0; 0 = never");
  table->Add("gan.symmetries", &options->symmetries,
             "show each real shape under a random symmetry of the cube");
  table->Add("gan.augment", &options->augment,
             "show the discriminator every shape, real or generated, shifted or mirrored");
  table->Add(
      "gan.fairing", &options->fairing, 0, 1000,
      "samples get few bends in place of many, flat faces and creases: how much; 0 = as drawn");
  table->Add("gan.fairing_power", &options->fairing_power, 0.01, 1,
             "of a bend in that: 1 rounds creases off, small ones make few");
  table->Add("gan.fit_share", &options->fit_share, 0, 0.6,
             "of the updates of new networks of turned solids the first, at least one, in which "
             "outlines are fitted to the set; of other networks none");
  table->Add("gan.ema", &options->ema, 0, 0.999999,
             "decay per step of the averaged generator; 0 = 1 - 4 / iterations, in [0.9, 0.999]");
}

}  // namespace antigrasp
