#pragma once

#include <Eigen/Core>
#include <vector>

#include "antigrasp/bundle/convex_part.h"

namespace antigrasp {

// The convex hull of few points in plain arithmetic, some ten times as fast as exact predicates:
// what is within 1e-7 of the size of a face counts as in it. 20 us for 64 points.
class SmallHull {
 public:
  explicit SmallHull(std::vector<Eigen::Vector3d> points);  // empty when they lie in one plane
  double Volume() const;
  ConvexPart Part() const;  // planes (one a face), box and volume; no mesh

 private:
  struct Face {
    int a, b, c;
    Eigen::Vector3d normal;
    double offset;
  };
  const Eigen::Vector3d& At(int i) const { return points_[static_cast<std::size_t>(i)]; }
  Face Make(int a, int b, int c) const;
  bool Begin();
  void Add(int p);

  std::vector<Eigen::Vector3d> points_;
  double near_ = 0.0;
  std::vector<Face> faces_;
  std::vector<std::pair<int, int>> edges_;
};

}  // namespace antigrasp
