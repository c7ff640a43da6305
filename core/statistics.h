#pragma once

#include <string>
#include <vector>

namespace antigrasp {

// Mean over objects with its 95 % interval (normal approximation, standard error over objects).
// NaN values are left out. The mean of nothing and the interval of fewer than two values are NaN.
struct MeanInterval {
  double mean = 0.0;
  double half_width = 0.0;
  int count = 0;
};
MeanInterval MeanWithInterval(const std::vector<double>& values);
// "0.72 +-0.05" with so many decimals; without the interval, or "-", where there is none.
std::string MeanText(const MeanInterval& mean, int decimals);

// The smallest value v with at least percent/100 of the sample <= v... of a non-empty sample:
// sorted[ceil(percent/100 * n) - 1], the discrete percentile of III-B.
double DiscretePercentile(std::vector<double> values, double percent);

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

// The same of DiscretePercentile(a) - DiscretePercentile(b), both resampled apart. Draws that both
// samples share make the true interval narrower than this one. {0, 0} of an empty sample.
Interval BootstrapPercentileDifference(std::vector<double> a, std::vector<double> b,
                                       double percent);

// Wilson's 95 % score interval of a share of so many independent trials: within 0 and 1, and no
// point at 0 or 1.
Interval WilsonInterval(double share, double count);

}  // namespace antigrasp
