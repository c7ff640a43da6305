#include "antigrasp/perturb/search_objective.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "antigrasp/mesh/ray_scene.h"
#include "antigrasp/quality/antipodal_sampler.h"
#include "antigrasp/quality/reachability.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

constexpr int kCandidatesPerGrasp = 20;
// Cosines are kept off 0 and 1 where the tangent or its derivative has no bound.
constexpr double kLeastCosine = 0.02;
constexpr double kLeastSine2 = 1e-4;

double Cumulative(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }
double Density(double z) {
  return std::exp(-0.5 * z * z) * std::numbers::inv_sqrtpi / std::numbers::sqrt2;
}

double TangentOf(double cosine) {
  const double c = std::max(cosine, kLeastCosine);
  return std::sqrt(std::max(0.0, 1.0 - c * c)) / c;
}

// What both jaws meet along every pose, which lie beside each other; nullopt where one meets
// nothing or starts inside.
std::vector<std::optional<Closing>> CloseTogether(const RayScene& scene,
                                                  const std::vector<JawPose>& poses,
                                                  const Vector3d& com,
                                                  const MetricOptions& metric) {
  const double way = 0.5 * metric.jaw_opening;
  std::vector<std::optional<Closing>> closings(poses.size(), Closing{});
  std::vector<Ray> rays;
  std::vector<std::size_t> of;
  std::vector<std::optional<RayHit>> hits(poses.size());
  NearFaces near;
  for (std::size_t jaw = 0; jaw < 2; ++jaw) {
    rays.clear();
    of.clear();
    for (std::size_t i = 0; i < poses.size(); ++i) {
      if (!closings[i]) continue;
      const Vector3d direction = jaw == 0 ? poses[i].axis : Vector3d(-poses[i].axis);
      rays.push_back({poses[i].center - way * direction, direction, way});
      of.push_back(i);
    }
    scene.Near(rays, &near);
    scene.Closest(rays, near, hits);
    for (std::size_t k = 0; k < rays.size(); ++k) {
      auto& closing = closings[of[k]];
      if (hits[k] && hits[k]->front) {
        closing->face[jaw] = static_cast<std::int32_t>(hits[k]->face);
      } else {
        closing.reset();
      }
    }
  }
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (!closings[i]) continue;
    const double torque = metric.torque_scale * (poses[i].center - com).cross(poses[i].axis).norm();
    closings[i]->axis = poses[i].axis;
    closings[i]->reach = 1.0 / std::sqrt(1.0 + torque * torque);
  }
  return closings;
}

// Friction coefficients as a normal distribution.
struct Friction {
  double mean, deviation;
};

// Where friction has to be large enough: the larger tangent of the two contacts.
struct Slope {
  std::size_t jaw = 0;
  double cosine = 1.0;
  double tangent = 0.0;
};

Vector3d DirectionOf(const Closing& closing, std::size_t jaw) {
  return jaw == 0 ? closing.axis : Vector3d(-closing.axis);
}

Slope SteeperContact(const Closing& closing, const std::vector<Vector3d>& normals) {
  Slope steeper;
  for (std::size_t jaw = 0; jaw < 2; ++jaw) {
    const auto face = static_cast<std::size_t>(closing.face[jaw]);
    const double cosine = -DirectionOf(closing, jaw).dot(normals[face]);
    if (jaw == 0 || cosine < steeper.cosine) steeper = {jaw, cosine, TangentOf(cosine)};
  }
  return steeper;
}

double Holds(const Closing& closing, const std::vector<Vector3d>& normals,
             const Friction& friction) {
  const Slope slope = SteeperContact(closing, normals);
  return Cumulative((friction.mean - slope.tangent) / friction.deviation);
}

