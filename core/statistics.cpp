#include "antigrasp/core/statistics.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "antigrasp/core/check.h"

namespace antigrasp {
namespace {

// Zero-based position of the discrete percentile in a sorted sample of n.
std::size_t PercentileRank(std::size_t n, double percent) {
  const double rank = std::ceil(percent / 100.0 * static_cast<double>(n)) - 1.0;
  return static_cast<std::size_t>(std::clamp(rank, 0.0, static_cast<double>(n - 1)));
}

std::vector<double> LogFactorials(std::size_t n) {
  std::vector<double> logs(n + 1, 0.0);
  for (std::size_t k = 2; k <= n; ++k) logs[k] = logs[k - 1] + std::log(static_cast<double>(k));
  return logs;
}

// The probability of at least `at_least` successes in n trials, n from the table's size.
double BinomialTail(const std::vector<double>& log_factorials, std::size_t at_least, double p) {
  if (p >= 1.0) return 1.0;
  const std::size_t n = log_factorials.size() - 1;
  const double log_p = std::log(p), log_q = std::log1p(-p);
  double sum = 0.0;
  for (std::size_t k = at_least; k <= n; ++k) {
    sum += std::exp(log_factorials[n] - log_factorials[k] - log_factorials[n - k] +
                    static_cast<double>(k) * log_p + static_cast<double>(n - k) * log_q);
  }
  return sum;
}

}  // namespace

std::string MeanText(const MeanInterval& mean, int decimals) {
  if (!std::isfinite(mean.mean)) return "-";
  char text[64];
  std::snprintf(text, sizeof text, std::isfinite(mean.half_width) ? "%.*f +-%.*f" : "%.*f",
                decimals, mean.mean, decimals, mean.half_width);
  return text;
}

double DiscretePercentile(std::vector<double> values, double percent) {
  AG_CHECK(!values.empty(), "the percentile of an empty sample is not defined");
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(PercentileRank(values.size(), percent));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

Interval BootstrapPercentile(std::vector<double> values, double percent) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const std::size_t at_least = PercentileRank(values.size(), percent) + 1;
  const std::vector<double> log_factorials = LogFactorials(values.size());
  // The smallest value that the resampled percentile does not exceed with this probability.
  const auto quantile = [&](double probability) {
    std::size_t low = 0, high = values.size() - 1;
    while (low < high) {
      const std::size_t middle = (low + high) / 2;
      const double p = static_cast<double>(middle + 1) / static_cast<double>(values.size());
      if (BinomialTail(log_factorials, at_least, p) >= probability) {
        high = middle;
      } else {
        low = middle + 1;
      }
    }
    return values[low];
  };
  return {quantile(0.025), quantile(0.975)};
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
