#include "antigrasp/render/render_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "antigrasp/core/angles.h"
#include "antigrasp/mesh/ray_scene.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

constexpr double kAmbient = 0.42;
constexpr double kExposure = 1.12;

// Unit normals at the corners of the faces: the mean of the faces around the corner that turn from
// this one by less than the crease, by area.
class SmoothNormals {
 public:
  SmoothNormals(const TriangleMesh& mesh, double crease)
      : mesh_(mesh), faces_of_(mesh.vertices.size()) {
    const double cosine = std::cos(crease * kDegree);
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

// The light that comes back from the mesh to one camera.
class Shading {
 public:
  Shading(const TriangleMesh& mesh, const Camera& camera, const View& view)
      : camera_(camera),
        scene_(mesh),
        normals_(mesh, view.crease),
        light_((-camera.forward - 0.5 * camera.right + 0.7 * camera.up).normalized()),
        color_(view.color[0], view.color[1], view.color[2]) {
    // From so far in front of the picture that the whole mesh lies behind it.
    const BoundingBox box = Bounds(mesh);
    away_ = (box.Center() - camera.center).norm() + box.Extent().norm();
  }

  // At a place in the picture, in half sides from its middle, y up; nullopt where nothing is met.
  std::optional<Vector3d> At(double x, double y) const {
    const Vector3d origin = camera_.center - away_ * camera_.forward +
                            camera_.half_side * (x * camera_.right + y * camera_.up);
    const auto hit = scene_.Closest(origin, camera_.forward, 2.0 * away_);
    if (!hit) return std::nullopt;
    const double lit = std::max(0.0, normals_.At(hit->face, hit->point).dot(light_));
    return (kAmbient + (1.0 - kAmbient) * lit) * color_;
  }

 private:
  const Camera& camera_;
  RayScene scene_;
  SmoothNormals normals_;
  Vector3d light_, color_;
  double away_ = 0.0;
};

// Calls pixel(x, y, sum of the light, number of samples that met the mesh) for every pixel.
template <typename Pixel>
void ForEachPixel(const Shading& shading, const View& view, const Pixel& pixel) {
  const int fine = view.pixels * view.samples;
  for (int y = 0; y < view.pixels; ++y) {
    for (int x = 0; x < view.pixels; ++x) {
      Vector3d sum = Vector3d::Zero();
      int met = 0;
      for (int i = 0; i < view.samples * view.samples; ++i) {
        const int at_x = x * view.samples + i % view.samples;
        const int at_y = y * view.samples + i / view.samples;
        const auto light =
            shading.At((2.0 * at_x + 1.0) / fine - 1.0, 1.0 - (2.0 * at_y + 1.0) / fine);
        if (!light) continue;
        sum += *light;
        ++met;
      }
      pixel(x, y, sum, met);
    }
  }
}

std::uint8_t Byte(double value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
}

}  // namespace

Image RenderMesh(const TriangleMesh& mesh, const View& view) {
  Image image(view.pixels, view.pixels);
  if (mesh.faces.empty()) return image;
  const Camera camera = CameraFor(mesh, view.azimuth, view.elevation);
  const int samples = view.samples * view.samples;
  ForEachPixel(Shading(mesh, camera, view), view, [&](int x, int y, Vector3d sum, int met) {
    sum += Vector3d::Constant(255.0 * (samples - met));
    for (int k = 0; k < 3; ++k) {
      image.At(x, y)[static_cast<std::size_t>(k)] = Byte(kExposure * sum[k] / samples);
    }
  });
  return image;
}

RgbaImage RenderOnNothing(const TriangleMesh& mesh, const Camera& camera, const View& view) {
  RgbaImage image(view.pixels, view.pixels);
  if (mesh.faces.empty()) return image;
  const int samples = view.samples * view.samples;
  ForEachPixel(Shading(mesh, camera, view), view, [&](int x, int y, const Vector3d& sum, int met) {
    if (met == 0) return;
    Rgba& pixel = image.At(x, y);
    for (int k = 0; k < 3; ++k) {
      pixel[static_cast<std::size_t>(k)] = Byte(kExposure * sum[k] / met);
    }
    pixel[3] = Byte(255.0 * met / samples);
  });
  return image;
}

}  // namespace antigrasp
