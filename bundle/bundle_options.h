#pragma once

#include <array>

#include "antigrasp/core/choice.h"
#include "antigrasp/core/options.h"

namespace antigrasp {

// What a bundle is for.
enum class BundleTarget { kAll, kMujoco, kUrdf, kSdformat, kUsd };
constexpr bool IsFor(BundleTarget asked, BundleTarget one) {
  return asked == one || asked == BundleTarget::kAll;
}
constexpr auto ChoicesOf(BundleTarget) {
  return std::to_array<Choice<BundleTarget>>({{BundleTarget::kAll, "all"},
                                              {BundleTarget::kMujoco, "mujoco"},
                                              {BundleTarget::kUrdf, "urdf"},
                                              {BundleTarget::kSdformat, "sdformat"},
                                              {BundleTarget::kUsd, "usd"}});
}

// How large an object is made.
enum class ObjectScale {
  kMinExtent,  // smallest extent of the bounding box, as the metric has it
  kEgad,  // longest side of the oriented box as wide as the gripper opens, then smaller until the
          // shortest is at most 0.8 of that (EGAD's prepare_meshes.py)
  kTrue   // as it is
};
constexpr auto ChoicesOf(ObjectScale) {
  return std::to_array<Choice<ObjectScale>>({{ObjectScale::kMinExtent, "min-extent"},
                                             {ObjectScale::kEgad, "egad"},
                                             {ObjectScale::kTrue, "true"}});
}

// SI units throughout.
struct BundleOptions {
  int parts = 32;  // convex ones, at most
  double density = 1000.0;
  double mass = 0.0;      // of every object; 0: by the density
  double friction = 0.5;  // of a pair with the object
  double min_extent = 0.040;
};
inline constexpr int kMostParts = 100;  // two digits in their names

void Bind(OptionTable* table, BundleOptions* options);  // keys "bundle.*"

}  // namespace antigrasp
