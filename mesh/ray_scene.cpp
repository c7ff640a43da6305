#include "antigrasp/mesh/ray_scene.h"

#include <embree3/rtcore.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <mutex>
#include <vector>

#include "antigrasp/core/error.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

// At a more grazing angle the plane says less about the distance than the float hit does.
constexpr double kGrazing = 1e-6;
// Without Embree no face is looked at that the ray meets at a more grazing angle.
constexpr double kSteep = 1e-3;
// Four roundings to float.
constexpr double kFloatRounding = 2.5e-7;
constexpr double kNoEnd = std::numeric_limits<double>::infinity();

struct Face {
  Vector3d normal;  // zero without area
  double offset;    // normal . any vertex, about the scene's centre
  float slimness;   // longest edge over the height above it, or less
};

Face FaceOf(const TriangleMesh& mesh, std::size_t i, const Vector3d& center) {
  const auto corner = [&](std::size_t k) -> const Vector3d& {
    return mesh.vertices[static_cast<std::size_t>(mesh.faces[i][k])];
  };
  const Vector3d cross = FaceCross(mesh, i);
  const double norm = cross.norm();
  if (!(norm > 0.0)) return {Vector3d::Zero(), 0.0, 0.0f};
  const Vector3d normal = cross / norm;
  const double longest2 =
      std::max({(corner(1) - corner(0)).squaredNorm(), (corner(2) - corner(1)).squaredNorm(),
                (corner(0) - corner(2)).squaredNorm()});
  return {normal, normal.dot(corner(0) - center), static_cast<float>(longest2 / norm)};
}

// About the blocks' centre; behind that length there are no faces.
LocalRay Local(const Ray& ray, const FaceBlocks& blocks) {
  const Vector3d origin = ray.origin - blocks.center();
  return {origin, ray.direction,
          std::min(ray.length, 2.0 * (origin.lpNorm<1>() + blocks.radius()))};
}

// The box with an axis along the first of the rays that holds all of them, cut off behind the mesh.
OrientedBox BoxAround(std::span<const Ray> rays, const FaceBlocks& blocks) {
  OrientedBox box;
  box.axes.col(0) = rays.front().direction;
  box.axes.col(1) = rays.front().direction.unitOrthogonal();
  box.axes.col(2) = box.axes.col(0).cross(box.axes.col(1));
  Vector3d low = Vector3d::Constant(kNoEnd), high = -low;
  for (const Ray& ray : rays) {
    const LocalRay local = Local(ray, blocks);
    for (const double at : {0.0, local.length}) {
      const Vector3d end = box.axes.transpose() * (local.origin + at * ray.direction);
      low = low.cwiseMin(end);
      high = high.cwiseMax(end);
    }
  }
  box.center = blocks.center() + box.axes * (0.5 * (low + high));
  box.half = 0.5 * (high - low);
  return box;
}

// The first face; `open`: float arithmetic may have it otherwise.
struct FirstFace {
  std::optional<std::size_t> face;
  bool open = false;
};

class Device {
 public:
  Device() : device_(rtcNewDevice("threads=1,set_affinity=0")) {
    if (device_ == nullptr) throw RuntimeFailure("Embree could not create a device");
  }
  ~Device() { rtcReleaseDevice(device_); }
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
  RTCDevice get() const { return device_; }

 private:
  RTCDevice device_;
};

}  // namespace

struct RayScene::Impl {
  Vector3d center;
  std::vector<Face> faces;
  std::vector<Eigen::Vector3f> vertices;  // about the centre
  std::vector<std::array<std::int32_t, 3>> corners;
  mutable std::once_flag tree_once, blocks_once;
  mutable std::atomic<bool> blocks_there = false;  // call_once costs as much as a ray
  mutable RTCDevice device = nullptr;
  mutable RTCScene tree = nullptr;
  mutable std::vector<std::uint32_t> with_area;  // the tree's faces
  mutable std::optional<FaceBlocks> blocks;

