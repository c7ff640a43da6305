#include <algorithm>
#include <cmath>
#include <limits>

#include "antigrasp/core/check.h"
#include "antigrasp/quality/bootstrap.h"
#include "antigrasp/quality/graspability.h"

namespace antigrasp {
namespace {

// Zero-based position of the discrete percentile in a sorted sample of n.
std::size_t PercentileRank(std::size_t n, double percent) {
  const double rank = std::ceil(percent / 100.0 * static_cast<double>(n)) - 1.0;
  return static_cast<std::size_t>(std::clamp(rank, 0.0, static_cast<double>(n - 1)));
}

}  // namespace

double DiscretePercentile(std::vector<double> values, double percent) {
  AG_CHECK(!values.empty(), "the percentile of an empty sample is not defined");
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(PercentileRank(values.size(), percent));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

Interval BootstrapPercentile(std::vector<double> values, double percent, int resamples,
                             RngStream* rng) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const std::size_t rank = PercentileRank(values.size(), percent);
  if (resamples <= 0) return {values[rank], values[rank]};
  std::vector<double> estimates;
  estimates.reserve(static_cast<std::size_t>(resamples));
  std::vector<std::uint32_t> counts(values.size());
  for (int i = 0; i < resamples; ++i) {
    // Counting how often each sorted value was drawn gives the percentile without a sort.
    std::fill(counts.begin(), counts.end(), 0u);
    for (std::size_t k = 0; k < values.size(); ++k) ++counts[rng->Below(values.size())];
    std::size_t at = 0;
    for (std::size_t below = counts[0]; below <= rank; below += counts[at]) ++at;
    estimates.push_back(values[at]);
  }
  return {DiscretePercentile(estimates, 2.5), DiscretePercentile(estimates, 97.5)};
}

MeanInterval MeanWithInterval(const std::vector<double>& values) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  MeanInterval result;
  double sum = 0.0;
  for (const double value : values) {
    if (std::isnan(value)) continue;
    sum += value;
    ++result.count;
  }
  if (result.count == 0) return {kNan, kNan, 0};
  result.mean = sum / result.count;
  if (result.count == 1) {
    result.half_width = kNan;  // one object says nothing about the spread
    return result;
  }
  double squares = 0.0;
  for (const double value : values) {
    if (!std::isnan(value)) squares += (value - result.mean) * (value - result.mean);
  }
  result.half_width = 1.96 * std::sqrt(squares / (result.count - 1) / result.count);
  return result;
}

}  // namespace antigrasp
