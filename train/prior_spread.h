#pragma once

#include <torch/types.h>

#include <vector>

namespace antigrasp {

// How far shapes lie from each other in the prior set, by the Euclidean distance between network
// values: a sample that is farther from its nearest prior shape than nearly all of them are from
// theirs is none of the kind.
class PriorSpread {
 public:
  // prior: [N, ...], N >= 2, any float type. percentile: 0 to 100, of the distances of its shapes
  // to their nearest other one. One N x N x r^3 matrix product; 256 rows in memory at a time.
  PriorSpread(const torch::Tensor& prior, double percentile);

  double limit() const { return limit_; }

  // Distance of each of values [M, ...] to its nearest prior shape.
  std::vector<double> Nearest(const torch::Tensor& values) const;

 private:
  torch::Tensor prior_;    // [N, r^3] float32
  torch::Tensor squares_;  // [N]
  double limit_ = 0.0;
};

}  // namespace antigrasp
