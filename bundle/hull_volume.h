#pragma once

#include <Eigen/Core>
#include <vector>

namespace antigrasp {

// The points that reach furthest in 64 directions: corners of the hull, and their hull is in it.
std::vector<Eigen::Vector3d> FurthestPoints(const std::vector<Eigen::Vector3d>& points);

// About the volume of the convex hull, never too much: that of the hull of the points above. Ten
// times faster than the hull of a thousand points, some in one plane.
double AboutHullVolume(const std::vector<Eigen::Vector3d>& points);

}  // namespace antigrasp
