#include "antigrasp/train/share_networks.h"

#include <torch/types.h>

#include <utility>

#include "antigrasp/core/error.h"
#include "antigrasp/train/make_gan.h"

namespace antigrasp {
namespace {

void CheckThatItFolds(const ModelOptions& model, const std::string& origin) {
  if (model.kind != ModelKind::kSngan) {
    throw InputError("--fold-batch-norm: networks with model.kind = " + ChoiceName(model.kind),
                     origin, "those of model.kind = sngan, which have batch normalisation");
  }
  if (model.batch_norm && model.block == Block::kPlain) return;
  throw InputError("--fold-batch-norm: networks with model.batch_norm = " +
                       std::string(model.batch_norm ? "true" : "false") +
                       ", model.block = " + ChoiceName(model.block),
                   origin, "batch normalisation and plain blocks");
}

}  // namespace

SharedNetworks NetworksToShare(Checkpoint checkpoint, const std::string& origin,
                               bool fold_batch_norm) {
  RunConfig config = NetworksFromToml(checkpoint.config, origin);
  config.device = "cpu";
  if (fold_batch_norm) CheckThatItFolds(config.model, origin);
  GanTrainer trainer = MakeTrainer(config);
  trainer.LoadNetworks(checkpoint.networks, origin);
  checkpoint.shapes = torch::empty({0}, torch::kHalf);
  checkpoint.losses = torch::empty({0, 0}, torch::kDouble);
  if (!fold_batch_norm) {
    checkpoint.networks = trainer.Networks();
    return {std::move(checkpoint), trainer.episode()};
  }
  config.model.batch_norm = false;
  checkpoint.config = ToToml(config);
  GanTrainer folded = MakeTrainer(config);
  folded.TakeFolded(&trainer);
  checkpoint.networks = folded.Networks();
  return {std::move(checkpoint), folded.episode()};
}

}  // namespace antigrasp
