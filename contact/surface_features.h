#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// Where on the surface a place is. The three are told apart because a nearest point on an edge or
// at a corner is one only if no face around it comes nearer.
enum class SurfaceFeature { kFace, kEdge, kCorner };

// The point of one face that is nearest to a place.
struct Foot {
  Eigen::Vector3d point;
  Eigen::Vector3d away;  // from the point to the place
  double square;         // of the distance
  SurfaceFeature feature;
  std::int32_t index;  // of the face, edge or corner
};

// The faces, edges and corners of a closed outward mesh with what is around each of them. Bits of
// an answer do not depend on the face that it was found through. Faces without area are left out:
// their edges are those of others.
class SurfaceFeatures {
 public:
  explicit SurfaceFeatures(const TriangleMesh& mesh);

  const std::vector<std::int32_t>& faces() const { return solid_faces_; }
  const Eigen::Vector3d& corner(std::int32_t face, int k) const {
    return corners_[faces_[face].corner[k]];
  }
  std::int32_t corner_index(std::int32_t face, int k) const { return faces_[face].corner[k]; }
  const Eigen::Vector3d& normal(std::int32_t face) const { return faces_[face].normal; }

  Foot Nearest(std::int32_t face, const Eigen::Vector3d& place) const;

  // Whether the face is the one that speaks for the feature: of several that meet there, the first.
  bool Speaks(std::int32_t face, const Foot& foot) const;

  // Whether the foot is a local minimum of the distance over the whole surface. On a flat surface
  // that is cut into triangles rounding may make one of two feet that are one.
  bool IsLocalMinimum(const Foot& foot) const;

  // Outward pseudo-normal, unit: the sum over the faces around, at corners by their angles. The
  // place of the nearest foot of all lies inside the solid where away . this < 0 (Baerentzen and
  // Aanaes, "Signed distance computation using the angle weighted pseudonormal", 2005).
  const Eigen::Vector3d& OutwardNormal(const Foot& foot) const;

 private:
  struct Face {
    std::int32_t corner[3];
    std::int32_t edge[3];  // k: from corner k to the next
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  };
  struct Edge {
    std::int32_t low, high;  // corners
    std::int32_t speaker = -1;
    std::size_t first = 0, last = 0;  // of inward_
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  };
  struct Corner {
    std::int32_t speaker = -1;
    std::size_t first = 0, last = 0;  // of spokes_
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  };

  void AddFaces(const TriangleMesh& mesh);
  void AddEdges(const TriangleMesh& mesh);
  void AddSpokes();
  Foot OnEdge(std::int32_t edge, const Eigen::Vector3d& place) const;
  Foot AtCorner(std::int32_t corner, const Eigen::Vector3d& place) const;

  std::vector<Eigen::Vector3d> corners_;
  std::vector<Face> faces_;
  std::vector<std::int32_t> solid_faces_;
  std::vector<Edge> edges_;
  std::vector<Corner> around_;           // every corner
  std::vector<Eigen::Vector3d> inward_;  // from an edge into its faces, unit, in their planes
  std::vector<Eigen::Vector3d> spokes_;  // from a corner along its edges, unit
};

}  // namespace antigrasp
