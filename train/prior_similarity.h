#pragma once

#include <torch/types.h>

#include <cstdint>
#include <vector>

#include "antigrasp/datasets/chamfer.h"

namespace antigrasp {

// How a generated set relates to a reference set of the same size (the definitions are those of
// datasets/set_comparison.h) by the Euclidean distance between network values (shapes as [N, ...]
// tensors, any shape, any float type). Cost: one N x N x r^3 matrix product, 2 s for N = 500 at
// 32^3 on two cores.
struct PriorSimilarity {
  double coverage = 0.0;    // share of the reference that is the nearest of some sample (COV)
  double nna = 0.0;         // leave-one-out 1-nearest-neighbour accuracy; 0.5 = indistinguishable
  double duplicates = 0.0;  // share of samples nearer to another sample than half the reference's
                            // median nearest-neighbour distance
  double diversity = 0.0;   // mean pairwise distance, relative to the reference's
};

// Both sets need at least two shapes; the larger one is cut to the smaller one's size.
PriorSimilarity CompareWithPrior(const torch::Tensor& samples, const torch::Tensor& reference);

// Those distances, [N, M]. The diagonal of a set with itself is rounding noise.
DistanceMatrix ValueDistances(const torch::Tensor& a, const torch::Tensor& b);

// The row of `centres` [K, r^3], float32, that is nearest to each of values [N, ...]; the first of
// equals.
std::vector<std::int64_t> NearestRows(const torch::Tensor& values, const torch::Tensor& centres);

}  // namespace antigrasp
