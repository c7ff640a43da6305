#pragma once

#include <vector>

#include "antigrasp/core/rng.h"
#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// Points uniform over the area of a mesh.
class SurfaceSampler {
 public:
  struct Sample {
    Eigen::Vector3d point;
    Eigen::Vector3d normal;  // outward unit normal of its face
    std::size_t face;
  };

  explicit SurfaceSampler(const TriangleMesh& mesh);
  double area() const { return cumulative_.empty() ? 0.0 : cumulative_.back(); }
  Sample Draw(RngStream* rng) const;  // area() > 0; three uniform numbers

 private:
  const TriangleMesh& mesh_;
  std::vector<double> cumulative_;  // area of the faces up to and including this one
};

}  // namespace antigrasp
