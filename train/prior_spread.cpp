#include "antigrasp/train/prior_spread.h"

#include <torch/utils.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "antigrasp/core/check.h"

namespace antigrasp {
namespace {

constexpr std::int64_t kSpreadRows = 256;

// The lowest value with this percentage of the values at or below it.
double PercentileOf(std::vector<double> values, double percentile) {
  const double rank = std::ceil(percentile / 100.0 * static_cast<double>(values.size()));
  const auto place = static_cast<std::ptrdiff_t>(std::max(rank, 1.0)) - 1;
  std::nth_element(values.begin(), values.begin() + place, values.end());
  return values[static_cast<std::size_t>(place)];
}

// Of every row of `values` to the nearest of `prior`; `own`: where values are the prior itself,
// whose rows are not their own neighbours.
std::vector<double> ToNearestRow(const torch::Tensor& values, const torch::Tensor& prior,
                                 const torch::Tensor& squares, bool own) {
  const torch::NoGradGuard no_grad;
  std::vector<double> nearest;
  for (std::int64_t first = 0; first < values.size(0); first += kSpreadRows) {
    const std::int64_t count = std::min(kSpreadRows, values.size(0) - first);
    const torch::Tensor rows = values.slice(0, first, first + count).flatten(1).to(torch::kFloat);
    torch::Tensor squared = rows.square().sum(1, true) + squares - 2.0 * torch::mm(rows, prior.t());
    if (own) squared.diagonal(first).fill_(std::numeric_limits<float>::infinity());
    const torch::Tensor least =
        std::get<0>(squared.min(1)).clamp_min(0.0).sqrt().to(torch::kDouble).contiguous();
    const double* const data = least.data_ptr<double>();
    nearest.insert(nearest.end(), data, data + count);
  }
  return nearest;
}

}  // namespace

PriorSpread::PriorSpread(const torch::Tensor& prior, double percentile)
    : prior_(prior.flatten(1).to(torch::kFloat)), squares_(prior_.square().sum(1)) {
  AG_CHECK(prior.size(0) >= 2, "at least two prior shapes");
  limit_ = PercentileOf(ToNearestRow(prior_, prior_, squares_, /*own=*/true), percentile);
}

std::vector<double> PriorSpread::Nearest(const torch::Tensor& values) const {
  return ToNearestRow(values, prior_, squares_, /*own=*/false);
}

}  // namespace antigrasp
