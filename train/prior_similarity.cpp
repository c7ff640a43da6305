#include "antigrasp/train/prior_similarity.h"

#include <torch/types.h>
#include <torch/utils.h>

#include <algorithm>

#include "antigrasp/core/check.h"
#include "antigrasp/datasets/set_comparison.h"

namespace antigrasp {
namespace {

// Euclidean distances [N, M] between the rows of a and b.
DistanceMatrix RowDistances(const torch::Tensor& a, const torch::Tensor& b) {
  const torch::Tensor squared =
      a.square().sum(1, true) + b.square().sum(1, true).t() - 2.0 * torch::mm(a, b.t());
  const torch::Tensor distances =
      squared.clamp_min(0.0).sqrt().to(torch::kCPU, torch::kFloat).contiguous();
  return Eigen::Map<const DistanceMatrix>(distances.data_ptr<float>(), distances.size(0),
                                          distances.size(1));
}

}  // namespace

PriorSimilarity CompareWithPrior(const torch::Tensor& samples, const torch::Tensor& reference) {
  const torch::NoGradGuard no_grad;
  const std::int64_t n = std::min(samples.size(0), reference.size(0));
  AG_CHECK(n >= 2, "two sets of at least two shapes");
  const torch::Tensor a = samples.slice(0, 0, n).reshape({n, -1}).to(torch::kFloat);
  const torch::Tensor b = reference.slice(0, 0, n).reshape({n, -1}).to(torch::kFloat);
  // The diagonal of |x|^2 + |x|^2 - 2 x.x is rounding noise; nothing below looks at it.
  const DistanceMatrix aa = RowDistances(a, a), bb = RowDistances(b, b);
  const SetComparison sets = CompareSets(aa, RowDistances(a, b), bb);
  const SpreadComparison spread = CompareSpreads(aa, bb);
  return {sets.coverage, sets.nna, spread.samples.duplicates, spread.diversity};
}

DistanceMatrix ValueDistances(const torch::Tensor& a, const torch::Tensor& b) {
  const torch::NoGradGuard no_grad;
  return RowDistances(a.flatten(1).to(torch::kFloat), b.flatten(1).to(torch::kFloat));
}

std::vector<std::int64_t> NearestRows(const torch::Tensor& values, const torch::Tensor& centres) {
  const torch::NoGradGuard no_grad;
  const torch::Tensor squares = centres.square().sum(1);
  std::vector<std::int64_t> found;
  for (const torch::Tensor& chunk : values.split(256)) {
    const torch::Tensor rows = chunk.flatten(1).to(torch::kFloat);
    const torch::Tensor nearest = (squares - 2.0 * torch::mm(rows, centres.t())).argmin(1);
    found.insert(found.end(), nearest.data_ptr<std::int64_t>(),
                 nearest.data_ptr<std::int64_t>() + nearest.numel());
  }
  return found;
}

}  // namespace antigrasp
