#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "antigrasp/core/observer.h"
#include "antigrasp/datasets/shape_set.h"
#include "antigrasp/train/run_config.h"
#include "antigrasp/train/sample_name.h"
#include "antigrasp/train/shape_model.h"

namespace antigrasp {

struct SampleRequest {
  std::string networks;  // checkpoint, folder of a run, or name of pretrained networks
  std::string out;       // SDF file
  int count = 64;
  std::uint64_t seed = 1;  // of the latent vectors
  std::string device = "cpu";
  int threads = 0;       // 0 = all
  bool unmoved = false;  // the same z without the moves of cem.part_step: each sample's own pair
  double fairing = -1.0, fairing_power = -1.0;  // below 0: the networks' own (GanOptions)
};

// Networks that draw samples.
class SampledNetworks {
 public:
  // Of the request's networks, on its device, with its fairing. InputError for what are none, and
  // for `unmoved` where nothing was moved.
  explicit SampledNetworks(const SampleRequest& request);

  const std::filesystem::path& path() const { return path_; }  // where they were found
  const RunConfig& config() const { return config_; }
  // A set of their samples without names and grids.
  ShapeSet About(std::uint64_t seed) const;
  // Samples first to first + count - 1, whose names are SampleName(i).
  std::vector<SdfGrid> Sample(std::uint64_t seed, std::int64_t first, std::int64_t count);

 private:
  std::filesystem::path path_;
  RunConfig config_;
  bool unmoved_;
  std::unique_ptr<ShapeModel> model_;
};

// The samples 0 to count - 1 of networks as an SDF file; where the networks were found. Sample by
// sample: memory does not grow with the count. InputError for networks that are none and a file
// that cannot be written or is read.
std::filesystem::path WriteSamples(const SampleRequest& request, RunObserver* observer);

}  // namespace antigrasp
