#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "antigrasp/quality/metric_options.h"

// Graspabilities of sets that anyone can make again, to set another one beside them. Written by
// scripts/known_scores.py, which says how.
namespace antigrasp {

struct KnownSet {
  std::string_view preset,
      name;                    // "default", "cylinders" or, of a network, "cylinders-adversarial"
  std::vector<double> scores;  // ascending, each of one object on kGraspsOfFew grasps
};

// The sets scored at these constants: how many grasps and candidates a score took does not matter,
// every other constant does. Empty when there are none.
std::vector<const KnownSet*> KnownSetsAt(const MetricOptions& options);

// The share of a set that is harder to grasp, 0 to 1; of equal scores half.
double ShareBelow(double graspability, const KnownSet& set);

}  // namespace antigrasp
