#include "antigrasp/core/statistics.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

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

struct Mass {
  double value, probability;
};

// What percentile a resample of the values has: one of them, each with a probability.
class ResampledPercentile {
 public:
  ResampledPercentile(std::vector<double> values, double percent)
      : values_(std::move(values)),
        at_least_(PercentileRank(values_.size(), percent) + 1),
        log_factorials_(LogFactorials(values_.size())) {
    std::sort(values_.begin(), values_.end());
  }

  const std::vector<double>& values() const { return values_; }

  // Of the smallest value that it does not exceed with this probability.
  std::size_t Place(double probability) const {
    std::size_t low = 0, high = values_.size() - 1;
    while (low < high) {
      const std::size_t middle = (low + high) / 2;
      if (AtMost(middle) >= probability) {
        high = middle;
      } else {
        low = middle + 1;
      }
    }
    return low;
  }

  // All values but those of no account, rising.
  std::vector<Mass> Masses() const {
    constexpr double kNoAccount = 1e-7;
    std::vector<Mass> masses;
    double below = 0.0;
    const std::size_t last = Place(1.0 - kNoAccount);
    for (std::size_t i = Place(kNoAccount); i <= last; ++i) {
      const double at_most = AtMost(i);
      masses.push_back({values_[i], at_most - below});
      below = at_most;
    }
    return masses;
  }

 private:
  double AtMost(std::size_t place) const {
    return BinomialTail(log_factorials_, at_least_,
                        static_cast<double>(place + 1) / static_cast<double>(values_.size()));
  }

  std::vector<double> values_;
  std::size_t at_least_;
  std::vector<double> log_factorials_;
};

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
  const ResampledPercentile resampled(std::move(values), percent);
  return {resampled.values()[resampled.Place(0.025)], resampled.values()[resampled.Place(0.975)]};
}

Interval BootstrapPercentileDifference(std::vector<double> a, std::vector<double> b,
                                       double percent) {
  if (a.empty() || b.empty()) return {};
  const std::vector<Mass> of_a = ResampledPercentile(std::move(a), percent).Masses(),
                          of_b = ResampledPercentile(std::move(b), percent).Masses();
  std::vector<Mass> differences;
  for (const Mass& first : of_a) {
    for (const Mass& second : of_b) {
      differences.push_back({first.value - second.value, first.probability * second.probability});
    }
  }
  std::sort(differences.begin(), differences.end(),
            [](const Mass& x, const Mass& y) { return x.value < y.value; });
  double below = 0.0;
  Interval interval{differences.back().value, differences.back().value};
  for (const Mass& difference : differences) {
    if (below < 0.025) interval.low = difference.value;
    if (below < 0.975) interval.high = difference.value;
    below += difference.probability;
  }
  return interval;
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

Interval WilsonInterval(double share, double count) {
  constexpr double z = 1.959963984540054;
  const double middle = share + z * z / (2.0 * count);
  const double half = z * std::sqrt((share * (1.0 - share) + z * z / (4.0 * count)) / count);
  const double scale = 1.0 + z * z / count;
  return {std::max(0.0, (middle - half) / scale), std::min(1.0, (middle + half) / scale)};
}

}  // namespace antigrasp
