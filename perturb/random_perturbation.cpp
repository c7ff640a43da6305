#include "antigrasp/perturb/random_perturbation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "antigrasp/core/angles.h"
#include "antigrasp/core/check.h"
#include "antigrasp/perturb/draw_direction.h"
#include "antigrasp/perturb/pair_sampler.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

// Steps end this share of alpha short of it, so that rounding the vertex to single precision hardly
// ever turns a face beyond.
constexpr double kMargin = 1e-3;
// A gain in the angle (radians) below this is rounding.
constexpr double kNoGain = 1e-9;

// A face's normal before normalising, (p - v) x (q - v), as its corner v moves by s * direction:
// start + s * step, because the product is linear in v.
struct MovingNormal {
  Vector3d start, step;

  MovingNormal(const EditableMesh& mesh, std::int32_t face, std::int32_t vertex,
               const Vector3d& direction) {
    const auto& corners = mesh.mesh().faces[face];
    const auto at = std::find(corners.begin(), corners.end(), vertex) - corners.begin();
    const Vector3d& p = mesh.Position(corners[(at + 1) % 3]);
    const Vector3d& q = mesh.Position(corners[(at + 2) % 3]);
    const Vector3d& v = mesh.Position(vertex);
    start = (p - v).cross(q - v);
    step = direction.cross(p - q);
  }
  Vector3d At(double s) const { return (start + s * step).normalized(); }

  // Where the angle to a fixed direction is stationary: the derivative of
  // (b . N) / |N| is linear in s. NaN or infinity when it never is.
  double Stationary(const Vector3d& b) const {
    const double c0 = b.dot(start), c1 = b.dot(step);
    const double q0 = start.squaredNorm(), q1 = start.dot(step), q2 = step.squaredNorm();
    return (c1 * q0 - c0 * q1) / (c0 * q2 - c1 * q1);
  }
};

bool Holds(const EditableMesh& mesh, std::int32_t face, std::int32_t vertex) {
  const auto& corners = mesh.mesh().faces[face];
  return std::find(corners.begin(), corners.end(), vertex) != corners.end();
}

struct Candidate {
  Vector3d direction;
  Step step;
};

class RandomRun {
 public:
  RandomRun(const PairLimits& pairs, const RandomPerturbOptions& options, EditableMesh* mesh,
            RngStream* rng, PerturbResult* result)
      : options_(options),
        rule_(options.step),
        from_start_(options.limit == NormalLimit::kOriginal),
        mesh_(*mesh),
        sampler_(*mesh, pairs, options.pairs),
        rng_(*rng),
        result_(*result) {}

  // False when there is no pair left.
  bool Iterate() {
    const auto pair = sampler_.Draw(&rng_);
    if (!pair) return false;
    const std::uint64_t corner = rng_.Below(6);
    const std::int32_t face = corner < 3 ? pair->first : pair->second;
    const std::int32_t vertex = mesh_.mesh().faces[face][corner % 3];
    const auto chosen = Choose(*pair, vertex);
    if (!chosen) {
      ++result_.no_gain;
      return true;
    }
    const MoveVerdict verdict =
        mesh_.TryMove(vertex, mesh_.Position(vertex) + chosen->step.length * chosen->direction);
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
  std::optional<Candidate> Choose(const PairSampler::Pair& pair, std::int32_t vertex) {
    const double angle = options_.alpha * kDegree * (1.0 - kMargin);
    const double now = AntipodalityAngle(mesh_.Normal(pair.first), mesh_.Normal(pair.second));
    std::optional<Candidate> best;
    bool some_without_gain = false;
    for (int i = 0; i < options_.directions; ++i) {
      Candidate candidate{DrawDirection(&rng_), {}};
      const Range range = AllowedSteps(mesh_, vertex, candidate.direction, angle, from_start_,
                                       {0.0, options_.max_step * mesh_.mean_edge()});
      if (!range.empty()) {
        candidate.step =
            BestStep(mesh_, pair.first, pair.second, vertex, candidate.direction, range);
      }
      if (!(candidate.step.length > 0.0) || candidate.step.angle <= now + kNoGain) {
        some_without_gain = true;
      } else if (!best || Better(candidate.step, best->step)) {
        best = candidate;
      }
    }
    if (rule_ == StepRule::kSmallestOrNone && some_without_gain) return std::nullopt;
    return best;
  }

  bool Better(const Step& a, const Step& b) const {
    switch (rule_) {
      case StepRule::kSmallest:
      case StepRule::kSmallestOrNone:
        return a.length < b.length;
      case StepRule::kLargestAngle:
        return a.angle > b.angle;
      case StepRule::kLargest:
        return a.length > b.length;
    }
    AG_CHECK(false, "unknown step rule");
  }

  const RandomPerturbOptions& options_;
  StepRule rule_;
  bool from_start_;
  EditableMesh& mesh_;
  PairSampler sampler_;
  RngStream& rng_;
  PerturbResult& result_;
};

}  // namespace

