#include "antigrasp/train/similarity.h"

#include <torch/torch.h>

#include <algorithm>
#include <limits>

#include "antigrasp/core/check.h"

namespace antigrasp {
namespace {

// Euclidean distances [N, M] between the rows of a and b.
torch::Tensor Distances(const torch::Tensor& a, const torch::Tensor& b) {
  const torch::Tensor squared =
      a.square().sum(1, true) + b.square().sum(1, true).t() - 2.0 * torch::mm(a, b.t());
  return squared.clamp_min(0.0).sqrt();
}

torch::Tensor WithoutDiagonal(const torch::Tensor& square) {
  return square.clone().fill_diagonal_(std::numeric_limits<double>::infinity());
}

double MeanPairwise(const torch::Tensor& distances) {
  const double n = static_cast<double>(distances.size(0));
  return distances.sum().item<double>() / (n * (n - 1.0));
}

}  // namespace

SetSimilarity CompareSets(const torch::Tensor& samples, const torch::Tensor& reference) {
  const torch::NoGradGuard no_grad;
  const std::int64_t n = std::min(samples.size(0), reference.size(0));
  AG_CHECK(n >= 2, "two sets of at least two shapes");
  const torch::Tensor a = samples.slice(0, 0, n).reshape({n, -1}).to(torch::kFloat);
  const torch::Tensor b = reference.slice(0, 0, n).reshape({n, -1}).to(torch::kFloat);
  // The diagonal of |x|^2 + |x|^2 - 2 x.x is rounding noise: both uses below leave it out.
  const torch::Tensor aa = Distances(a, a).fill_diagonal_(0.0);
  const torch::Tensor bb = Distances(b, b).fill_diagonal_(0.0);
  const torch::Tensor ab = Distances(a, b);

  SetSimilarity result;
  const torch::Tensor nearest_reference = ab.argmin(1);
  result.coverage = static_cast<double>(std::get<0>(torch::_unique(nearest_reference)).size(0)) /
                    static_cast<double>(n);
  const torch::Tensor nearest_a = WithoutDiagonal(aa).amin(1);
  const torch::Tensor nearest_b = WithoutDiagonal(bb).amin(1);
  const std::int64_t right = (nearest_a < ab.amin(1)).sum().item<std::int64_t>() +
                             (nearest_b < ab.amin(0)).sum().item<std::int64_t>();
  result.nna = static_cast<double>(right) / static_cast<double>(2 * n);
  const double near = 0.5 * nearest_b.median().item<double>();
  result.duplicates =
      static_cast<double>((nearest_a < near).sum().item<std::int64_t>()) / static_cast<double>(n);
  const double reference_spread = MeanPairwise(bb);
  result.diversity = reference_spread > 0 ? MeanPairwise(aa) / reference_spread : 0.0;
  return result;
}

}  // namespace antigrasp
