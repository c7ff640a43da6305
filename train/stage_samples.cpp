#include "antigrasp/train/stage_samples.h"

#include <torch/types.h>

#include <map>

#include "antigrasp/checkpoints/checkpoint.h"
#include "antigrasp/core/error.h"
#include "antigrasp/train/averaged_generator.h"
#include "antigrasp/train/run_output.h"

namespace antigrasp {
namespace {

torch::Tensor PriorValues(const RunFolder& run, const RunConfig& config,
                          const std::vector<std::int64_t>& indices) {
  ShapeSet set = ReadShapeSet(run.Prior());
  ShapeSet chosen;
  for (const std::int64_t i : indices) {
    if (i < 0 || i >= static_cast<std::int64_t>(set.grids.size())) {
      throw InputError("no shape " + std::to_string(i), run.Prior().string(),
                       "one of " + std::to_string(set.grids.size()));
    }
    chosen.grids.push_back(set.grids[static_cast<std::size_t>(i)]);
  }
  return NetworkValuesOf(chosen, config.model, run.Prior().string());
}

torch::Tensor SampledValues(const RunFolder& run, RunConfig config, int stage,
                            const std::vector<std::int64_t>& indices, const ProgressFn& progress,
                            const ShapeModelMaker& make) {
  config.device = "cpu";
  const std::unique_ptr<ShapeModel> model = make(config);
  const auto path = run.EpisodeCheckpoint(stage);
  model->LoadNetworks(ReadCheckpoint(path).networks, path.string());
  // The GAN's generator draws whole blocks, so every block is asked for once.
  std::map<std::int64_t, std::vector<std::size_t>> places;  // of the wanted samples of a block
  for (std::size_t j = 0; j < indices.size(); ++j) {
    if (indices[j] < 0) {
      throw InputError("sample " + std::to_string(indices[j]), run.root.string(), "0 or more");
    }
    places[indices[j] / kSampleBlock].push_back(j);
  }
  std::vector<torch::Tensor> values(indices.size());
  std::int64_t drawn = 0;
  for (const auto& [block, wanted] : places) {
    const torch::Tensor samples =
        model->Sample(StageSeed(config, stage), block * kSampleBlock, kSampleBlock);
    for (const std::size_t j : wanted) values[j] = samples[indices[j] % kSampleBlock];
    drawn += std::ssize(wanted);
    if (progress) progress(drawn, std::ssize(indices));
  }
  return torch::stack(values);
}

}  // namespace

torch::Tensor StageValues(const RunFolder& run, const RunConfig& config, int stage,
                          const std::vector<std::int64_t>& indices, const ProgressFn& progress,
                          const ShapeModelMaker& make) {
  if (indices.empty()) {
    const std::int64_t n = config.model.resolution;
    return torch::empty({0, 1, n, n, n});
  }
  return stage < 0 ? PriorValues(run, config, indices)
                   : SampledValues(run, config, stage, indices, progress, make);
}

ScoredStage StageSamples(const RunFolder& run, const RunConfig& config, int stage,
                         const std::vector<std::int64_t>& indices, RunObserver* observer,
                         const ShapeModelMaker& make) {
  const torch::Tensor values =
      StageValues(run, config, stage, indices, observer->Phase(StageName(stage, "sampling")), make);
  return ScoreSamples(values, indices, config, observer->Phase(StageName(stage, "scoring")));
}

}  // namespace antigrasp
