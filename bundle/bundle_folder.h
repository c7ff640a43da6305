#pragma once

#include <functional>
#include <string>
#include <vector>

#include "antigrasp/bundle/bundle_options.h"
#include "antigrasp/core/observer.h"
#include "antigrasp/mesh/length_unit.h"

namespace antigrasp {

struct BundleRequest {
  std::vector<std::string> inputs;
  std::string out;
  BundleTarget target = BundleTarget::kAll;
  ObjectScale scale = ObjectScale::kMinExtent;
  LengthUnit units = LengthUnit::kM;  // of meshes that keep their size
  std::string gripper;                // a name or a file; objects that are wider are left out
  bool overwrite = false;
  int threads = 0;
  BundleOptions options;
};

struct BundleReport {
  std::string text;                   // a line or two for people
  std::vector<std::string> warnings;  // one for every object that was left out or repaired
};

// A folder an object in the folder `out`, and bundle.csv there (docs/bundles.md). Streams objects;
// same bytes for any number of threads. InputError when no object is a solid.
BundleReport WriteBundles(const BundleRequest& request, RunObserver* observer);

}  // namespace antigrasp