void Bind(OptionTable* table, RandomPerturbOptions* options) {
  RandomPerturbOptions& o = *options;
  table->Add("random.alpha", &o.alpha, 0.0, 89.0,
             "largest deviation of a face normal, degrees (paper: 10, 15, 20)");
  table->Add("random.limit", &o.limit,
             "deviation from the normals of the original, or from those before each step");
  table->Add("random.step", &o.step, "which of the steps along the six directions is taken");
  table->Add("random.pairs", &o.pairs, "how pairs are drawn: ray (as grasps are), uniform or area");
  table->Add("random.directions", &o.directions, 1, 1000,
             "random directions tried in an iteration");
  table->Add("random.iterations", &o.iterations, 0, 1e9,
             "iterations; 0 = iterations_per_vertex times the vertices");
  table->Add("random.iterations_per_vertex", &o.iterations_per_vertex, 0.0, 1e6,
             "iterations per vertex of the mesh");
  table->Add("random.max_step", &o.max_step, 1e-9, 1e3, "longest step, mean edge lengths");
}

Range AllowedSteps(const EditableMesh& mesh, std::int32_t vertex, const Vector3d& direction,
                   double angle, bool from_start, Range within) {
  for (const std::int32_t face : mesh.FacesOf(vertex)) {
    const MovingNormal normal(mesh, face, vertex, direction);
    const Cone cone(from_start ? mesh.StartNormal(face) : mesh.Normal(face), angle);
    within = ClipToCone(normal.start, normal.step, cone, within);
    if (within.empty()) break;
  }
  return within;
}

Step BestStep(const EditableMesh& mesh, std::int32_t first, std::int32_t second,
              std::int32_t vertex, const Vector3d& direction, Range within) {
  const bool in_first = Holds(mesh, first, vertex), in_second = Holds(mesh, second, vertex);
  AG_CHECK(in_first || in_second, "a corner of the pair");
  Step best{within.low, -1.0};
  const auto offer = [&](double s, double angle) {
    if (angle > best.angle) best = {s, angle};
  };
  if (in_first && in_second) {
    constexpr int kSamples = 64;
    const MovingNormal a(mesh, first, vertex, direction), b(mesh, second, vertex, direction);
    for (int i = 0; i <= kSamples; ++i) {
      const double s = within.low + (within.high - within.low) * i / kSamples;
      offer(s, AntipodalityAngle(a.At(s), b.At(s)));
    }
    return best;
  }
  const MovingNormal moving(mesh, in_first ? first : second, vertex, direction);
  const Vector3d& fixed = mesh.Normal(in_first ? second : first);
  for (const double s : {within.low, moving.Stationary(fixed), within.high}) {
    if (s >= within.low && s <= within.high) offer(s, AntipodalityAngle(moving.At(s), fixed));
  }
  return best;
}

PerturbResult PerturbRandomly(const TriangleMesh& mesh, const PairLimits& pairs,
                              const PerturbOptions& common, const RandomPerturbOptions& options,
                              RngStream* rng, const ProgressFn& progress) {
  PerturbResult result;
  if (!BeginPerturbation(mesh, &result)) return result;
  MoveLimits limits = GuardLimits(common);
  const double alpha = options.alpha * kDegree;
  if (options.limit == NormalLimit::kOriginal) {
    limits.max_turn_from_start = alpha;
  } else {
    limits.max_turn_per_move = alpha;
  }
  EditableMesh work(result.start, limits);
  RandomRun run(pairs, options, &work, rng, &result);
  const auto iterations = options.iterations > 0
                              ? options.iterations
                              : std::llround(options.iterations_per_vertex * work.num_vertices());
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
