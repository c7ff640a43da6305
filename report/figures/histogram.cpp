#include "antigrasp/report/figures/histogram.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "antigrasp/core/check.h"

namespace antigrasp {

int Histogram::Total() const { return std::accumulate(counts.begin(), counts.end(), 0); }

double Histogram::Share(int bin) const {
  const int total = Total();
  return total > 0 ? static_cast<double>(counts[static_cast<std::size_t>(bin)]) / total : 0.0;
}

double Histogram::LargestShare() const {
  double largest = 0.0;
  for (int k = 0; k < static_cast<int>(counts.size()); ++k) largest = std::max(largest, Share(k));
  return largest;
}

double Histogram::Edge(int bin) const {
  return low + (high - low) * bin / static_cast<double>(counts.size());
}

Histogram MakeHistogram(const std::vector<double>& values, double low, double high, int bins) {
  AG_CHECK(bins > 0 && low < high && std::isfinite(high - low), "bins over a finite range");
  Histogram histogram{low, high, std::vector<int>(static_cast<std::size_t>(bins)), 0};
  for (const double value : values) {
    if (std::isnan(value)) {
      ++histogram.left_out;
      continue;
    }
    const double at = std::floor((value - low) / (high - low) * bins);
    ++histogram.counts[static_cast<std::size_t>(std::clamp(at, 0.0, bins - 1.0))];
  }
  return histogram;
}

std::vector<double> Divided(std::vector<double> values, double divisor) {
  for (double& value : values) value /= divisor;
  return values;
}

}  // namespace antigrasp
