#include "antigrasp/perturb/smooth_field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace antigrasp {
namespace {

using Eigen::Vector3d;

// Below this tanh(x) is x.
constexpr double kNoMove = 1e-6;

// Every vertex is within this many radii of a centre.
constexpr double kCover = 0.7;

std::vector<Vector3d> Spread(const TriangleMesh& mesh, double cover, std::size_t most) {
  std::vector<Vector3d> centres;
  std::vector<double> nearest(mesh.vertices.size(), std::numeric_limits<double>::infinity());
  const Vector3d middle = Bounds(mesh).Center();
  std::size_t next = 0;
  for (std::size_t v = 1; v < mesh.vertices.size(); ++v) {
    if ((mesh.vertices[v] - middle).squaredNorm() > (mesh.vertices[next] - middle).squaredNorm()) {
      next = v;
    }
  }
  while (centres.size() < most && nearest[next] > cover * cover) {
    centres.push_back(mesh.vertices[next]);
    for (std::size_t v = 0; v < nearest.size(); ++v) {
      nearest[v] = std::min(nearest[v], (mesh.vertices[v] - centres.back()).squaredNorm());
    }
    next = static_cast<std::size_t>(std::max_element(nearest.begin(), nearest.end()) -
                                    nearest.begin());
  }
  return centres;
}

}  // namespace

SmoothField::SmoothField(const TriangleMesh& mesh, double radius, int most) {
  const double spread = radius * Bounds(mesh).Extent().norm();
  const std::vector<Vector3d> at = Spread(mesh, kCover * spread, static_cast<std::size_t>(most));
  weights_.resize(std::ssize(mesh.vertices), std::ssize(at));
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    for (std::size_t k = 0; k < at.size(); ++k) {
      weights_(static_cast<Eigen::Index>(v), static_cast<Eigen::Index>(k)) =
          std::exp(-(mesh.vertices[v] - at[k]).squaredNorm() / (2.0 * spread * spread));
    }
  }
}

TriangleMesh MovedBy(const Eigen::MatrixX3d& moves, double longest, double share,
                     const TriangleMesh& mesh) {
  TriangleMesh moved = mesh;
  for (std::size_t v = 0; v < moved.vertices.size(); ++v) {
    const Vector3d u = moves.row(static_cast<Eigen::Index>(v)).transpose();
    const double length = u.norm();
    const double factor = length > kNoMove ? std::tanh(length) / length : 1.0;
    moved.vertices[v] += share * longest * factor * u;
  }
  return moved;
}

Eigen::MatrixX3d ByMoves(const Eigen::MatrixX3d& moves, double longest,
                         const std::vector<Vector3d>& by_vertex) {
  Eigen::MatrixX3d by_moves(moves.rows(), 3);
  for (Eigen::Index v = 0; v < moves.rows(); ++v) {
    const Vector3d u = moves.row(v).transpose();
    Vector3d slope = longest * by_vertex[static_cast<std::size_t>(v)];
    const double length = u.norm();
    if (length > kNoMove) {
      const Vector3d along = u / length;
      const double reach = std::tanh(length), lengthwise = along.dot(slope);
      slope = reach / length * (slope - lengthwise * along) +
              (1.0 - reach * reach) * lengthwise * along;
    }
    by_moves.row(v) = slope.transpose();
  }
  return by_moves;
}

}  // namespace antigrasp
