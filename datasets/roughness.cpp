#include "antigrasp/datasets/roughness.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "antigrasp/core/check.h"
#include "antigrasp/mesh/topology.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

constexpr double kDegrees = 180.0 / std::numbers::pi;

// Calls visit(angle in radians, length) for every edge that has an angle.
template <typename Visit>
void ForEachAngle(const TriangleMesh& mesh, const Visit& visit) {
  const std::vector<EdgeUse> uses = SortedEdgeUses(mesh);
  ForEachEdge(uses, [&](auto first, auto last) {
    if (last - first != 2) return;
    const EdgeUse& a = *first;
    const EdgeUse& b = *(first + 1);
    const Vector3d u = FaceCross(mesh, static_cast<std::size_t>(a.face));
    // Faces wound against each other have one normal inside: turn it out.
    const Vector3d v =
        (a.forward == b.forward ? -1.0 : 1.0) * FaceCross(mesh, static_cast<std::size_t>(b.face));
    if (u.isZero(0.0) || v.isZero(0.0)) return;
    const double edge = (mesh.vertices[static_cast<std::size_t>(a.high)] -
                         mesh.vertices[static_cast<std::size_t>(a.low)])
                            .norm();
    // atan2 keeps small angles, which acos of a dot product loses.
    visit(std::atan2(u.cross(v).norm(), u.dot(v)), edge);
  });
}

DihedralAngles NoAngles() {
  DihedralAngles angles;
  angles.spread.assign(static_cast<std::size_t>(180.0 / DihedralAngles::kStep) + 1, 0.0);
  return angles;
}

// angles += weight * other
void Add(const DihedralAngles& other, double weight, DihedralAngles* angles) {
  angles->flat += weight * other.flat;
  angles->crease += weight * other.crease;
  for (std::size_t i = 0; i < angles->spread.size(); ++i) {
    angles->spread[i] += weight * other.spread[i];
  }
}

}  // namespace

DihedralAngles DihedralAnglesOf(const TriangleMesh& mesh) {
  DihedralAngles lengths = NoAngles(), shares = NoAngles();
  double length = 0.0;
  ForEachAngle(mesh, [&](double angle, double edge) {
    const double degrees = kDegrees * angle;
    if (degrees < DihedralAngles::kFlat) lengths.flat += edge;
    if (degrees > DihedralAngles::kCrease) lengths.crease += edge;
    const double at = degrees / DihedralAngles::kStep;
    const std::size_t below = std::min(static_cast<std::size_t>(at), lengths.spread.size() - 2);
    const double part = at - static_cast<double>(below);
    lengths.spread[below] += (1.0 - part) * edge;
    lengths.spread[below + 1] += part * edge;
    length += edge;
  });
  if (length > 0.0) Add(lengths, 1.0 / length, &shares);
  return shares;
}

double MeanDihedralAngle(const TriangleMesh& mesh) {
  double weighted = 0.0, length = 0.0;
  ForEachAngle(mesh, [&](double angle, double edge) {
    weighted += edge * angle;
    length += edge;
  });
  return length > 0.0 ? kDegrees * weighted / length : 0.0;
}

DihedralAngles MeanOf(const std::vector<DihedralAngles>& shapes) {
  AG_CHECK(!shapes.empty(), "the angles of at least one shape");
  DihedralAngles mean = NoAngles();
  for (const DihedralAngles& shape : shapes) {
    Add(shape, 1.0 / static_cast<double>(shapes.size()), &mean);
  }
  return mean;
}

double DihedralDistance(const DihedralAngles& a, const DihedralAngles& b) {
  AG_CHECK(a.spread.size() == b.spread.size() && !a.spread.empty(), "two spreads");
  // The area between the distribution functions, which are level between the steps.
  double ahead = 0.0, area = 0.0;
  for (std::size_t i = 0; i + 1 < a.spread.size(); ++i) {
    ahead += a.spread[i] - b.spread[i];
    area += std::abs(ahead);
  }
  return DihedralAngles::kStep * area;
}

}  // namespace antigrasp
