#include "antigrasp/train/share_networks.h"

#include <gtest/gtest.h>
#include <torch/types.h>

#include "antigrasp/core/error.h"
#include "antigrasp/train/make_gan.h"
#include "tests/train/tiny_run.h"

namespace antigrasp {
namespace {

Checkpoint RunOfSolids() {
  RunConfig config = shapes::Tiny();
  config.model.kind = ModelKind::kSolids;
  Checkpoint checkpoint;
  checkpoint.config = ToToml(config);
  checkpoint.networks = MakeTrainer(config).State();
  return checkpoint;
}

TEST(ShareNetworks, SolidsHaveNoBatchNormToFold) {
  try {
    NetworksToShare(RunOfSolids(), "x.pt", true);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("model.kind = solids"), std::string::npos);
  }
}

TEST(ShareNetworks, SolidsAreWrittenAloneAndSampledAsBefore) {
  const Checkpoint whole = RunOfSolids();
  const SharedNetworks alone = NetworksToShare(whole, "x.pt", false);
  const RunConfig config = NetworksFromToml(alone.checkpoint.config, "x.pt");
  EXPECT_EQ(config.model.kind, ModelKind::kSolids);
  GanTrainer before = MakeTrainer(config), after = MakeTrainer(config);
  before.LoadNetworks(whole.networks, "whole");
  after.LoadNetworks(alone.checkpoint.networks, "alone");
  const torch::Tensor a = before.Sample(1, 0, 2), b = after.Sample(1, 0, 2);
  EXPECT_LT((a - b).abs().max().item<double>(), 2e-2);  // float16
}

}  // namespace
}  // namespace antigrasp
