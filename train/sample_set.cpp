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
#include "antigrasp/datasets/shape_set.h"
#include "antigrasp/models/sdf_values.h"
#include "antigrasp/train/make_gan.h"
#include "antigrasp/train/run_config.h"
#include "antigrasp/train/sample_name.h"
#include "antigrasp/train/stage.h"

namespace antigrasp {

std::filesystem::path WriteSamples(const SampleRequest& request, RunObserver* observer) {
  if (std::isnan(request.fairing) || std::isnan(request.fairing_power)) {
    throw InputError("not a number", "--fairing, --fairing-power",
                     "a weight of at least 0, a power");
  }
  const std::filesystem::path path = FindNetworks(request.networks);
  RequireNotRead(path, {request.out});
  RequireShapeSetName(request.out);
  { const AtomicFile probe(request.out); }  // refuses an unwritable target before the work
  const Checkpoint checkpoint = ReadCheckpoint(path);
  RunConfig config = NetworksFromToml(checkpoint.config, path.string());
  config.device = request.device;
  config.threads = request.threads;
  if (request.fairing >= 0.0) config.gan.fairing = request.fairing;
  if (request.fairing_power > 0.0) config.gan.fairing_power = request.fairing_power;
  const std::unique_ptr<ShapeModel> model = MakeGan(config);
  model->LoadNetworks(checkpoint.networks, path.string());

  ShapeSet set;
  set.kind = "samples";
  set.seed = request.seed;
  set.truncation = LargestDistance(config.model);
  set.provenance = "antigrasp sample " + path.string() + ", episode " +
                   std::to_string(model->episode()) + ", update " + std::to_string(model->step());
  if (config.gan.fairing > 0.0) {
    set.provenance += ", fairing " + FormatDouble(config.gan.fairing) + ", power " +
                      FormatDouble(config.gan.fairing_power);
  }
  ShapeSetWriter writer(request.out, set, static_cast<std::size_t>(request.count));
  const ProgressFn progress = observer->Phase("sampling");
  constexpr int kChunk = 64;
  for (int first = 0; first < request.count; first += kChunk) {
    const int count = std::min(kChunk, request.count - first);
    const torch::Tensor values = model->Sample(request.seed, first, count);
    for (std::int64_t i = 0; i < values.size(0); ++i) {
      writer.Add(SampleName(first + i), GridOf(values[i], config.model));
    }
    progress(first + count, request.count);
  }
  writer.Commit();
  return path;
}

}  // namespace antigrasp
