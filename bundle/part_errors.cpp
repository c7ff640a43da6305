#include "antigrasp/bundle/part_errors.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "antigrasp/bundle/column_volumes.h"
#include "antigrasp/bundle/solid_test.h"
#include "antigrasp/bundle/surface_points.h"
#include "antigrasp/mesh/point_tree.h"
#include "antigrasp/sdf/mesh_to_sdf.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

constexpr double kApart = 0.25;  // cells between the points of a surface
constexpr double kTouch = 1e-4;  // of a cell: what lies no deeper in a part is on its surface

TriangleMesh Together(const std::vector<ConvexPart>& parts) {
  TriangleMesh all;
  for (const ConvexPart& part : parts) {
    const auto first = static_cast<std::int32_t>(all.vertices.size());
    all.vertices.insert(all.vertices.end(), part.mesh.vertices.begin(), part.mesh.vertices.end());
    for (const auto& face : part.mesh.faces) {
      all.faces.push_back({face[0] + first, face[1] + first, face[2] + first});
    }
  }
  return all;
}

// The surface of the union of the parts.
class UnionSurface {
 public:
  UnionSurface(const std::vector<ConvexPart>& parts, double touch, double apart)
      : parts_(parts),
        touch_(touch),
        parts_distance_(Together(parts)),
        points_(PointsOn(apart)),
        tree_(points_) {}

  // The middles of small faces of all parts that have no other part just before them.
  const std::vector<Vector3d>& points() const { return points_; }

  bool Inside(const Vector3d& point) const {
    return std::any_of(parts_.begin(), parts_.end(),
                       [&](const ConvexPart& part) { return part.Depth(point, touch_) > touch_; });
  }

  // How far the point lies from the union's surface, no less; something up to `enough` when it is
  // no deeper. The foot of a perpendicular on a plane is on the union's surface when no part is
  // before it.
  double Distance(const Vector3d& point, double enough) const {
    // Out of the union what is nearest of all parts is on its surface.
    if (!Inside(point)) return parts_distance_.Unsigned(point);
    double least = std::numeric_limits<double>::max();
    tree_.Search(
        point,
        [&](const PointTree::Box& box) {
          return least > enough && (box.center - point).norm() - box.half_axes.norm() < least;
        },
        [&](std::size_t k) { least = std::min(least, (points_[k] - point).norm()); });
    if (least <= enough) return least;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const ConvexPart& part = parts_[i];
      if (part.Depth(point, touch_) <= touch_) continue;
      std::vector<std::pair<double, std::size_t>> nearest;
      for (std::size_t k = 0; k < part.planes.size(); ++k) {
        const double depth = -part.planes[k].Outside(point);
        if (depth < least) nearest.emplace_back(depth, k);
      }
      std::sort(nearest.begin(), nearest.end());
      for (const auto& [depth, k] : nearest) {
        const Vector3d foot = point + depth * part.planes[k].normal;
        if (!OnPart(foot, part) || Covered(foot + 2.0 * touch_ * part.planes[k].normal, i))
          continue;
        least = std::min(least, depth);
        break;
      }
      if (least <= enough) return least;
    }
    return least;
  }

 private:
  std::vector<Vector3d> PointsOn(double apart) const {
    std::vector<Vector3d> points;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const SurfacePoints all = PointsOf(Refined(parts_[i].mesh, apart));
      for (std::size_t k = 0; k < all.middles.size(); ++k) {
        const Vector3d before = all.middles[k] + 2.0 * touch_ * all.crosses[k].normalized();
        if (!Covered(before, i)) points.push_back(all.middles[k]);
      }
    }
    return points;
  }

  bool Covered(const Vector3d& point, std::size_t but) const {
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      if (i != but && parts_[i].Depth(point) > 0.0) return true;
    }
    return false;
  }
  bool OnPart(const Vector3d& point, const ConvexPart& part) const {
    return std::all_of(part.planes.begin(), part.planes.end(),
                       [&](const HalfSpace& plane) { return plane.Outside(point) <= touch_; });
  }

  const std::vector<ConvexPart>& parts_;
  double touch_;
  MeshDistance parts_distance_;
  std::vector<Vector3d> points_;
  PointTree tree_;
};

}  // namespace

PartErrors MeasureParts(const TriangleMesh& solid, const std::vector<ConvexPart>& parts,
                        double cell) {
  PartErrors errors;
  const ColumnVolumes volumes = CompareVolumes(solid, parts);
  errors.covered = volumes.covered / volumes.solid;
  errors.missing = volumes.missing / volumes.solid;
  const UnionSurface surface(parts, kTouch * cell, kApart * cell);
  const SolidTest test(solid);
  for (const Vector3d& point : surface.points()) {
    // In the solid it is a seam; what is missing there is seen from the solid's surface, below.
    if (!test.Inside(point)) errors.hausdorff = std::max(errors.hausdorff, test.Distance(point));
  }
  for (const Vector3d& point : PointsOf(Refined(solid, 2.0 * kApart * cell)).points) {
    double* const error = surface.Inside(point) ? &errors.dent : &errors.hausdorff;
    *error = std::max(*error, surface.Distance(point, *error));
  }
  errors.hausdorff = std::max(errors.hausdorff, errors.dent);
  return errors;
}

}  // namespace antigrasp