// Adds factor * d Holds / d normal.
void AddDerivative(const Closing& closing, const std::vector<Vector3d>& normals,
                   const Friction& friction, double factor, std::vector<Vector3d>* by_normal) {
  const Slope slope = SteeperContact(closing, normals);
  const double by_tangent =
      -Density((friction.mean - slope.tangent) / friction.deviation) / friction.deviation;
  const double c = std::max(slope.cosine, kLeastCosine);
  const double by_cosine = -1.0 / (c * c * std::sqrt(std::max(kLeastSine2, 1.0 - c * c)));
  const auto face = static_cast<std::size_t>(closing.face[slope.jaw]);
  (*by_normal)[face] -= factor * by_tangent * by_cosine * DirectionOf(closing, slope.jaw);
}

struct Weighted {
  double quality, weight;
};

// The smallest quality with this share of the weight at or below it.
double WeightedPercentile(std::vector<Weighted> values, double share) {
  std::sort(values.begin(), values.end(), [](const Weighted& a, const Weighted& b) {
    return a.quality < b.quality || (a.quality == b.quality && a.weight < b.weight);
  });
  double total = 0.0, below = 0.0;
  for (const Weighted& v : values) total += v.weight;
  for (const Weighted& v : values) {
    below += v.weight;
    if (below >= share * total) return v.quality;
  }
  return values.empty() ? 0.0 : values.back().quality;
}

