#include "antigrasp/mesh/polygon_soup.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "antigrasp/core/error.h"
#include "antigrasp/core/format.h"
#include "antigrasp/mesh/weld.h"

namespace antigrasp {
namespace {

// Far beyond any shape, and small enough that no volume computed from it overflows.
constexpr double kLargestCoordinate = 1e30;
// Ear clipping costs the square of this.
constexpr std::size_t kMostCorners = 4096;

void CheckVertices(const PolygonSoup& soup, const std::string& path) {
  if (soup.vertices.empty()) throw InputError("no vertices", path, "a mesh with faces");
  if (soup.ends.empty()) throw InputError("no faces", path, "a mesh with faces");
  if (soup.vertices.size() > std::numeric_limits<std::int32_t>::max() ||
      soup.corners.size() > std::numeric_limits<std::int32_t>::max() / 3) {
    throw InputError("too many faces", path, "fewer than 700 million corners");
  }
  for (std::size_t i = 0; i < soup.vertices.size(); ++i) {
    const Eigen::Vector3d& v = soup.vertices[i];
    if (v.allFinite() && v.cwiseAbs().maxCoeff() <= kLargestCoordinate) continue;
    throw InputError("vertex " + std::to_string(i + 1) + " = " + FormatDouble(v.x()) + " " +
                         FormatDouble(v.y()) + " " + FormatDouble(v.z()),
                     path, "finite coordinates of at most 1e30");
  }
}

std::string CornersOf(std::size_t polygon, std::size_t count) {
  return "face " + std::to_string(polygon + 1) + " has " + std::to_string(count) + " corners";
}

[[noreturn]] void RefuseCorners(std::size_t polygon, std::size_t count, const std::string& path) {
  throw InputError(CornersOf(polygon, count), path, "3 to " + std::to_string(kMostCorners));
}

void CheckPolygon(const PolygonSoup& soup, std::size_t polygon, std::size_t begin,
                  const std::string& path) {
  const std::string name = "face " + std::to_string(polygon + 1);
  const std::size_t count = soup.ends[polygon] - begin;
  if (count > kMostCorners) RefuseCorners(polygon, count, path);
  for (std::size_t i = begin; i < soup.ends[polygon]; ++i) {
    const std::int64_t corner = soup.corners[i];
    if (corner >= 0 && corner < static_cast<std::int64_t>(soup.vertices.size())) continue;
    throw InputError(
        name + " refers to vertex number " + std::to_string(corner) + " (counted from 0)", path,
        "one of the " + std::to_string(soup.vertices.size()) + " vertices");
  }
}

// Points and lines among the faces: they have no area and close nothing.
struct FacesLeftOut {
  std::size_t count = 0, first = 0, corners = 0;  // `corners` of the first

  void Add(std::size_t polygon, std::size_t its_corners) {
    if (count++ > 0) return;
    first = polygon;
    corners = its_corners;
  }
  std::string Note() const {
    return std::to_string(count) + (count == 1 ? " face" : " faces") +
           " of fewer than 3 corners left out (" + CornersOf(first, corners) + ")";
  }
};

// The polygon seen along its normal, as a shrinking ring of corners.
class EarClipper {
 public:
  EarClipper(const std::vector<Eigen::Vector3d>& vertices, const std::vector<std::int32_t>& polygon)
      : ring_(polygon.size()) {
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // Newell: the sum of all fan triangles
    const Eigen::Vector3d& first = vertices[polygon[0]];
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
      normal += (vertices[polygon[i]] - first).cross(vertices[polygon[i + 1]] - first);
    }
    // Dropping the largest component of the normal keeps the coordinates exact.
    int axis = 0;
    normal.cwiseAbs().maxCoeff(&axis);
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const double sign = normal[axis] < 0.0 ? -1.0 : 1.0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Eigen::Vector3d p = vertices[polygon[i]] - first;
      points_.push_back({p[u], sign * p[v]});
      ring_[i] = static_cast<int>(i);
    }
  }

