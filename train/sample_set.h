#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "antigrasp/core/observer.h"

namespace antigrasp {

struct SampleRequest {
  std::string networks;  // checkpoint, folder of a run, or name of pretrained networks
  std::string out;       // SDF file
  int count = 64;
  std::uint64_t seed = 1;  // of the latent vectors
  std::string device = "cpu";
  int threads = 0;                              // 0 = all
  double fairing = -1.0, fairing_power = -1.0;  // below 0: the networks' own (GanOptions)
};

// The samples 0 to count - 1 of networks as an SDF file; where the networks were found. Sample by
// sample: memory does not grow with the count. InputError for networks that are none and a file
// that cannot be written or is read.
std::filesystem::path WriteSamples(const SampleRequest& request, RunObserver* observer);

}  // namespace antigrasp
