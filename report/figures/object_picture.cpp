#include "antigrasp/report/figures/object_picture.h"

#include <algorithm>
#include <cmath>

namespace antigrasp {
namespace {

constexpr int kSteps = 200;        // along a line; its pieces end in the middle of a step
constexpr double kAbove = 1e-4;    // of the size: what lies on the surface is in front of it
constexpr int kMostPixels = 2000;  // of a picture's side

}  // namespace

int FigureOptions::Pixels(double points) const {
  return std::clamp(static_cast<int>(std::lround(points * dpi / 72.0)), 8, kMostPixels);
}

std::vector<SeenPiece> SeenLine(const RayScene& scene, const Camera& camera, double size,
                                const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d towards = -camera.forward;
  const auto visible = [&](double share) {
    const Eigen::Vector3d point = a + share * (b - a) + kAbove * size * towards;
    return !scene.Closest(point, towards, 4.0 * size).has_value();
  };
  const auto place = [&](double share) {
    const Eigen::Vector2d at = camera.Project(a + share * (b - a));
    return Place{at.x(), at.y()};
  };
  std::vector<SeenPiece> pieces;
  double from = 0.0;
  bool now = visible(0.5 / kSteps);
  for (int k = 1; k <= kSteps; ++k) {
    const bool next = k < kSteps ? visible((k + 0.5) / kSteps) : !now;
    if (next == now) continue;
    const double to = static_cast<double>(k) / kSteps;
    pieces.push_back({place(from), place(to), now});
    from = to;
    now = next;
  }
  return pieces;
}

Camera FigureCamera(const TriangleMesh& mesh, const View& view, double margin) {
  Camera camera = CameraFor(mesh, view.azimuth, view.elevation);
  if (mesh.vertices.empty()) return camera;
  Eigen::Vector2d low = camera.Project(mesh.vertices.front()), high = low;
  for (const Eigen::Vector3d& v : mesh.vertices) {
    const Eigen::Vector2d at = camera.Project(v);
    low = low.cwiseMin(at);
    high = high.cwiseMax(at);
  }
  const Eigen::Vector2d shift = low + high - Eigen::Vector2d::Ones();  // in half sides
  camera.center += camera.half_side * (shift.x() * camera.right - shift.y() * camera.up);
  if ((high - low).maxCoeff() > 0.0) camera.half_side *= margin * (high - low).maxCoeff();
  return camera;
}

}  // namespace antigrasp
