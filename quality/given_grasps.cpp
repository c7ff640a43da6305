#include "antigrasp/quality/given_grasps.h"

#include <cmath>

#include "antigrasp/core/rng.h"
#include "antigrasp/mesh/ray_scene.h"
#include "antigrasp/quality/adaptive_draws.h"
#include "antigrasp/quality/jaw_closing.h"
#include "antigrasp/quality/local_object.h"
#include "antigrasp/quality/parallel_jaws.h"
#include "antigrasp/quality/reachability.h"
#include "antigrasp/quality/robust_quality.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

constexpr double kRounding = 1e-9;  // m, and of a direction
constexpr double kNoDirection = 1e-6;
constexpr double kFarthest = 1e6;  // m: rays are cast in single precision
constexpr double kFar = 1e18;      // m, which no object reaches (local_object.h)
constexpr const char* kNotEvaluable = "not evaluable";

// Unit; as it is when it is one already, so that it keeps its bits.
Vector3d Unit(const Vector3d& v) {
  return std::abs(v.norm() - 1.0) < kRounding ? v : Vector3d(v.stableNormalized());
}

class Scorer {
 public:
  Scorer(const LocalObject& object, const MetricOptions& options, std::uint64_t seed,
         std::uint64_t stream)
      : object_(object),
        options_(options),
        seed_(seed),
        stream_(stream),
        scene_(object.mesh),
        com_(CenterOfMass(object.mesh)),
        model_(ParallelJaws({object_.mesh, scene_, com_}, options_)) {
    if (options.collision == Collision::kGripper) {
      gripper_.emplace(object.mesh, scene_, options.gripper);
    }
  }

  std::vector<GivenScore> Score(const std::vector<GivenGrasp>& given) const {
    std::vector<GivenScore> scores;
    std::vector<NoisyGrasp> noisy;
    for (const GivenGrasp& one : given) {
      scores.push_back(Planned(one));
      if (!scores.back().scored()) continue;
      noisy.push_back(
          {scores.back().grasp, RngStream(seed_, "noise", stream_, one.candidate), one.candidate});
    }
    if (!noisy.empty()) Draw(*model_, options_, &noisy);
    auto next = noisy.begin();
    for (GivenScore& score : scores) {
      if (score.scored()) score.robust_quality = (next++)->Mean();
    }
    return scores;
  }

 private:
  // What is known of it without noise.
  GivenScore Planned(const GivenGrasp& given) const {
    GivenScore score;
    score.status = Pose(given, &score.grasp);
    if (model_ == nullptr) score.status = kNotEvaluable;
    if (!score.scored()) return score;
    const auto contacts = CloseJaws(scene_, score.grasp.center, score.grasp.axis,
                                    options_.jaw_opening, options_.friction);
    if (contacts) {
      score.grasp.contacts = *contacts;
      const double width = ((*contacts)[1].point - (*contacts)[0].point).norm();
      if (!(score.grasp.width > 0.0)) score.grasp.width = width;  // a candidate has its own
      score.epsilon = Epsilon(*contacts, com_, WrenchModelOf(options_, options_.friction));
    } else {
      score.status = WhyNot(score.grasp);
    }
    Reach(&score);
    return score;
  }

  // Of jaws that do not close. The first face in front of a jaw that starts inside is seen from
  // behind, however deep it is.
  const char* WhyNot(const Grasp& grasp) const {
    bool meet = true;
    for (const Vector3d& closing : {grasp.axis, Vector3d(-grasp.axis)}) {
      const double way = 0.5 * options_.jaw_opening;
      const Vector3d start = grasp.center - way * closing;
      const auto hit = scene_.Closest(start, closing, kFar);
      if (hit && !hit->front) return GivenScore::kStartsInside;
      meet = meet && hit && hit->distance <= way;
    }
    return meet ? GivenScore::kSlips : GivenScore::kMisses;
  }

  // "ok", or why it is no pose of this gripper.
  std::string Pose(const GivenGrasp& given, Grasp* grasp) const {
    constexpr const char* kNoPose = "no pose";
    const bool metres = given.frame == GraspFrame::kMetres;
    const double unit = metres ? given.metres_per_unit : 1.0;  // of the table's, a mesh unit
    if (!given.center.allFinite() || !given.axis.allFinite() || !given.approach.allFinite() ||
        !std::isfinite(given.width) || !(given.width >= 0.0) || !(unit > 0.0) ||
        !std::isfinite(unit)) {
      return kNoPose;
    }
    if (!(given.axis.stableNorm() > 0.0)) return kNoPose;
    grasp->center = object_.scale * (given.center / unit - object_.place);
    if (!(grasp->center.stableNorm() < kFarthest)) return kNoPose;
    grasp->axis = Unit(given.axis);
    if (given.approach.stableNorm() > 0.0) {
      const Vector3d way = Unit(given.approach), across = way - way.dot(grasp->axis) * grasp->axis;
      if (across.norm() < kNoDirection) return kNoPose;
      grasp->approach = (way - across).norm() < kRounding ? way : across.normalized();
    }
    if (given.of_a_candidate) TakeCandidate(given.candidate, grasp);
    const double width = object_.scale * given.width / unit;
    return width > options_.jaw_opening + kRounding ? "too wide" : GivenScore::kOk;
  }

  // Digits that the frame of the table took.
  void TakeCandidate(std::uint64_t number, Grasp* grasp) const {
    if (model_ == nullptr) return;
    RngStream rng(seed_, "grasp", stream_, number);
    std::size_t why = 0;
    const std::optional<Grasp> candidate = model_->Candidate(&rng, &why);
    if (!candidate || (candidate->center - grasp->center).norm() > kRounding ||
        (candidate->axis - grasp->axis).norm() > kRounding) {
      return;
    }
    const Vector3d approach = grasp->approach;
    *grasp = *candidate;
    grasp->approach = approach;
  }

  void Reach(GivenScore* score) const {
    if (!gripper_) return;
    if (!score->grasp.approach.isZero(0.0)) {
      score->reachable =
          gripper_->IsFree(score->grasp, options_.jaw_opening, score->grasp.approach);
      return;
    }
    const auto found = gripper_->FreeApproach(score->grasp, options_.jaw_opening);
    if (found) score->grasp.approach = *found;
    score->reachable = found.has_value();
  }

  const LocalObject& object_;
  const MetricOptions& options_;
  std::uint64_t seed_, stream_;
  RayScene scene_;
  Vector3d com_;
  std::unique_ptr<const GraspModel> model_;
  std::optional<GripperCollision> gripper_;
};

}  // namespace

std::vector<GivenScore> ScoreGivenGrasps(const TriangleMesh& mesh,
                                         const std::vector<GivenGrasp>& grasps,
                                         const MetricOptions& options, std::uint64_t seed,
                                         std::uint64_t object) {
  const std::optional<LocalObject> local = MakeLocalObject(mesh, options);
  if (!local) {
    GivenScore none;
    none.status = kNotEvaluable;
    return std::vector<GivenScore>(grasps.size(), none);
  }
  return Scorer(*local, options, seed, object).Score(grasps);
}

}  // namespace antigrasp
