#include "antigrasp/bundle/hull_volume.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "antigrasp/bundle/small_hull.h"

namespace antigrasp {
namespace {

constexpr int kDirections = 64;
using Directions = Eigen::Matrix<double, kDirections, 3>;

// Evenly over the sphere: a spiral with the golden angle.
Directions MakeDirections() {
  Directions directions;
  const double turn = std::numbers::pi * (3.0 - std::sqrt(5.0));
  for (int i = 0; i < kDirections; ++i) {
    const double z = 1.0 - 2.0 * (i + 0.5) / kDirections, r = std::sqrt(1.0 - z * z);
    directions.row(i) << r * std::cos(turn * i), r * std::sin(turn * i), z;
  }
  return directions;
}

}  // namespace

std::vector<Eigen::Vector3d> FurthestPoints(const std::vector<Eigen::Vector3d>& points) {
  static const Directions directions = MakeDirections();
  if (points.empty()) return {};
  Eigen::Matrix<double, kDirections, 1> reach = directions * points[0];
  std::vector<std::size_t> furthest(kDirections, 0);
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Eigen::Matrix<double, kDirections, 1> at = directions * points[i];
    if (!(at.array() > reach.array()).any()) continue;
    for (int k = 0; k < kDirections; ++k) {
      if (at[k] > reach[k]) {
        reach[k] = at[k];
        furthest[static_cast<std::size_t>(k)] = i;
      }
    }
  }
  std::sort(furthest.begin(), furthest.end());
  furthest.erase(std::unique(furthest.begin(), furthest.end()), furthest.end());
  std::vector<Eigen::Vector3d> chosen;
  for (const std::size_t i : furthest) chosen.push_back(points[i]);
  return chosen;
}

double AboutHullVolume(const std::vector<Eigen::Vector3d>& points) {
  return SmallHull(FurthestPoints(points)).Volume();
}

}  // namespace antigrasp