  explicit Impl(const TriangleMesh& mesh) : center(Bounds(mesh).Center()), corners(mesh.faces) {
    faces.reserve(mesh.faces.size());
    for (std::size_t i = 0; i < mesh.faces.size(); ++i) faces.push_back(FaceOf(mesh, i, center));
    vertices.reserve(mesh.vertices.size() + 1);  // Embree reads four bytes beyond the last one
    for (const Vector3d& vertex : mesh.vertices) {
      vertices.push_back((vertex - center).cast<float>());
    }
  }
  ~Impl() {
    if (tree != nullptr) rtcReleaseScene(tree);
    if (device != nullptr) rtcReleaseDevice(device);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  RTCScene Tree() const {
    std::call_once(tree_once, [this] { BuildTree(); });
    return tree;
  }
  const FaceBlocks& Blocks() const {
    if (!blocks_there.load(std::memory_order_acquire)) {
      std::call_once(blocks_once, [this] { blocks.emplace(vertices, corners, center); });
      blocks_there.store(true, std::memory_order_release);
    }
    return *blocks;
  }

  void BuildTree() const {
    // Devices are costly to make and each thread keeps one: objects are the unit of parallel work,
    // and the tree must not depend on timing.
    thread_local const Device of_thread;
    device = of_thread.get();
    rtcRetainDevice(device);
    tree = rtcNewScene(device);
    rtcSetSceneFlags(tree, RTC_SCENE_FLAG_ROBUST);  // no ray slips through a shared edge
    rtcSetSceneBuildQuality(tree, RTC_BUILD_QUALITY_MEDIUM);
    for (std::size_t i = 0; i < faces.size(); ++i) {
      if (!faces[i].normal.isZero(0.0)) with_area.push_back(static_cast<std::uint32_t>(i));
    }
    if (!with_area.empty()) AddTriangles();
    rtcCommitScene(tree);
  }

  void AddTriangles() const {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               vertices.data(), 0, 3 * sizeof(float), vertices.size());
    auto* indices = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(std::uint32_t), with_area.size()));
    if (indices == nullptr) {
      rtcReleaseGeometry(geometry);
      throw RuntimeFailure("Embree could not allocate its buffers");
    }
    for (const std::uint32_t face : with_area) {
      for (const std::int32_t v : corners[face]) *indices++ = static_cast<std::uint32_t>(v);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(tree, geometry);
    rtcReleaseGeometry(geometry);
  }

  // The first of the faces that the ray's line meets. Embree compares distances in float, and
  // planes of slim faces are known the less: what lies within this rounding of another face, or of
  // an end of the ray, is open.
  FirstFace FirstOf(const Ray& ray, const Vector3d& local,
                    std::span<const std::uint32_t> slots) const {
    struct Met {
      std::size_t face;
      double at, slack;
    };
    std::array<Met, FaceBlocks::kMostMet> met;
    std::size_t count = 0;
    const double size = blocks->radius() + local.lpNorm<1>();
    double latest = kNoEnd;  // that the first one is met
    for (const std::uint32_t slot : slots) {
      const std::size_t index = blocks->FaceOf(slot);
      const Face& face = faces[index];
      if (face.normal.isZero(0.0)) continue;
      const double slope = face.normal.dot(ray.direction);
      if (std::abs(slope) < kSteep) return {std::nullopt, true};
      const double per_slope = 1.0 / slope;
      const double at = (face.offset - face.normal.dot(local)) * per_slope;
      const double slack =
          kFloatRounding * (size + std::abs(at)) * (1.0 + face.slimness) * std::abs(per_slope);
      if (at < -slack || at > ray.length + slack) continue;
      met[count++] = {index, at, slack};
      if (at > slack && at < ray.length - slack) latest = std::min(latest, at + slack);
    }
    FirstFace first;
    for (std::size_t i = 0; i < count; ++i) {
      if (met[i].at - met[i].slack > latest) continue;
      const bool within = met[i].at > met[i].slack && met[i].at < ray.length - met[i].slack;
      if (first.face || !within) return {std::nullopt, true};
      first.face = met[i].face;
    }
    return first;
  }

  // Where the ray meets a face; `far` in place of a distance that its plane does not give.
  RayHit HitOf(const Vector3d& origin, const Vector3d& direction, std::size_t index,
               double far) const {
    const Face& face = faces[index];
    const double slope = face.normal.dot(direction);
    RayHit hit;
    hit.distance =
        std::abs(slope) > kGrazing ? (face.offset - face.normal.dot(origin - center)) / slope : far;
    hit.face = index;
    hit.point = origin + hit.distance * direction;
    hit.normal = face.normal;
    hit.front = slope < 0.0;
    return hit;
  }
};

RayScene::RayScene(const TriangleMesh& mesh) : impl_(std::make_unique<const Impl>(mesh)) {}
RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

const FaceBlocks& RayScene::Blocks() const { return impl_->Blocks(); }

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
  rtcIntersect1(impl_->Tree(), &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return impl_->HitOf(origin, direction, impl_->with_area[query.hit.primID],
                      static_cast<double>(query.ray.tfar));
}

void RayScene::Near(std::span<const Ray> rays, NearFaces* near) const {
  const FaceBlocks& blocks = impl_->Blocks();
  if (rays.empty() || !blocks.CanCast()) return;
  if (rays.size() > 1) return blocks.NearBox(BoxAround(rays, blocks), near);
  blocks.NearLine(Local(rays.front(), blocks), near);
}

void RayScene::Closest(std::span<const Ray> rays, const NearFaces& near,
                       std::span<std::optional<RayHit>> hits) const {
  const FaceBlocks& blocks = impl_->Blocks();
  if (!blocks.CanCast()) {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      hits[i] = Closest(rays[i].origin, rays[i].direction, rays[i].length);
    }
    return;
  }
  std::array<LocalRay, FaceBlocks::kTogether> local;
  FaceBlocks::Slots met;
  for (std::size_t done = 0; done < rays.size(); done += local.size()) {
    const auto these = rays.subspan(done, std::min(local.size(), rays.size() - done));
    for (std::size_t i = 0; i < these.size(); ++i) local[i] = Local(these[i], blocks);
    blocks.Met({local.data(), these.size()}, near, &met);
    for (std::size_t i = 0; i < these.size(); ++i) {
      const auto count = static_cast<std::size_t>(met.counts[i]);
      FirstFace first{std::nullopt, true};
      if (count <= FaceBlocks::kMostMet) {
        first = impl_->FirstOf(these[i], local[i].origin, {met.slots[i], count});
      }
      std::optional<RayHit>& hit = hits[done + i];
      hit.reset();
      if (first.open) {
        hit = Closest(these[i].origin, these[i].direction, these[i].length);
      } else if (first.face) {
        hit = impl_->HitOf(these[i].origin, these[i].direction, *first.face, these[i].length);
      }
    }
  }
}

std::optional<RayHit> RayScene::Closest(const Ray& ray, const NearFaces& near) const {
  std::optional<RayHit> hit;
  Closest({&ray, 1}, near, {&hit, 1});
  return hit;
}

}  // namespace antigrasp
