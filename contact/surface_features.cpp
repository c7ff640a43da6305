#include "antigrasp/contact/surface_features.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "antigrasp/mesh/topology.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

// A face around an edge or corner rises towards the place only where its slope is above this: below
// it is what rounding makes of a flat surface.
constexpr double kFlatSlope = 1e-9;

Foot FootAt(const Vector3d& point, const Vector3d& place, SurfaceFeature feature,
            std::int32_t index) {
  Foot foot{point, place - point, 0.0, feature, index};
  foot.square = foot.away.squaredNorm();
  return foot;
}

double CornerAngle(const Vector3d& at, const Vector3d& b, const Vector3d& c) {
  return std::atan2((b - at).cross(c - at).norm(), (b - at).dot(c - at));
}

}  // namespace

SurfaceFeatures::SurfaceFeatures(const TriangleMesh& mesh)
    : corners_(mesh.vertices), around_(mesh.vertices.size()) {
  AddFaces(mesh);
  AddEdges(mesh);
  AddSpokes();
}

void SurfaceFeatures::AddFaces(const TriangleMesh& mesh) {
  faces_.resize(mesh.faces.size());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    Face& face = faces_[f];
    for (int k = 0; k < 3; ++k) face.corner[k] = mesh.faces[f][k];
    if (IsDegenerate(mesh, f)) continue;
    solid_faces_.push_back(static_cast<std::int32_t>(f));
    face.normal = FaceCross(mesh, f).normalized();
    for (int k = 0; k < 3; ++k) {
      Corner& corner = around_[face.corner[k]];
      if (corner.speaker < 0) corner.speaker = static_cast<std::int32_t>(f);
      corner.normal +=
          face.normal * CornerAngle(corners_[face.corner[k]], corners_[face.corner[(k + 1) % 3]],
                                    corners_[face.corner[(k + 2) % 3]]);
    }
  }
  for (Corner& corner : around_) corner.normal.normalize();
}

void SurfaceFeatures::AddEdges(const TriangleMesh& mesh) {
  ForEachEdge(SortedEdgeUses(mesh), [&](auto first, auto last) {
    const auto index = static_cast<std::int32_t>(edges_.size());
    Edge edge;
    edge.low = first->low;
    edge.high = first->high;
    edge.first = inward_.size();
    const Vector3d along = (corners_[edge.high] - corners_[edge.low]).normalized();
    for (auto use = first; use != last; ++use) {
      Face& face = faces_[use->face];
      for (int k = 0; k < 3; ++k) {
        const auto [low, high] = std::minmax(face.corner[k], face.corner[(k + 1) % 3]);
        if (low == edge.low && high == edge.high) face.edge[k] = index;
      }
      if (face.normal.isZero()) continue;
      if (edge.speaker < 0) edge.speaker = use->face;
      edge.normal += face.normal;
      inward_.push_back(face.normal.cross(use->forward ? along : Vector3d(-along)));
    }
    edge.last = inward_.size();
    edge.normal.normalize();
    edges_.push_back(edge);
  });
}

void SurfaceFeatures::AddSpokes() {
  for (const Edge& edge : edges_) {
    if (edge.speaker < 0) continue;
    ++around_[edge.low].last;
    ++around_[edge.high].last;
  }
  std::size_t total = 0;
  for (Corner& corner : around_) {
    const std::size_t count = corner.last;
    corner.first = corner.last = total;
    total += count;
  }
  spokes_.resize(total);
  for (const Edge& edge : edges_) {
    if (edge.speaker < 0) continue;
    const Vector3d along = (corners_[edge.high] - corners_[edge.low]).normalized();
    spokes_[around_[edge.low].last++] = along;
    spokes_[around_[edge.high].last++] = -along;
  }
}

// Always from the lower to the higher corner: the same bits for both faces.
Foot SurfaceFeatures::OnEdge(std::int32_t index, const Vector3d& place) const {
  const Edge& edge = edges_[index];
  const Vector3d& low = corners_[edge.low];
  const Vector3d along = corners_[edge.high] - low;
  const double share = std::clamp((place - low).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return FootAt(low + share * along, place, SurfaceFeature::kEdge, index);
}

Foot SurfaceFeatures::AtCorner(std::int32_t corner, const Vector3d& place) const {
  return FootAt(corners_[corner], place, SurfaceFeature::kCorner, corner);
}

// Ericson, "Real-Time Collision Detection" (2005), section 5.1.5.
Foot SurfaceFeatures::Nearest(std::int32_t index, const Vector3d& place) const {
  const Face& face = faces_[index];
  const Vector3d& a = corners_[face.corner[0]];
  const Vector3d& b = corners_[face.corner[1]];
  const Vector3d& c = corners_[face.corner[2]];
  const Vector3d ab = b - a;
  const Vector3d ac = c - a;
  const Vector3d from_a = place - a;
  const double d1 = ab.dot(from_a);
  const double d2 = ac.dot(from_a);
  if (d1 <= 0.0 && d2 <= 0.0) return AtCorner(face.corner[0], place);
  const Vector3d from_b = place - b;
  const double d3 = ab.dot(from_b);
  const double d4 = ac.dot(from_b);
  if (d3 >= 0.0 && d4 <= d3) return AtCorner(face.corner[1], place);
  if (d1 >= 0.0 && d3 <= 0.0 && d1 * d4 - d3 * d2 <= 0.0) return OnEdge(face.edge[0], place);
  const Vector3d from_c = place - c;
  const double d5 = ab.dot(from_c);
  const double d6 = ac.dot(from_c);
  if (d6 >= 0.0 && d5 <= d6) return AtCorner(face.corner[2], place);
  if (d2 >= 0.0 && d6 <= 0.0 && d5 * d2 - d1 * d6 <= 0.0) return OnEdge(face.edge[2], place);
  if (d4 - d3 >= 0.0 && d5 - d6 >= 0.0 && d3 * d6 - d5 * d4 <= 0.0)
    return OnEdge(face.edge[1], place);
  const double height = face.normal.dot(from_a);
  return {place - height * face.normal, height * face.normal, height * height,
          SurfaceFeature::kFace, index};
}

bool SurfaceFeatures::Speaks(std::int32_t face, const Foot& foot) const {
  if (foot.feature == SurfaceFeature::kFace) return true;
  if (foot.feature == SurfaceFeature::kEdge) return edges_[foot.index].speaker == face;
  return around_[foot.index].speaker == face;
}

bool SurfaceFeatures::IsLocalMinimum(const Foot& foot) const {
  if (foot.feature == SurfaceFeature::kFace) return true;
  const bool edge = foot.feature == SurfaceFeature::kEdge;
  const auto& ways = edge ? inward_ : spokes_;
  const std::size_t first = edge ? edges_[foot.index].first : around_[foot.index].first;
  const std::size_t last = edge ? edges_[foot.index].last : around_[foot.index].last;
  const double flat = kFlatSlope * std::sqrt(foot.square);
  for (std::size_t i = first; i < last; ++i) {
    if (ways[i].dot(foot.away) > flat) return false;
  }
  return true;
}

const Vector3d& SurfaceFeatures::OutwardNormal(const Foot& foot) const {
  if (foot.feature == SurfaceFeature::kFace) return faces_[foot.index].normal;
  if (foot.feature == SurfaceFeature::kEdge) return edges_[foot.index].normal;
  return around_[foot.index].normal;
}

}  // namespace antigrasp
