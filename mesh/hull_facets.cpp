#include "antigrasp/mesh/hull_facets.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "antigrasp/mesh/convex_hull.h"
#include "antigrasp/mesh/topology.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

std::array<Vector3d, 3> Corners(const TriangleMesh& mesh, std::size_t face) {
  std::array<Vector3d, 3> corners;
  for (std::size_t k = 0; k < 3; ++k) {
    corners[k] = mesh.vertices[static_cast<std::size_t>(mesh.faces[face][k])];
  }
  return corners;
}

// Of a triangle seen from the origin, positive when the origin is behind it (van Oosterom and
// Strackee, "The solid angle of a plane triangle", 1983).
double SolidAngle(const std::array<Vector3d, 3>& t) {
  const double a = t[0].norm(), b = t[1].norm(), c = t[2].norm();
  return 2.0 * std::atan2(t[0].dot(t[1].cross(t[2])),
                          a * b * c + t[0].dot(t[1]) * c + t[1].dot(t[2]) * a + t[2].dot(t[0]) * b);
}

// Face numbers across the three sides of every face of a closed mesh, sides as in mesh.faces.
std::vector<std::array<std::size_t, 3>> Neighbours(const TriangleMesh& mesh) {
  std::vector<std::array<std::size_t, 3>> neighbours(mesh.faces.size());
  const auto put = [&](const EdgeUse& use, std::size_t across) {
    const auto face = static_cast<std::size_t>(use.face);
    const std::int32_t from = use.forward ? use.low : use.high;
    for (std::size_t k = 0; k < 3; ++k) {
      if (mesh.faces[face][k] == from) neighbours[face][k] = across;
    }
  };
  const std::vector<EdgeUse> uses = SortedEdgeUses(mesh);
  ForEachEdge(uses, [&](auto first, auto) {
    put(first[0], static_cast<std::size_t>(first[1].face));
    put(first[1], static_cast<std::size_t>(first[0].face));
  });
  return neighbours;
}

// For every hull triangle the number of its facet. A facet grows from its largest triangle over
// neighbours near that triangle's plane; measuring from the one plane keeps round shapes round.
std::vector<int> GroupFlat(const TriangleMesh& hull, double tolerance,
                           const std::vector<std::array<std::size_t, 3>>& neighbours) {
  std::vector<double> area(hull.faces.size());
  for (std::size_t f = 0; f < area.size(); ++f) area[f] = FaceCross(hull, f).norm();
  std::vector<std::size_t> by_area(area.size());
  std::iota(by_area.begin(), by_area.end(), std::size_t{0});
  std::stable_sort(by_area.begin(), by_area.end(),
                   [&](std::size_t f, std::size_t g) { return area[f] > area[g]; });
  std::vector<int> group(area.size(), -1);
  int count = 0;
  for (const std::size_t seed : by_area) {
    if (group[seed] >= 0) continue;
    const Vector3d normal = FaceCross(hull, seed).normalized();
    const double offset = normal.dot(Corners(hull, seed)[0]);
    std::vector<std::size_t> open{seed};
    group[seed] = count;
    while (!open.empty()) {
      const std::size_t face = open.back();
      open.pop_back();
      for (const std::size_t next : neighbours[face]) {
        const auto corners = Corners(hull, next);
        const bool flat = std::all_of(corners.begin(), corners.end(), [&](const Vector3d& v) {
          return std::abs(normal.dot(v) - offset) <= tolerance;
        });
        if (group[next] >= 0 || !flat) continue;
        group[next] = count;
        open.push_back(next);
      }
    }
    ++count;
  }
  return group;
}

std::vector<Facet> FlatFacets(const TriangleMesh& hull, double size) {
  const auto neighbours = Neighbours(hull);
  const std::vector<int> group = GroupFlat(hull, kFlat * size, neighbours);
  std::vector<Facet> facets(static_cast<std::size_t>(
      group.empty() ? 0 : *std::max_element(group.begin(), group.end()) + 1));
  for (std::size_t f = 0; f < group.size(); ++f) {
    Facet& facet = facets[static_cast<std::size_t>(group[f])];
    const auto corners = Corners(hull, f);
    facet.normal += FaceCross(hull, f);
    facet.solid_angle += SolidAngle(corners);
    for (std::size_t k = 0; k < 3; ++k) {
      if (group[neighbours[f][k]] != group[f]) {
        const auto& face = hull.faces[f];
        facet.border.push_back({corners[k], corners[(k + 1) % 3], face[k], face[(k + 1) % 3]});
      }
    }
  }
  for (Facet& facet : facets) {
    facet.normal.normalize();
    for (const Segment& side : facet.border) {
      facet.height = std::max(facet.height, facet.normal.dot(side.a));
    }
  }
  return facets;
}

}  // namespace

FacetedHull MakeFacetedHull(const TriangleMesh& mesh, const Vector3d& com) {
  FacetedHull hull;
  hull.mesh = Transformed(ConvexHull(mesh.vertices), 1.0, -com);
  hull.size = Bounds(hull.mesh).Extent().norm();
  hull.facets = FlatFacets(hull.mesh, hull.size);
  return hull;
}

}  // namespace antigrasp
