#include "antigrasp/perturb/mesh_change.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "antigrasp/core/rng.h"
#include "antigrasp/mesh/surface_sampler.h"
#include "antigrasp/perturb/face_pairs.h"
#include "antigrasp/sdf/mesh_to_sdf.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

constexpr double kDegrees = 180.0 / std::numbers::pi;

struct Distances {
  double largest = 0.0;
  double mean = 0.0;  // over area samples
};

Distances FromTo(const TriangleMesh& from, const TriangleMesh& to, int samples) {
  const MeshDistance distance(to);
  const SurfaceSampler surface(from);
  RngStream rng(0, "mesh_similarity");
  Distances out;
  for (int i = 0; i < samples; ++i) {
    const double d = distance.Unsigned(surface.Draw(&rng).point);
    out.largest = std::max(out.largest, d);
    out.mean += d / samples;
  }
  for (const Vector3d& vertex : from.vertices) {
    out.largest = std::max(out.largest, distance.Unsigned(vertex));
  }
  return out;
}

}  // namespace

NormalDeviation CompareNormals(const TriangleMesh& original, const TriangleMesh& changed) {
  if (original.faces != changed.faces) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    return {nan, nan};
  }
  NormalDeviation out;
  double weighted = 0.0, area = 0.0;
  for (std::size_t f = 0; f < original.faces.size(); ++f) {
    const FaceShape a(original, f), b(changed, f);
    if (a.normal.isZero() || b.normal.isZero()) continue;
    // The angle between the normals is the antipodality angle with one of them turned round.
    const double turn = kDegrees * AntipodalityAngle(a.normal, -b.normal);
    const double weight = FaceCross(original, f).norm();
    out.largest = std::max(out.largest, turn);
    weighted += weight * turn;
    area += weight;
  }
  out.mean = area > 0.0 ? weighted / area : 0.0;
  return out;
}

MeshChange CompareMeshes(const TriangleMesh& original, const TriangleMesh& changed, int samples) {
  MeshChange out;
  const double percent = 100.0 / Bounds(original).Extent().norm();
  const Distances there = FromTo(original, changed, samples);
  const Distances back = FromTo(changed, original, samples);
  out.hausdorff = percent * std::max(there.largest, back.largest);
  out.chamfer = percent * 0.5 * (there.mean + back.mean);
  const double volume = Volume(original);
  out.volume_change = 100.0 * (Volume(changed) - volume) / volume;
  out.center_of_mass = percent * (CenterOfMass(changed) - CenterOfMass(original)).norm();
  return out;
}

}  // namespace antigrasp
