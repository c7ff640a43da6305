#include "antigrasp/train/elites.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "antigrasp/core/rng.h"

namespace antigrasp {
namespace {

std::vector<std::int64_t> ValidIndices(const std::vector<double>& graspability) {
  std::vector<std::int64_t> indices;
  for (std::size_t i = 0; i < graspability.size(); ++i) {
    if (!std::isnan(graspability[i])) indices.push_back(static_cast<std::int64_t>(i));
  }
  return indices;
}

std::vector<std::int64_t> FirstSorted(std::vector<std::int64_t> indices, std::int64_t keep) {
  indices.resize(std::min(indices.size(), static_cast<std::size_t>(keep)));
  std::sort(indices.begin(), indices.end());
  return indices;
}

}  // namespace

std::vector<std::int64_t> LeastGraspable(const std::vector<double>& graspability,
                                         std::int64_t keep) {
  std::vector<std::int64_t> indices = ValidIndices(graspability);
  std::stable_sort(indices.begin(), indices.end(), [&](std::int64_t a, std::int64_t b) {
    return graspability[static_cast<std::size_t>(a)] < graspability[static_cast<std::size_t>(b)];
  });
  return FirstSorted(std::move(indices), keep);
}

std::vector<std::int64_t> RandomKeep(const std::vector<double>& graspability, std::int64_t keep,
                                     std::uint64_t seed, std::uint64_t stage) {
  std::vector<std::int64_t> indices = ValidIndices(graspability);
  RngStream rng(seed, "control", stage);
  for (std::size_t i = indices.size(); i > 1; --i) {
    std::swap(indices[i - 1], indices[rng.Below(i)]);  // Fisher-Yates
  }
  return FirstSorted(std::move(indices), keep);
}

}  // namespace antigrasp
