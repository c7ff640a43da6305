#pragma once

#include <Eigen/Core>
#include <vector>

#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// Moves of all vertices by a few dozen vectors, smooth at the scale of the object:
//   u(x) = sum_k c_k exp(-|x - x_k|^2 / (2 radius^2))
// about centres x_k that are spread over the surface. Tapers, bends, bulges and dents are sums of
// these; ripples shorter than about twice the radius are not.
class SmoothField {
 public:
  // Centres: vertices, each the farthest from those before, until every vertex is within 0.7 radii
  // of one, at most `most`. `radius` as a share of the bounding box's diagonal: 0.12 gives some 60.
  // Vertices times centres numbers.
  SmoothField(const TriangleMesh& mesh, double radius, int most = 400);

  Eigen::Index centres() const { return weights_.cols(); }
  // A row a vertex, from a row a centre.
  Eigen::MatrixX3d At(const Eigen::MatrixX3d& by_centre) const { return weights_ * by_centre; }
  // The chain rule: derivative by the centres' vectors from that by the vertices'.
  Eigen::MatrixX3d Back(const Eigen::MatrixX3d& by_vertex) const {
    return weights_.transpose() * by_vertex;
  }

 private:
  Eigen::MatrixXd weights_;
};

// The mesh with vertex v moved by share * longest * tanh(|u_v|) along u_v: short moves are
// longest * u, and none is longer than `longest`.
TriangleMesh MovedBy(const Eigen::MatrixX3d& moves, double longest, double share,
                     const TriangleMesh& mesh);

// The chain rule for share 1: derivative by u from that by the moved vertices.
Eigen::MatrixX3d ByMoves(const Eigen::MatrixX3d& moves, double longest,
                         const std::vector<Eigen::Vector3d>& by_vertex);

}  // namespace antigrasp
