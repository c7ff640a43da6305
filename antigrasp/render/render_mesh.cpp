#include "antigrasp/render/render_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "antigrasp/quality/ray_scene.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

constexpr double kRadians = std::numbers::pi / 180.0;
constexpr double kAmbient = 0.42;
constexpr double kMargin = 1.04;  // of the picture about the object

double LargestDistance(const TriangleMesh& mesh, const Vector3d& from) {
  double squared = 0.0;
  for (const Vector3d& v : mesh.vertices) squared = std::max(squared, (v - from).squaredNorm());
  return std::sqrt(squared);
}

struct Camera {
  explicit Camera(const View& view) {
    const double azimuth = view.azimuth * kRadians, elevation = view.elevation * kRadians;
    const Vector3d towards(std::cos(elevation) * std::cos(azimuth),
                           std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
    forward = -towards;
    right = Vector3d(-std::sin(azimuth), std::cos(azimuth), 0.0);
    up = right.cross(forward);
    light = (towards - 0.5 * right + 0.7 * up).normalized();
  }
  Vector3d forward, right, up, light;
};

// Unit normals at the corners of the faces: the mean of the faces around the corner that turn from
// this one by less than the crease, by area.
class SmoothNormals {
 public:
  SmoothNormals(const TriangleMesh& mesh, double crease)
      : mesh_(mesh), faces_of_(mesh.vertices.size()) {
    const double cosine = std::cos(crease * kRadians);
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      cross_.push_back(FaceCross(mesh, f));
      normal_.push_back(cross_[f].normalized());
      for (const std::int32_t v : mesh.faces[f])
        faces_of_[static_cast<std::size_t>(v)].push_back(f);
    }
    corners_.resize(mesh.faces.size());
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      for (std::size_t k = 0; k < 3; ++k) {
        Vector3d sum = Vector3d::Zero();
        for (const std::size_t g : faces_of_[static_cast<std::size_t>(mesh.faces[f][k])]) {
          if (normal_[f].dot(normal_[g]) >= cosine) sum += cross_[g];
        }
        corners_[f][k] = sum.normalized();
      }
    }
  }

  // Between the corners by the areas that the point cuts off.
  Vector3d At(std::size_t face, const Vector3d& point) const {
    Vector3d sum = Vector3d::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3d a = Corner(face, (k + 1) % 3) - point, b = Corner(face, (k + 2) % 3) - point;
      sum += std::max(0.0, a.cross(b).dot(normal_[face])) * corners_[face][k];
    }
    return sum.isZero(0.0) ? normal_[face] : sum.normalized();
  }

 private:
  const Vector3d& Corner(std::size_t face, std::size_t k) const {
    return mesh_.vertices[static_cast<std::size_t>(mesh_.faces[face][k])];
  }

  const TriangleMesh& mesh_;
  std::vector<std::vector<std::size_t>> faces_of_;
  std::vector<Vector3d> cross_, normal_;
  std::vector<std::array<Vector3d, 3>> corners_;
};

}  // namespace

Image RenderMesh(const TriangleMesh& mesh, const View& view) {
  Image image(view.pixels, view.pixels);
  if (mesh.faces.empty()) return image;
  const Camera camera(view);
  const RayScene scene(mesh);
  const SmoothNormals normals(mesh, view.crease);
  const BoundingBox box = Bounds(mesh);
  const Vector3d center = 0.5 * (box.min + box.max);
  const double radius = LargestDistance(mesh, center);
  const Vector3d middle = center - 2.0 * radius * camera.forward;
  const int fine = view.pixels * view.samples;
  const double step = kMargin * 2.0 * radius / fine;
  const Vector3d color(view.color[0], view.color[1], view.color[2]);

  // The light at one place of the finer grid; white where nothing is met.
  const auto sample = [&](int x, int y) -> Vector3d {
    const Vector3d origin = middle + (x + 0.5 - 0.5 * fine) * step * camera.right -
                            (y + 0.5 - 0.5 * fine) * step * camera.up;
    const auto hit = scene.Closest(origin, camera.forward, 4.0 * radius);
    if (!hit) return Vector3d::Constant(255.0);
    const double lit = std::max(0.0, normals.At(hit->face, hit->point).dot(camera.light));
    return (kAmbient + (1.0 - kAmbient) * lit) * color;
  };
  for (int y = 0; y < view.pixels; ++y) {
    for (int x = 0; x < view.pixels; ++x) {
      Vector3d sum = Vector3d::Zero();
      for (int i = 0; i < view.samples * view.samples; ++i) {
        sum += sample(x * view.samples + i % view.samples, y * view.samples + i / view.samples);
      }
      sum /= view.samples * view.samples;
      for (int k = 0; k < 3; ++k) {
        image.At(x, y)[static_cast<std::size_t>(k)] =
            static_cast<std::uint8_t>(std::lround(std::clamp(sum[k] * 1.12, 0.0, 255.0)));
      }
    }
  }
  return image;
}

}  // namespace antigrasp
