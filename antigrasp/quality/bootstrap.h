#pragma once

#include <vector>

#include "antigrasp/core/rng.h"

namespace antigrasp {

struct Interval {
  double low = 0.0;
  double high = 0.0;
};

// The 95 % percentile-bootstrap interval of DiscretePercentile(values, percent): each resample
// draws values.size() of them with replacement. Without resamples (or values) both ends are the
// estimate.
Interval BootstrapPercentile(std::vector<double> values, double percent, int resamples,
                             RngStream* rng);

}  // namespace antigrasp
