#pragma once

#include <cstdint>
#include <filesystem>

#include "antigrasp/core/parallel.h"
#include "antigrasp/train/make_gan.h"

namespace antigrasp {

// The samples 0 to count - 1 of networks as an SDF file; `origin`: where these came from. Sample by
// sample: memory does not grow with the count.
void WriteSamples(const std::filesystem::path& out, ShapeModel* model, const ModelOptions& options,
                  const std::string& origin, std::uint64_t seed, int count,
                  const ProgressFn& progress);

}  // namespace antigrasp
