#include "antigrasp/bundle/solid_piece.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace antigrasp {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

constexpr double kRounding = 1e-12;
constexpr double kParallel = 1e-6;  // of a determinant of unit normals

std::vector<double> Heights(const TriangleMesh& mesh, const HalfSpace& plane) {
  std::vector<double> heights;
  heights.reserve(mesh.vertices.size());
  for (const Vector3d& v : mesh.vertices) heights.push_back(plane.Outside(v));
  return heights;
}

// Where the plane meets edges; every edge once, always computed from its lower number.
class EdgePoints {
 public:
  EdgePoints(const TriangleMesh& mesh, const std::vector<double>& heights)
      : mesh_(mesh), heights_(heights) {}
  std::int32_t At(std::int32_t a, std::int32_t b) {
    if (a > b) std::swap(a, b);
    const auto key = static_cast<std::uint64_t>(a) << 32U | static_cast<std::uint32_t>(b);
    const auto [place, is_new] =
        number_.try_emplace(key, static_cast<std::int32_t>(points_.size()));
    if (is_new) {
      const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
      const double t = heights_[i] / (heights_[i] - heights_[j]);
      points_.push_back(mesh_.vertices[i] + t * (mesh_.vertices[j] - mesh_.vertices[i]));
    }
    return place->second;
  }
  const Points& points() const { return points_; }

 private:
  const TriangleMesh& mesh_;
  const std::vector<double>& heights_;
  std::unordered_map<std::uint64_t, std::int32_t> number_;
  Points points_;
};

int Before(const std::vector<double>& heights, std::int32_t vertex) {
  return heights[static_cast<std::size_t>(vertex)] > 0.0 ? 1 : 0;
}

// Where the plane and two of the sides meet in the solid, within the other sides.
Points NewCorners(const SolidPiece& piece, const HalfSpace& plane, const InsideTest& inside) {
  Points corners;
  const auto& sides = piece.sides;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    for (std::size_t j = i + 1; j < sides.size(); ++j) {
      Eigen::Matrix3d normals;
      normals << plane.normal.transpose(), sides[i].normal.transpose(), sides[j].normal.transpose();
      if (std::abs(normals.determinant()) < kParallel) continue;
      const Vector3d corner =
          normals.inverse() * Vector3d(plane.offset, sides[i].offset, sides[j].offset);
      const auto within = [&](std::size_t k) {
        return sides[k].Outside(corner) <= kRounding * (corner.norm() + std::abs(sides[k].offset));
      };
      bool all = true;
      for (std::size_t k = 0; k < sides.size() && all; ++k) all = within(k);
      if (all && inside(corner)) corners.push_back(corner);
    }
  }
  return corners;
}

// Numbers of vertices that one side uses, in the order of first use: the piece's own, then (behind
// them) the points on edges.
class SideMesh {
 public:
  SideMesh(const TriangleMesh& whole, const EdgePoints& cut) : whole_(whole), cut_(cut) {}
  void Add(const std::vector<std::int32_t>& polygon) {
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
      mesh_.faces.push_back({Own(polygon[0]), Own(polygon[k]), Own(polygon[k + 1])});
    }
  }
  TriangleMesh Take() { return std::move(mesh_); }

 private:
  std::int32_t Own(std::int32_t number) {
    const auto [place, is_new] =
        own_.try_emplace(number, static_cast<std::int32_t>(mesh_.vertices.size()));
    if (is_new) {
      const auto old = static_cast<std::size_t>(number);
      const std::size_t count = whole_.vertices.size();
      mesh_.vertices.push_back(old < count ? whole_.vertices[old] : cut_.points()[old - count]);
    }
    return place->second;
  }

  const TriangleMesh& whole_;
  const EdgePoints& cut_;
  TriangleMesh mesh_;
  std::unordered_map<std::int32_t, std::int32_t> own_;
};

}  // namespace

Points HullPoints(const SolidPiece& piece) {
  Points points = piece.surface.vertices;
  points.insert(points.end(), piece.corners.begin(), piece.corners.end());
  return points;
}

std::array<Points, 2> HullPointsOfSides(const SolidPiece& piece, const HalfSpace& plane,
                                        const InsideTest& inside) {
  const TriangleMesh& mesh = piece.surface;
  const std::vector<double> heights = Heights(mesh, plane);
  std::array<Points, 2> sides;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    sides[heights[i] > 0.0 ? 1 : 0].push_back(mesh.vertices[i]);
  }
  EdgePoints cut(mesh, heights);
  for (const auto& face : mesh.faces) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t a = face[k], b = face[(k + 1) % 3];
      if (Before(heights, a) != Before(heights, b)) cut.At(a, b);
    }
  }
  Points both = cut.points();
  const Points corners = NewCorners(piece, plane, inside);
  both.insert(both.end(), corners.begin(), corners.end());
  for (const Vector3d& corner : piece.corners) {
    sides[plane.Outside(corner) > 0.0 ? 1 : 0].push_back(corner);
  }
  for (Points& side : sides) side.insert(side.end(), both.begin(), both.end());
  return sides;
}

std::array<SolidPiece, 2> Cut(const SolidPiece& piece, const HalfSpace& plane,
                              const InsideTest& inside) {
  const TriangleMesh& mesh = piece.surface;
  const std::vector<double> heights = Heights(mesh, plane);
  const auto count = static_cast<std::int32_t>(mesh.vertices.size());
  EdgePoints cut(mesh, heights);
  std::array<SideMesh, 2> meshes{SideMesh(mesh, cut), SideMesh(mesh, cut)};
  for (const auto& face : mesh.faces) {
    std::array<std::vector<std::int32_t>, 2> polygons;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t a = face[k], b = face[(k + 1) % 3];
      polygons[static_cast<std::size_t>(Before(heights, a))].push_back(a);
      if (Before(heights, a) == Before(heights, b)) continue;
      const std::int32_t point = count + cut.At(a, b);
      for (auto& polygon : polygons) polygon.push_back(point);
    }
    for (std::size_t s = 0; s < 2; ++s) meshes[s].Add(polygons[s]);
  }
  std::array<SolidPiece, 2> pieces;
  const Points corners = NewCorners(piece, plane, inside);
  for (std::size_t s = 0; s < 2; ++s) {
    pieces[s].surface = meshes[s].Take();
    pieces[s].sides = piece.sides;
    pieces[s].corners = corners;
  }
  pieces[0].sides.push_back(plane);
  pieces[1].sides.push_back({-plane.normal, -plane.offset});
  for (const Vector3d& corner : piece.corners) {
    pieces[plane.Outside(corner) > 0.0 ? 1 : 0].corners.push_back(corner);
  }
  return pieces;
}

}  // namespace antigrasp
