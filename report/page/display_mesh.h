#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// A mesh as the page draws it: vertices and triangles in the order in which a graphics card and the
// codecs like them, coordinates on 16 bits.
struct DisplayMesh {
  std::vector<Eigen::Vector3d> vertices;  // in stored order, not yet rounded
  std::vector<unsigned int> indices;      // three a triangle, counter-clockwise from outside
  Eigen::Vector3d min = Eigen::Vector3d::Zero();
  double extent = 0.0;             // the largest of the bounding box; > 0
  std::size_t full_triangles = 0;  // of the mesh it was made from; more than its own: simplified
};

// nullopt for a mesh that cannot be drawn: no faces, no extent, coordinates that are not finite or
// beyond single precision, indices out of range. Faces with a repeated vertex are left out. A mesh
// of more than `max_triangles` is simplified to about as many. 1 ms for 2,500 faces.
std::optional<DisplayMesh> MakeDisplayMesh(const TriangleMesh& mesh, std::size_t max_triangles);

// The streams of meshoptimizer's codecs: four uint16 a vertex, coordinate = min + q / 65535 *
// extent, the fourth 0; and four bytes an index. The index codec may turn a triangle's corners.
std::string EncodePositions(const DisplayMesh& mesh);
std::string EncodeIndices(const DisplayMesh& mesh);

}  // namespace antigrasp
