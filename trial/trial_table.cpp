#include "antigrasp/trial/trial_table.h"

#include <algorithm>

#include "antigrasp/core/rng.h"
#include "antigrasp/mesh/place.h"
#include "antigrasp/quality/adaptive_draws.h"
#include "antigrasp/quality/local_object.h"
#include "antigrasp/quality/parallel_jaws.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

std::vector<NoiseDraw> Draws(const MetricOptions& metric, int count, RngStream* rng) {
  std::vector<NoiseDraw> draws;
  for (int i = 0; i < count; ++i) draws.push_back(DrawNoise(metric, rng));
  return draws;
}

}  // namespace

TrialTable::TrialTable(const TriangleMesh& mesh, double scale, const MetricOptions& metric,
                       const TableOptions& table)
    : place_(RoundPlace(mesh)),
      mesh_(MetresAbout(place_, mesh, scale)),
      scene_(mesh_),
      com_(CenterOfMass(mesh_)),
      poses_(StablePoses(mesh_, com_)),
      reach_(mesh_, scene_, metric, table),
      metric_(metric),
      scale_(scale) {
  metric_.object_min_extent = 0.0;  // mesh_ is in metres
  metric_.units = LengthUnit::kM;
}

std::size_t TrialTable::DrawPose(RngStream* rng) const {
  double rest = rng->Uniform();
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    rest -= poses_[i].probability;
    if (rest < 0.0) return i;
  }
  return poses_.size() - 1;  // rounding
}

TrialPlan TrialTable::BestUnused(std::uint64_t seed, std::uint64_t object, std::uint64_t series,
                                 int count, int executions) const {
  const std::uint64_t plan_seed = RngStream(seed, "trial-plan", object, series).NextU64();
  RngStream rng(seed, "trial", object, series);
  std::vector<ScoredGrasp> left = EvaluateGraspability(mesh_, metric_, plan_seed, object).grasps;
  std::stable_sort(left.begin(), left.end(), [](const ScoredGrasp& a, const ScoredGrasp& b) {
    return a.quality > b.quality;
  });
  TrialPlan plan;
  plan.wanted = plan.candidates = count;
  for (int i = 0; i < count; ++i) {
    const std::size_t pose = DrawPose(&rng);
    const auto best = std::find_if(left.begin(), left.end(), [&](ScoredGrasp& scored) {
      const auto approach = reach_.Approach(scored.grasp, poses_[pose]);
      if (approach) scored.grasp.approach = *approach;
      return approach.has_value();
    });
    if (best == left.end()) continue;
    plan.grasps.push_back({best->grasp, pose, best->quality, Draws(metric_, executions, &rng)});
    left.erase(best);
  }
  return plan;
}

TrialPlan TrialTable::All(std::uint64_t seed, std::uint64_t object, int executions) const {
  return Sample(seed, object, executions, false);
}

TrialPlan TrialTable::AllInTheAir(std::uint64_t seed, std::uint64_t object, int executions) const {
  return Sample(seed, object, executions, true);
}

TrialPlan TrialTable::Sample(std::uint64_t seed, std::uint64_t object, int executions,
                             bool in_the_air) const {
  TrialPlan plan;
  plan.wanted = metric_.num_grasps;
  const auto model = ParallelJaws({mesh_, scene_, com_}, metric_);
  if (model == nullptr) return plan;
  while (plan.candidates < metric_.max_attempts && std::ssize(plan.grasps) < plan.wanted) {
    const auto candidate = static_cast<std::uint64_t>(plan.candidates++);
    RngStream grasp_rng(seed, "grasp", object, candidate);
    std::size_t why = 0;
    auto grasp = model->Candidate(&grasp_rng, &why);
    if (!grasp) continue;
    if (std::any_of(plan.grasps.begin(), plan.grasps.end(), [&](const TrialGrasp& other) {
          return SameGrasp(*grasp, other.grasp, metric_.grasp_separation);
        }))
      continue;
    std::size_t pose = 0;
    if (in_the_air) {
      if (!model->Reach(&*grasp, &why)) continue;
    } else {
      RngStream pose_rng(seed, "pose", object, candidate);
      pose = DrawPose(&pose_rng);
      const auto approach = reach_.Approach(*grasp, poses_[pose]);
      if (!approach) continue;
      grasp->approach = *approach;
    }
    plan.grasps.push_back(
        Planned(*model, *grasp, pose, RngStream(seed, "noise", object, candidate), executions));
    plan.grasps.back().candidate = candidate;
  }
  return plan;
}

TrialGrasp TrialTable::Planned(const GraspModel& model, const Grasp& grasp, std::size_t pose,
                               RngStream noise, int executions) const {
  std::vector<NoisyGrasp> scored = {{grasp, noise}};  // with a stream of its own
  DrawAll(model, metric_, &scored);
  return {grasp, pose, scored.front().Mean(), Draws(metric_, executions, &noise)};
}

std::optional<std::size_t> TrialTable::PoseFor(Grasp* grasp) const {
  for (std::size_t pose = 0; pose < poses_.size(); ++pose) {  // the most probable first
    if (!grasp->approach.isZero(0.0)) {
      if (reach_.Reaches(*grasp, poses_[pose])) return pose;
    } else if (const auto approach = reach_.Approach(*grasp, poses_[pose])) {
      grasp->approach = *approach;
      return pose;
    }
  }
  return std::nullopt;
}

TrialPlan TrialTable::Proposed(const std::vector<ProposedGrasp>& grasps, std::uint64_t seed,
                               std::uint64_t object, int executions, bool in_the_air) const {
  TrialPlan plan;
  plan.wanted = plan.candidates = static_cast<int>(grasps.size());
  const auto model = ParallelJaws({mesh_, scene_, com_}, metric_);
  if (model == nullptr) return plan;
  for (std::size_t i = 0; i < grasps.size(); ++i) {
    Grasp grasp = grasps[i].grasp;
    const auto pose = in_the_air ? std::optional<std::size_t>(0) : PoseFor(&grasp);
    if (!pose) continue;
    plan.grasps.push_back(Planned(*model, grasp, *pose,
                                  RngStream(seed, "noise", object, grasps[i].number), executions));
    plan.grasps.back().place = i;
    plan.grasps.back().candidate = grasps[i].number;
  }
  return plan;
}

std::unique_ptr<const TrialTable> MakeTrialTable(const TriangleMesh& mesh,
                                                 const MetricOptions& metric,
                                                 const TableOptions& table, bool in_the_air) {
  MetricOptions one_candidate = metric;
  one_candidate.max_attempts = 1;
  const Graspability look = EvaluateGraspability(mesh, one_candidate, 0, 0);
  if (look.status == GraspabilityStatus::kNotEvaluable) return nullptr;
  auto made = std::make_unique<const TrialTable>(mesh, look.scale, metric, table);
  return in_the_air || !made->poses().empty() ? std::move(made) : nullptr;
}

}  // namespace antigrasp
