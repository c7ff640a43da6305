#include "antigrasp/mesh/ray_scene.h"

#include <embree3/rtcore.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "antigrasp/core/error.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

// At a more grazing angle the plane says less about the distance than the float hit does.
constexpr double kGrazing = 1e-6;

struct Face {
  std::size_t index;
  Vector3d normal;
  double offset;  // normal . any vertex, about the scene's centre
};

std::vector<Face> FacesWithArea(const TriangleMesh& mesh, const Vector3d& center) {
  std::vector<Face> faces;
  faces.reserve(mesh.faces.size());
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    const Vector3d cross = FaceCross(mesh, i);
    const double norm = cross.norm();
    if (!(norm > 0.0)) continue;
    const Vector3d normal = cross / norm;
    const Vector3d corner = mesh.vertices[static_cast<std::size_t>(mesh.faces[i][0])] - center;
    faces.push_back({i, normal, normal.dot(corner)});
  }
  return faces;
}

}  // namespace

struct RayScene::Impl {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  Vector3d center;
  std::vector<Face> faces;

  explicit Impl(const TriangleMesh& mesh)
      : center(Bounds(mesh).Center()), faces(FacesWithArea(mesh, center)) {
    // One thread: objects are the unit of parallel work, and the tree must not depend on timing.
    device = rtcNewDevice("threads=1,set_affinity=0");
    if (device == nullptr) throw RuntimeFailure("Embree could not create a device");
    scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);  // no ray slips through a shared edge
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
    if (!faces.empty()) AddTriangles(mesh);
    rtcCommitScene(scene);
  }

  ~Impl() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }

  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void AddTriangles(const TriangleMesh& mesh) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                3 * sizeof(float), mesh.vertices.size()));
    auto* indices = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(std::uint32_t), faces.size()));
    if (vertices == nullptr || indices == nullptr) {
      rtcReleaseGeometry(geometry);
      throw RuntimeFailure("Embree could not allocate its buffers");
    }
    for (const Vector3d& vertex : mesh.vertices) {
      const Eigen::Vector3f v = (vertex - center).cast<float>();
      for (int k = 0; k < 3; ++k) *vertices++ = v[k];
    }
    for (const Face& face : faces) {
      for (const std::int32_t v : mesh.faces[face.index]) {
        *indices++ = static_cast<std::uint32_t>(v);
      }
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
  }
};

RayScene::RayScene(const TriangleMesh& mesh) : impl_(std::make_unique<const Impl>(mesh)) {}
RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

std::optional<RayHit> RayScene::Closest(const Vector3d& origin, const Vector3d& direction,
                                        double max_distance) const {
  const Vector3d local = origin - impl_->center;
  RTCRayHit query;
  query.ray.org_x = static_cast<float>(local.x());
  query.ray.org_y = static_cast<float>(local.y());
  query.ray.org_z = static_cast<float>(local.z());
  query.ray.dir_x = static_cast<float>(direction.x());
  query.ray.dir_y = static_cast<float>(direction.y());
  query.ray.dir_z = static_cast<float>(direction.z());
  query.ray.tnear = 0.0f;
  query.ray.tfar = static_cast<float>(max_distance);
  query.ray.time = 0.0f;
  query.ray.mask = ~0u;
  query.ray.id = 0;
  query.ray.flags = 0;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(impl_->scene, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;

  const Face& face = impl_->faces[query.hit.primID];
  const double slope = face.normal.dot(direction);
  RayHit hit;
  hit.distance = std::abs(slope) > kGrazing ? (face.offset - face.normal.dot(local)) / slope
                                            : static_cast<double>(query.ray.tfar);
  hit.face = face.index;
  hit.point = origin + hit.distance * direction;
  hit.normal = face.normal;
  hit.front = slope < 0.0;
  return hit;
}

}  // namespace antigrasp
