#include "antigrasp/perturb/validity.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "antigrasp/core/check.h"
#include "antigrasp/mesh/inspect.h"

namespace antigrasp {

std::string_view Name(MoveVerdict verdict) {
  switch (verdict) {
    case MoveVerdict::kOk:
      return "ok";
    case MoveVerdict::kNotFinite:
      return "not_finite";
    case MoveVerdict::kTurned:
      return "turned";
    case MoveVerdict::kInverted:
      return "inverted";
    case MoveVerdict::kDegenerate:
      return "degenerate";
    case MoveVerdict::kIntersects:
      return "intersects";
  }
  AG_CHECK(false, "unknown verdict");
}

double FaceHeight(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const double longest =
      std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return longest > 0.0 ? (b - a).cross(c - a).norm() / longest : 0.0;
}

double MeanEdge(const TriangleMesh& mesh) {
  if (mesh.faces.empty()) return 0.0;
  double sum = 0.0;
  for (const auto& face : mesh.faces) {
    for (std::size_t k = 0; k < 3; ++k) {
      sum += (mesh.vertices[static_cast<std::size_t>(face[(k + 1) % 3])] -
              mesh.vertices[static_cast<std::size_t>(face[k])])
                 .norm();
    }
  }
  return sum / (3.0 * static_cast<double>(mesh.faces.size()));
}

TriangleMesh InSinglePrecision(const TriangleMesh& mesh) {
  TriangleMesh out = mesh;
  for (Eigen::Vector3d& v : out.vertices) v = InSinglePrecision(v);
  return out;
}

Eigen::Vector3d InSinglePrecision(const Eigen::Vector3d& point) {
  Eigen::Vector3d out;
  for (int k = 0; k < 3; ++k) {
    // volatile: GCC 12 at -O3 turns two roundings side by side into a vector operation and then
    // drops it, as if float held every double.
    const volatile float rounded = static_cast<float>(point[k]);
    out[k] = rounded;
  }
  return out;
}

std::string WhyNotPrintable(const TriangleMesh& mesh) { return WhyNotSolid(Inspect(mesh)); }

}  // namespace antigrasp
