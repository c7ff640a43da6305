#include "antigrasp/train/gan_options.h"

#include <gtest/gtest.h>

#include "antigrasp/core/error.h"

namespace antigrasp {
namespace {

TEST(GanOptions, EachNameSetsItsOwnField) {
  GanOptions options;
  OptionTable table;
  Bind(&table, &options);
  for (const char* setting :
       {"gan.batch=16", "gan.discriminator_steps=7", "gan.learning_rate_g=0.01",
        "gan.learning_rate_d=0.02", "gan.later_rate=0.03", "gan.beta1=0.04", "gan.beta2=0.05",
        "gan.lr_decay_fraction=0.06", "gan.symmetries=\"around_z\"", "gan.augment=\"flips\"",
        "gan.ema=0.07", "gan.rest_below=0.08", "gan.fairing=0.09", "gan.fairing_power=0.1",
        "gan.micro_batches=3", "gan.loss=\"relativistic\"", "gan.gradient_penalty=0.11",
        "gan.cuda_graphs=true", "gan.fit_share=0.12"}) {
    table.ApplyOverride(setting);
  }
  EXPECT_EQ(options.batch, 16);
  EXPECT_EQ(options.discriminator_steps, 7);
  EXPECT_EQ(options.learning_rate_g, 0.01);
  EXPECT_EQ(options.learning_rate_d, 0.02);
  EXPECT_EQ(options.later_rate, 0.03);
  EXPECT_EQ(options.beta1, 0.04);
  EXPECT_EQ(options.beta2, 0.05);
  EXPECT_EQ(options.lr_decay_fraction, 0.06);
  EXPECT_EQ(options.symmetries, Symmetries::kAroundZ);
  EXPECT_EQ(options.augment, Augmentation::kFlips);
  EXPECT_EQ(options.ema, 0.07);
  EXPECT_EQ(options.rest_below, 0.08);
  EXPECT_EQ(options.fairing, 0.09);
  EXPECT_EQ(options.fairing_power, 0.1);
  EXPECT_EQ(options.micro_batches, 3);
  EXPECT_EQ(options.loss, GanLoss::kRelativistic);
  EXPECT_EQ(options.gradient_penalty, 0.11);
  EXPECT_TRUE(options.cuda_graphs);
  EXPECT_EQ(options.fit_share, 0.12);
  EXPECT_EQ(table.options().size(), 19U);
}

TEST(GanOptions, RefuseValuesOutOfRange) {
  GanOptions options;
  OptionTable table;
  Bind(&table, &options);
  for (const char* setting :
       {"gan.batch=1", "gan.discriminator_steps=0", "gan.learning_rate_g=1.01",
        "gan.learning_rate_d=-0.01", "gan.later_rate=1.01", "gan.beta1=1", "gan.beta2=1",
        "gan.lr_decay_fraction=1.01", "gan.symmetries=\"around_x\"", "gan.augment=\"all\"",
        "gan.ema=1", "gan.rest_below=2.01", "gan.fairing=-1", "gan.fairing_power=0",
        "gan.micro_batches=-1", "gan.loss=\"wasserstein\"", "gan.gradient_penalty=-1",
        "gan.fit_share=0.61"}) {
    EXPECT_THROW(table.ApplyOverride(setting), InputError) << setting;
  }
}

}  // namespace
}  // namespace antigrasp
