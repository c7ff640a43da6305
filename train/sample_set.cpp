#include "antigrasp/train/sample_set.h"

#include <torch/types.h>

#include <algorithm>
#include <string>

#include "antigrasp/datasets/shape_set.h"
#include "antigrasp/models/sdf_values.h"
#include "antigrasp/train/sample_name.h"
#include "antigrasp/train/stage.h"

namespace antigrasp {

void WriteSamples(const std::filesystem::path& out, ShapeModel* model, const ModelOptions& options,
                  const std::string& origin, std::uint64_t seed, int count,
                  const ProgressFn& progress) {
  ShapeSet set;
  set.kind = "samples";
  set.seed = seed;
  set.truncation = LargestDistance(options);
  set.provenance = "antigrasp sample " + origin + ", episode " + std::to_string(model->episode()) +
                   ", update " + std::to_string(model->step());
  ShapeSetWriter writer(out, set, static_cast<std::size_t>(count));
  constexpr int kChunk = 64;
  for (int first = 0; first < count; first += kChunk) {
    const torch::Tensor values = model->Sample(seed, first, std::min(kChunk, count - first));
    for (std::int64_t i = 0; i < values.size(0); ++i) {
      writer.Add(SampleName(first + i), GridOf(values[i], options));
    }
    progress(std::min(first + kChunk, count), count);
  }
  writer.Commit();
}

}  // namespace antigrasp
