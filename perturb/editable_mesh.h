#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "antigrasp/mesh/triangle_mesh.h"
#include "antigrasp/perturb/face_pairs.h"
#include "antigrasp/perturb/face_tree.h"
#include "antigrasp/perturb/validity.h"

namespace antigrasp {

struct VertexMove {
  std::int32_t vertex;
  Eigen::Vector3d to;
};

// A mesh whose vertices move while its faces keep their corners; normals and a search tree follow.
// Every move is tested where it happens: only the faces around the moved vertices are looked at, so
// a move costs 10-20 us whatever the size of the mesh (the full test of 2,500 faces: 10 ms). A mesh
// that is free of self-intersections stays so.
//
//   if (mesh.TryMove(vertex, place) == MoveVerdict::kOk) {
//     better ? mesh.Commit() : mesh.Undo();   // several moves may stand before either
//   }
//
// Coordinates are rounded to single precision on the way in, so that the STL file of the result is
// exactly the mesh that was tested.
class EditableMesh {
 public:
  // Indices in range, coordinates finite in single precision (CHECKed).
  explicit EditableMesh(const TriangleMesh& mesh, const MoveLimits& limits = {});

  const TriangleMesh& mesh() const { return mesh_; }
  const MoveLimits& limits() const { return limits_; }
  std::int32_t num_faces() const { return static_cast<std::int32_t>(mesh_.faces.size()); }
  std::int32_t num_vertices() const { return static_cast<std::int32_t>(mesh_.vertices.size()); }
  double mean_edge() const { return mean_edge_; }  // of the mesh as it was given

  const Eigen::Vector3d& Position(std::int32_t vertex) const { return mesh_.vertices[vertex]; }
  std::span<const std::int32_t> FacesOf(std::int32_t vertex) const;
  const FaceShape& Shape(std::int32_t face) const { return shapes_[face]; }
  const Eigen::Vector3d& Normal(std::int32_t face) const { return shapes_[face].normal; }
  const Eigen::Vector3d& StartNormal(std::int32_t face) const { return start_normals_[face]; }

  // Moves the vertices (each named once) together if the limits allow it; otherwise nothing
  // changes.
  MoveVerdict TryMove(std::span<const VertexMove> moves);
  MoveVerdict TryMove(std::int32_t vertex, const Eigen::Vector3d& to);

  // What moved since the last Commit or Undo.
  const std::vector<std::int32_t>& ChangedFaces() const { return changed_; }  // in order

  void Commit();  // keeps them
  void Undo();    // takes them back, bit by bit

  // The first face met from a point along a unit direction, other than `ignored` (-1: none).
  std::optional<FaceHit> FirstHit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                                  std::int32_t ignored = -1) const {
    return tree_.FirstHit(mesh_, origin, direction, ignored);
  }

 private:
  void LinkVerticesToFaces();
  std::vector<std::int32_t> FacesAround(std::span<const VertexMove> moves) const;
  MoveVerdict CheckShapes(const std::vector<std::int32_t>& faces) const;
  bool Intersect(const std::vector<std::int32_t>& faces) const;
  void Place(std::int32_t vertex, const Eigen::Vector3d& to) { mesh_.vertices[vertex] = to; }
  void Refresh(const std::vector<std::int32_t>& faces);  // shapes and tree

  TriangleMesh mesh_;
  MoveLimits limits_;
  double cos_from_start_, cos_per_move_;
  double mean_edge_ = 0.0;
  std::vector<std::int32_t> face_begin_, faces_of_;  // faces of vertex v: [begin[v], begin[v + 1])
  std::vector<FaceShape> shapes_;
  std::vector<Eigen::Vector3d> start_normals_;
  std::vector<double> start_heights_;
  FaceTree tree_;
  std::vector<VertexMove> taken_back_to_;  // where vertices were, oldest first
  std::vector<std::int32_t> changed_;
};

}  // namespace antigrasp
