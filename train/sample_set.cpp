#include "antigrasp/train/sample_set.h"

#include <torch/types.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "antigrasp/checkpoints/checkpoint.h"
#include "antigrasp/checkpoints/pretrained.h"
#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/format.h"
#include "antigrasp/models/sdf_values.h"
#include "antigrasp/train/make_gan.h"
#include "antigrasp/train/stage.h"

namespace antigrasp {

SampledNetworks::SampledNetworks(const SampleRequest& request) : unmoved_(request.unmoved) {
  if (std::isnan(request.fairing) || std::isnan(request.fairing_power)) {
    throw InputError("not a number", "--fairing, --fairing-power",
                     "a weight of at least 0, a power");
  }
  path_ = FindNetworks(request.networks);
  const Checkpoint checkpoint = ReadCheckpoint(path_);
  config_ = NetworksFromToml(checkpoint.config, path_.string());
  config_.device = request.device;
  config_.threads = request.threads;
  if (request.fairing >= 0.0) config_.gan.fairing = request.fairing;
  if (request.fairing_power > 0.0) config_.gan.fairing_power = request.fairing_power;
  model_ = MakeGan(config_);
  model_->LoadNetworks(checkpoint.networks, path_.string());
  if (unmoved_ && model_->latent().means.size(1) == config_.model.latent) {
    throw InputError("--unmoved, but no parts were moved", path_.string(),
                     "a later episode of a run with cem.part_step");
  }
}

ShapeSet SampledNetworks::About(std::uint64_t seed) const {
  ShapeSet set;
  set.kind = "samples";
  set.seed = seed;
  set.truncation = LargestDistance(config_.model);
  set.provenance = "antigrasp sample " + path_.string() + ", episode " +
                   std::to_string(model_->episode()) + ", update " + std::to_string(model_->step());
  if (config_.gan.fairing > 0.0) {
    set.provenance += ", fairing " + FormatDouble(config_.gan.fairing) + ", power " +
                      FormatDouble(config_.gan.fairing_power);
  }
  if (unmoved_) set.provenance += ", unmoved";
  return set;
}

std::vector<SdfGrid> SampledNetworks::Sample(std::uint64_t seed, std::int64_t first,
                                             std::int64_t count) {
  const torch::Tensor values =
      unmoved_
          ? model_->Draw(model_->Latents(seed, first, count).narrow(1, 0, config_.model.latent))
          : model_->Sample(seed, first, count);
  std::vector<SdfGrid> grids;
  for (std::int64_t i = 0; i < values.size(0); ++i) {
    grids.push_back(GridOf(values[i], config_.model));
  }
  return grids;
}

std::filesystem::path WriteSamples(const SampleRequest& request, RunObserver* observer) {
  const std::filesystem::path path = FindNetworks(request.networks);
  RequireNotRead(path, {request.out});
  RequireShapeSetName(request.out);
  { const AtomicFile probe(request.out); }  // refuses an unwritable target before the work
  SampledNetworks networks(request);
  ShapeSetWriter writer(request.out, networks.About(request.seed),
                        static_cast<std::size_t>(request.count));
  const ProgressFn progress = observer->Phase("sampling");
  constexpr int kChunk = 64;
  for (int first = 0; first < request.count; first += kChunk) {
    const int count = std::min(kChunk, request.count - first);
    int number = first;
    for (const SdfGrid& grid : networks.Sample(request.seed, first, count)) {
      writer.Add(SampleName(number++), grid);
    }
    progress(first + count, request.count);
  }
  writer.Commit();
  return path;
}

}  // namespace antigrasp
