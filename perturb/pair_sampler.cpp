#include "antigrasp/perturb/pair_sampler.h"

#include <Eigen/Geometry>

#include "antigrasp/perturb/cone.h"
#include "antigrasp/quality/antipodal_sampler.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

constexpr int kTries = 100000;
constexpr int kRays = 10000;

// Uniform over the triangle.
Vector3d DrawPoint(const FaceShape& shape, RngStream* rng) {
  double a = rng->Uniform(), b = rng->Uniform();
  if (a + b > 1.0) {
    a = 1.0 - a;
    b = 1.0 - b;
  }
  return shape.corner[0] + a * (shape.corner[1] - shape.corner[0]) +
         b * (shape.corner[2] - shape.corner[0]);
}

}  // namespace

PairSampler::PairSampler(const EditableMesh& mesh, const PairLimits& limits, PairDraw draw)
    : mesh_(mesh), test_(limits), draw_(draw), areas_(mesh.mesh().faces.size()) {
  std::vector<std::int32_t> all;
  for (std::int32_t f = 0; f < mesh.num_faces(); ++f) all.push_back(f);
  Update(all);
}

void PairSampler::Update(std::span<const std::int32_t> changed_faces) {
  if (draw_ == PairDraw::kUniform) return;
  for (const std::int32_t f : changed_faces) {
    const auto& c = mesh_.Shape(f).corner;
    areas_.Set(static_cast<std::size_t>(f), 0.5 * (c[1] - c[0]).cross(c[2] - c[0]).norm());
  }
}

std::int32_t PairSampler::DrawFace(RngStream* rng) const {
  if (draw_ == PairDraw::kUniform) {
    return static_cast<std::int32_t>(rng->Below(static_cast<std::uint64_t>(mesh_.num_faces())));
  }
  return static_cast<std::int32_t>(areas_.Find(areas_.Total() * rng->Uniform()));
}

std::optional<PairSampler::Pair> PairSampler::Draw(RngStream* rng) const {
  if (mesh_.num_faces() == 0) return std::nullopt;
  return draw_ == PairDraw::kRay ? DrawByRay(rng) : DrawByRejection(rng);
}

std::optional<PairSampler::Pair> PairSampler::DrawByRejection(RngStream* rng) const {
  for (int i = 0; i < kTries; ++i) {
    const Pair pair{DrawFace(rng), DrawFace(rng)};
    if (pair.first != pair.second && test_(mesh_.Shape(pair.first), mesh_.Shape(pair.second))) {
      return pair;
    }
  }
  return std::nullopt;
}

std::optional<PairSampler::Pair> PairSampler::DrawByRay(RngStream* rng) const {
  for (int i = 0; i < kRays; ++i) {
    const std::int32_t first = DrawFace(rng);
    const FaceShape& shape = mesh_.Shape(first);
    const Vector3d point = DrawPoint(shape, rng);
    const Vector3d direction = DrawInCone(-shape.normal, test_.cone_angle(), rng);
    const auto hit = mesh_.FirstHit(point, direction, first);
    if (!hit || hit->distance > test_.max_width()) continue;
    if (Cone(mesh_.Normal(hit->face), test_.cone_angle()).Contains(direction)) {
      return Pair{first, hit->face};
    }
  }
  return std::nullopt;
}

}  // namespace antigrasp