  // Three places in the polygon; call until one triangle is left.
  std::array<int, 3> Next() {
    const std::size_t n = ring_.size();
    std::vector<std::pair<double, std::size_t>> candidates;  // worst shape first
    reflex_.clear();
    for (std::size_t i = 0; i < n; ++i) {
      const double quality = Quality(i);
      if (quality > 0.0) {
        candidates.emplace_back(quality, i);
      } else {
        reflex_.push_back(ring_[i]);
      }
    }
    std::sort(candidates.begin(), candidates.end(), [](const auto& a, const auto& b) {
      return a.first != b.first ? a.first < b.first : a.second > b.second;
    });
    std::size_t best = candidates.empty() ? 1 : candidates.back().second;
    for (auto it = candidates.rbegin(); it != candidates.rend(); ++it) {
      if (Blocked(it->second)) continue;
      best = it->second;
      break;
    }
    const std::array<int, 3> ear{ring_[(best + n - 1) % n], ring_[best], ring_[(best + 1) % n]};
    ring_.erase(ring_.begin() + static_cast<std::ptrdiff_t>(best));
    return ear;
  }

 private:
  double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) const {
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
  }

  // Height over longest edge of the ear at place i; not positive where the polygon turns inward.
  double Quality(std::size_t i) const {
    const std::size_t n = ring_.size();
    const auto& a = points_[ring_[(i + n - 1) % n]];
    const auto& b = points_[ring_[i]];
    const auto& c = points_[ring_[(i + 1) % n]];
    const double longest =
        std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
    return longest > 0.0 ? Cross(a, b, c) / longest : 0.0;
  }

  // Whether a corner lies in the ear or on its border, which only corners that are not convex can
  // be the first to do.
  bool Blocked(std::size_t i) const {
    const std::size_t n = ring_.size();
    const auto& a = points_[ring_[(i + n - 1) % n]];
    const auto& b = points_[ring_[i]];
    const auto& c = points_[ring_[(i + 1) % n]];
    return std::any_of(reflex_.begin(), reflex_.end(), [&](int place) {
      const auto& p = points_[place];
      if (p == a || p == b || p == c) return false;
      return Cross(a, b, p) >= 0.0 && Cross(b, c, p) >= 0.0 && Cross(c, a, p) >= 0.0;
    });
  }

  std::vector<Eigen::Vector2d> points_;
  std::vector<int> ring_;
  std::vector<int> reflex_;
};

}  // namespace

std::vector<std::array<std::int32_t, 3>> TriangulatedPolygon(
    const std::vector<Eigen::Vector3d>& vertices, const std::vector<std::int32_t>& polygon) {
  if (polygon.size() == 3) return {{polygon[0], polygon[1], polygon[2]}};
  EarClipper clipper(vertices, polygon);
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (std::size_t left = polygon.size(); left > 2; --left) {
    const auto [a, b, c] = clipper.Next();
    triangles.push_back({polygon[a], polygon[b], polygon[c]});
  }
  return triangles;
}

TriangleMesh ToTriangleMesh(const PolygonSoup& soup, const std::string& path,
                            std::vector<std::string>* notes) {
  CheckVertices(soup, path);
  TriangleMesh mesh;
  const std::vector<std::int32_t> first = FirstEqual(soup.vertices);
  std::vector<std::int32_t> merged(first.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    const bool is_first = first[i] == static_cast<std::int32_t>(i);
    merged[i] = is_first ? static_cast<std::int32_t>(mesh.vertices.size()) : merged[first[i]];
    if (is_first) mesh.vertices.push_back(soup.vertices[i]);
  }
  FacesLeftOut left_out;
  std::vector<std::int32_t> polygon;
  std::size_t begin = 0;
  for (std::size_t p = 0; p < soup.ends.size(); ++p) {
    CheckPolygon(soup, p, begin, path);
    polygon.clear();
    for (; begin < soup.ends[p]; ++begin) polygon.push_back(merged[soup.corners[begin]]);
    if (polygon.size() < 3) {
      left_out.Add(p, polygon.size());
      continue;
    }
    const auto triangles = TriangulatedPolygon(mesh.vertices, polygon);
    mesh.faces.insert(mesh.faces.end(), triangles.begin(), triangles.end());
  }
  if (mesh.faces.empty()) RefuseCorners(left_out.first, left_out.corners, path);
  if (notes != nullptr) {
    *notes = soup.notes;
    if (left_out.count > 0) notes->push_back(left_out.Note());
  }
  return mesh;
}

}  // namespace antigrasp
