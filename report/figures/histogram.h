#pragma once

#include <vector>

namespace antigrasp {

// Equal bins over [low, high]; bin k holds [low + k width, low + (k + 1) width), the last one
// `high`, too. What lies outside is counted in the bin at that end; NaN is left out and counted.
struct Histogram {
  double low = 0.0, high = 1.0;
  std::vector<int> counts;
  int left_out = 0;  // NaN

  int Total() const;            // of the bins
  double Share(int bin) const;  // of the total; 0 when that is 0
  double LargestShare() const;
  double Edge(int bin) const;  // the lower edge of a bin; the upper one of the last for bin = size
};

// CHECK: bins > 0 and low < high, finite.
Histogram MakeHistogram(const std::vector<double>& values, double low, double high, int bins);

// values / divisor.
std::vector<double> Divided(std::vector<double> values, double divisor);

}  // namespace antigrasp