// The root of the increasing function sum w_i (Phi((v - Q_i) / h) - share), by bisection.
double SmoothedPercentile(const std::vector<Weighted>& values, double share, double kernel) {
  double low = -10.0 * kernel, high = 10.0 * kernel;
  for (const Weighted& v : values) high = std::max(high, v.quality + 10.0 * kernel);
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    double sum = 0.0;
    for (const Weighted& v : values) {
      sum += v.weight * (Cumulative((middle - v.quality) / kernel) - share);
    }
    (sum < 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

std::vector<AttackGrasp> SampleAttackGrasps(const TriangleMesh& mesh, const MetricOptions& metric,
                                            const ObjectiveOptions& options,
                                            const std::vector<NoiseDraw>& pool, std::uint64_t seed,
                                            std::uint64_t step) {
  std::vector<AttackGrasp> grasps;
  const RayScene scene(mesh);
  const Vector3d com = CenterOfMass(mesh);
  const AntipodalSampler sampler(mesh, scene, metric.friction + options.cone_width,
                                 metric.jaw_opening);
  if (!(sampler.area() > 0.0)) return grasps;
  std::optional<GripperCollision> gripper;
  if (metric.collision == Collision::kGripper) gripper.emplace(mesh, scene, metric.gripper);
  const auto wanted = static_cast<std::size_t>(options.grasps);
  for (std::uint64_t i = 0; i < kCandidatesPerGrasp * wanted && grasps.size() < wanted; ++i) {
    RngStream rng(seed, "search", step, i);
    const auto grasp = sampler.Try(&rng);
    if (!grasp || (gripper && !gripper->FreeApproach(*grasp, metric.jaw_opening))) continue;
    std::vector<JawPose> poses{{grasp->center, grasp->axis}};
    for (int draw = 0; draw < options.draws; ++draw) {
      poses.push_back(ExecutedPose(*grasp, com, pool[rng.Below(pool.size())]));
    }
    const auto closings = CloseTogether(scene, poses, com, metric);
    if (!closings.front()) continue;
    AttackGrasp attack{*closings.front(), {}};
    for (std::size_t draw = 1; draw < closings.size(); ++draw) {
      if (closings[draw]) attack.executed.push_back(*closings[draw]);
    }
    grasps.push_back(std::move(attack));
  }
  return grasps;
}

SmoothPercentile EvaluateObjective(const std::vector<AttackGrasp>& grasps,
                                   const std::vector<Vector3d>& normals,
                                   const MetricOptions& metric, const ObjectiveOptions& options) {
  SmoothPercentile result;
  result.by_normal.assign(normals.size(), Vector3d::Zero());
  const Friction planned{metric.friction, options.acceptance_softness};
  // Epsilon's cones are pyramids inside the round ones: half way between their faces and edges.
  const double pyramid = 0.5 * (1.0 + std::cos(std::numbers::pi / metric.cone_edges));
  const Friction executed{pyramid * metric.friction,
                          std::hypot(metric.friction_std, options.slip_softness)};
  std::vector<Weighted> values;
  for (const AttackGrasp& grasp : grasps) {
    double sum = 0.0;
    for (const Closing& c : grasp.executed) sum += c.reach * Holds(c, normals, executed);
    values.push_back({sum / options.draws, Holds(grasp.planned, normals, planned)});
  }
  const double share = metric.percentile / 100.0;
  const double kernel = options.percentile_softness * WeightedPercentile(values, share);
  if (!(kernel > 0.0)) return result;
  const double v = result.value = SmoothedPercentile(values, share, kernel);
  double density = 0.0;
  for (const Weighted& x : values) density += x.weight * Density((v - x.quality) / kernel) / kernel;
  if (!(density > 0.0)) return result;
  for (std::size_t i = 0; i < grasps.size(); ++i) {
    const double z = (v - values[i].quality) / kernel;
    const double by_quality = values[i].weight * Density(z) / (kernel * density);
    const double by_weight = -(Cumulative(z) - share) / density;
    for (const Closing& c : grasps[i].executed) {
      AddDerivative(c, normals, executed, by_quality * c.reach / options.draws, &result.by_normal);
    }
    AddDerivative(grasps[i].planned, normals, planned, by_weight, &result.by_normal);
  }
  return result;
}

MeanHold EvaluateMeanHold(const std::vector<AttackGrasp>& grasps,
                          const std::vector<Vector3d>& normals, const MetricOptions& metric,
                          const ObjectiveOptions& options) {
  MeanHold result;
  result.by_normal.assign(normals.size(), Vector3d::Zero());
  const Friction planned{metric.friction, options.acceptance_softness};
  const Friction executed{metric.friction, std::hypot(metric.friction_std, options.slip_softness)};
  std::vector<Weighted> values;
  double weight = 0.0;
  for (const AttackGrasp& grasp : grasps) {
    double sum = 0.0;
    for (const Closing& c : grasp.executed) sum += Holds(c, normals, executed);
    values.push_back({sum / options.draws, Holds(grasp.planned, normals, planned)});
    weight += values.back().weight;
    result.value += values.back().weight * values.back().quality;
  }
  if (!(weight > 0.0)) return result;
  result.value /= weight;
  for (std::size_t i = 0; i < grasps.size(); ++i) {
    const double by_hold = values[i].weight / weight / options.draws;
    for (const Closing& c : grasps[i].executed) {
      AddDerivative(c, normals, executed, by_hold, &result.by_normal);
    }
    AddDerivative(grasps[i].planned, normals, planned, (values[i].quality - result.value) / weight,
                  &result.by_normal);
  }
  return result;
}

std::vector<Vector3d> DerivativeByVertices(const TriangleMesh& mesh,
                                           const std::vector<Vector3d>& by_normal) {
  std::vector<Vector3d> by_vertex(mesh.vertices.size(), Vector3d::Zero());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Vector3d cross = FaceCross(mesh, f);
    const double length = cross.norm();
    if (by_normal[f].isZero() || !(length > 0.0)) continue;
    const Vector3d normal = cross / length;
    const Vector3d by_cross = (by_normal[f] - normal * normal.dot(by_normal[f])) / length;
    std::array<std::size_t, 3> at{};
    for (std::size_t k = 0; k < 3; ++k) at[k] = static_cast<std::size_t>(mesh.faces[f][k]);
    // The product (b - a) x (c - a) changes with corner k by (next - next but one) x.
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3d opposite = mesh.vertices[at[(k + 1) % 3]] - mesh.vertices[at[(k + 2) % 3]];
      by_vertex[at[k]] += opposite.cross(by_cross);
    }
  }
  return by_vertex;
}

std::vector<Vector3d> FaceNormals(const TriangleMesh& mesh) {
  std::vector<Vector3d> normals;
  normals.reserve(mesh.faces.size());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    normals.push_back(FaceCross(mesh, f).normalized());
  }
  return normals;
}

}  // namespace antigrasp
