#include "antigrasp/quality/local_object.h"

#include <algorithm>
#include <cmath>

#include "antigrasp/mesh/place.h"
#include "antigrasp/quality/object_size.h"

namespace antigrasp {
namespace {

bool IndicesInRange(const TriangleMesh& mesh) {
  const auto count = static_cast<std::int64_t>(mesh.vertices.size());
  return std::all_of(mesh.faces.begin(), mesh.faces.end(), [count](const auto& face) {
    return std::all_of(face.begin(), face.end(),
                       [count](std::int32_t v) { return v >= 0 && v < count; });
  });
}

bool Finite(const TriangleMesh& mesh) {
  return std::all_of(mesh.vertices.begin(), mesh.vertices.end(),
                     [](const Eigen::Vector3d& v) { return v.allFinite(); });
}

// Metres per unit of the mesh; 0 when it has no usable size.
double ScaleToMetres(const TriangleMesh& mesh, const MetricOptions& options) {
  if (mesh.faces.empty() || !IndicesInRange(mesh) || !Finite(mesh)) return 0.0;
  const Eigen::Vector3d extent = Bounds(mesh).Extent();
  const double smallest = extent.minCoeff();
  const double scale = MetresPerUnit(options, extent);
  // The ray tree holds floats: sizes beyond their range cannot be evaluated.
  const bool usable = smallest > 0.0 && std::isfinite(scale) && extent.maxCoeff() * scale < 1e18;
  return usable ? scale : 0.0;
}

}  // namespace

TriangleMesh MetresAbout(const Eigen::Vector3d& place, const TriangleMesh& mesh, double scale) {
  const Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  return Transformed(Transformed(mesh, 1.0, origin - place), scale, origin);
}

std::optional<LocalObject> MakeLocalObject(const TriangleMesh& mesh, const MetricOptions& options) {
  const double scale = ScaleToMetres(mesh, options);
  if (!(scale > 0.0)) return std::nullopt;
  const Eigen::Vector3d place = RoundPlace(mesh);
  return LocalObject{MetresAbout(place, mesh, scale), scale, place};
}

}  // namespace antigrasp
