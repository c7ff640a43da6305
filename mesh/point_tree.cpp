#include "antigrasp/mesh/point_tree.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <numeric>

namespace antigrasp {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr std::size_t kLeaf = 8;

}  // namespace

PointTree::PointTree(const std::vector<Vector3d>& points)
    : points_(&points), order_(points.size()) {
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  if (!points.empty()) Build(0, points.size());
}

void PointTree::Build(std::size_t first, std::size_t last) {
  const std::size_t at = nodes_.size();
  nodes_.emplace_back();
  const auto point = [&](std::size_t i) -> const Vector3d& { return (*points_)[order_[i]]; };
  Vector3d mean = Vector3d::Zero();
  for (std::size_t i = first; i < last; ++i) mean += point(i);
  mean /= static_cast<double>(last - first);
  Matrix3d spread = Matrix3d::Zero();
  for (std::size_t i = first; i < last; ++i) {
    const Vector3d arm = point(i) - mean;
    spread += arm * arm.transpose();
  }
  // Orthonormal to the last bits, which computeDirect() is not; the longest axis is the last.
  const Matrix3d axes = Eigen::SelfAdjointEigenSolver<Matrix3d>(spread).eigenvectors().transpose();
  Vector3d low = Vector3d::Zero(), high = Vector3d::Zero();
  for (std::size_t i = first; i < last; ++i) {
    const Vector3d along = axes * (point(i) - mean);
    low = low.cwiseMin(along);
    high = high.cwiseMax(along);
  }
  nodes_[at].box.center = mean + axes.transpose() * (0.5 * (low + high));
  nodes_[at].box.half_axes = (0.5 * (high - low)).asDiagonal() * axes;
  nodes_[at].first = first;
  nodes_[at].last = last;
  if (last - first <= kLeaf) return;
  const std::size_t middle = first + (last - first) / 2;
  const Vector3d longest = axes.row(2);
  const auto place = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(place(first), place(middle), place(last), [&](std::size_t i, std::size_t j) {
    return longest.dot((*points_)[i]) < longest.dot((*points_)[j]);
  });
  Build(first, middle);
  nodes_[at].right = nodes_.size();
  Build(middle, last);
}

}  // namespace antigrasp
