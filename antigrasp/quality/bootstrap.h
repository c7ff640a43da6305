#pragma once

#include <vector>

namespace antigrasp {

struct Interval {
  double low = 0.0;
  double high = 0.0;
};

// The 95 % percentile-bootstrap interval of DiscretePercentile(values, percent), exact: what
// infinitely many resamples with replacement would give. The resampled percentile of rank r is at
// most the j-th smallest value exactly when at least r of n draws are, each with probability j / n:
// a binomial tail (Hutson and Ernst 2000, "The exact bootstrap mean and variance of an
// L-estimator"). n log n; no random numbers.
Interval BootstrapPercentile(std::vector<double> values, double percent);

}  // namespace antigrasp
