#pragma once

#include <cstddef>
#include <vector>

namespace antigrasp {

// Weights that change one at a time, drawn from in proportion: both log n. A parent is always the
// sum of its two children, so the state depends on the weights alone, not on how they came.
class SumTree {
 public:
  explicit SumTree(std::size_t count) {
    while (leaves_ < count) leaves_ *= 2;
    sums_.assign(2 * leaves_, 0.0);
  }

  void Set(std::size_t item, double weight) {
    std::size_t node = leaves_ + item;
    sums_[node] = weight;
    while (node /= 2) sums_[node] = sums_[2 * node] + sums_[2 * node + 1];
  }

  double Total() const { return sums_[1]; }

  // The item in whose share of the total `at`, in [0, Total()), falls; never one of weight zero.
  std::size_t Find(double at) const {
    std::size_t node = 1;
    while (node < leaves_) {
      node *= 2;
      if (sums_[node + 1] > 0.0 && (at >= sums_[node] || !(sums_[node] > 0.0))) {
        at -= sums_[node];
        ++node;
      }
    }
    return node - leaves_;
  }

 private:
  std::size_t leaves_ = 1;
  std::vector<double> sums_;  // of node i below nodes 2 i and 2 i + 1; the root is 1
};

}  // namespace antigrasp
