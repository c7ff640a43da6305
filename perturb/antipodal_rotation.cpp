#include "antigrasp/perturb/antipodal_rotation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "antigrasp/core/angles.h"
#include "antigrasp/perturb/decimate.h"
#include "antigrasp/perturb/pair_sampler.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

constexpr double kParallel = 1e-9;  // sine below which two directions count as parallel

Vector3d LongestEdge(const FaceShape& shape) {
  Vector3d longest = Vector3d::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d edge = shape.corner[(k + 1) % 3] - shape.corner[k];
    if (edge.squaredNorm() > longest.squaredNorm()) longest = edge;
  }
  return longest.normalized();
}

// The angle of the pair after its normals turned by theta and -theta.
double AngleAfter(const Vector3d& first, const Vector3d& second, const Vector3d& axis,
                  double theta) {
  return AntipodalityAngle(Eigen::AngleAxisd(theta, axis) * first,
                           Eigen::AngleAxisd(-theta, axis) * second);
}

class RotationRun {
 public:
  RotationRun(const PairLimits& pairs, const RotationOptions& options, EditableMesh* mesh,
              RngStream* rng, PerturbResult* result)
      : psi_(pairs.cone_angle),
        beta_(options.beta),
        mesh_(*mesh),
        sampler_(*mesh, pairs, options.pairs),
        rng_(*rng),
        result_(*result) {}

  // False when there is no pair left.
  bool Iterate() {
    const auto pair = sampler_.Draw(&rng_);
    if (!pair) return false;
    const FaceShape &first = mesh_.Shape(pair->first), &second = mesh_.Shape(pair->second);
    const double theta = beta_ * (psi_ - AntipodalityAngle(first.normal, second.normal));
    if (!(theta > 0.0)) {  // as far apart as asked for already
      ++result_.no_gain;
      return true;
    }
    const Vector3d axis = RotationAxis(first, second);
    const bool plus = AngleAfter(first.normal, second.normal, axis, theta) >=
                      AngleAfter(first.normal, second.normal, axis, -theta);
    const auto moves = RotateFaces(mesh_, pair->first, pair->second, axis, plus ? theta : -theta);
    const MoveVerdict verdict = mesh_.TryMove(moves);
    if (verdict != MoveVerdict::kOk) {
      ++result_.refused[static_cast<std::size_t>(verdict)];
      return true;
    }
    ++result_.moved;
    sampler_.Update(mesh_.ChangedFaces());
    mesh_.Commit();
    return true;
  }

 private:
  double psi_, beta_;
  EditableMesh& mesh_;
  PairSampler sampler_;
  RngStream& rng_;
  PerturbResult& result_;
};

}  // namespace

void Bind(OptionTable* table, RotationOptions* options) {
  RotationOptions& o = *options;
  table->Add("rotation.beta", &o.beta, 1e-6, 1.0,
             "share of the missing angle by which both faces turn (paper: 0.01, 0.075, 0.3)");
  table->Add("rotation.max_faces", &o.max_faces, 0, 1e9,
             "meshes with more faces are decimated to fewer; 0 = never");
  table->Add("rotation.iterations", &o.iterations, 0, 1e9,
             "iterations; 0 = iterations_per_face times the faces");
  table->Add("rotation.iterations_per_face", &o.iterations_per_face, 0.0, 1e6,
             "iterations per face of the decimated mesh; 0 = decimate only");
  table->Add("rotation.pairs", &o.pairs,
             "how pairs are drawn: uniform, area or ray (as grasps are)");
  table->Add("rotation.max_turn", &o.max_turn, 0.0, 180.0,
             "take back rotations that turn a face further than this, degrees");
}

Vector3d RotationAxis(const FaceShape& first, const FaceShape& second) {
  const Vector3d across = first.normal.cross(second.normal);
  if (across.norm() > kParallel) return across.normalized();
  const Vector3d between = second.center - first.center;
  const Vector3d sideways = first.normal.cross(between);
  if (sideways.norm() > kParallel * between.norm()) return sideways.normalized();
  return LongestEdge(first);
}

std::vector<VertexMove> RotateFaces(const EditableMesh& mesh, std::int32_t first,
                                    std::int32_t second, const Vector3d& axis, double theta) {
  std::vector<VertexMove> moves;
  const auto rotate = [&](std::int32_t face, double angle) {
    const Eigen::Matrix3d rotation = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
    const Vector3d& center = mesh.Shape(face).center;
    for (const std::int32_t v : mesh.mesh().faces[face]) {
      const Vector3d from = mesh.Position(v) - center;
      const Vector3d shift = rotation * from - from;
      const auto known = std::find_if(moves.begin(), moves.end(),
                                      [v](const VertexMove& move) { return move.vertex == v; });
      if (known != moves.end()) {
        known->to += shift;
      } else {
        moves.push_back({v, mesh.Position(v) + shift});
      }
    }
  };
  rotate(first, theta);
  rotate(second, -theta);
  return moves;
}

PerturbResult PerturbByRotation(const TriangleMesh& mesh, const PairLimits& pairs,
                                const PerturbOptions& common, const RotationOptions& options,
                                RngStream* rng, const ProgressFn& progress) {
  PerturbResult result;
  if (!BeginPerturbation(mesh, &result)) return result;
  if (options.max_faces > 0) {
    DecimateResult decimated = Decimate(result.start, options.max_faces);
    if (!decimated.failure.empty()) {
      result.failure = "decimated: " + decimated.failure;
      return result;
    }
    result.start = std::move(decimated.mesh);
  }
  MoveLimits limits = GuardLimits(common);
  if (!common.unchecked) limits.max_turn_from_start = options.max_turn * kDegree;
  EditableMesh work(result.start, limits);
  RotationRun run(pairs, options, &work, rng, &result);
  const auto iterations = options.iterations > 0
                              ? options.iterations
                              : std::llround(options.iterations_per_face * work.num_faces());
  const PerturbClock clock(iterations, common.history, pairs, progress);
  clock.Tick(work, 0, &result);
  while (result.iterations < iterations && !result.no_pairs_left) {
    result.no_pairs_left = !run.Iterate();
    clock.Tick(work, ++result.iterations, &result);
  }
  EndPerturbation(work, &result);
  return result;
}

}  // namespace antigrasp
