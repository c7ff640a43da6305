#include "antigrasp/quality/parallel_jaws.h"

#include "antigrasp/quality/antipodal_sampler.h"
#include "antigrasp/quality/reachability.h"
#include "antigrasp/quality/robust_quality.h"
#include "antigrasp/quality/tip_quality.h"

namespace antigrasp {
namespace {

enum Reason : std::size_t { kNothing, kSlip, kBlocked, kCollides };

Reason ReasonOf(GraspRejection why) {
  switch (why) {
    case GraspRejection::kNoOpposite:
      return kNothing;
    case GraspRejection::kSlips:
      return kSlip;
    case GraspRejection::kJawBlocked:
      break;
  }
  return kBlocked;
}

class Jaws final : public GraspModel {
 public:
  Jaws(const GraspObject& object, const MetricOptions& options, AntipodalSampler sampler)
      : object_(object), options_(options), sampler_(std::move(sampler)) {
    if (options.collision == Collision::kGripper)
      gripper_.emplace(object.mesh, object.scene, options.gripper);
    if (TipQuality::Judges(options)) tips_.emplace(object, options);
  }

  std::vector<std::string> Reasons() const override {
    return {kTooWide, "slip", "jaw blocked", "gripper collides"};
  }

  std::optional<Grasp> Candidate(RngStream* rng, std::size_t* why) const override {
    GraspRejection rejection{};
    auto grasp = sampler_.Try(rng, &rejection);
    if (!grasp) *why = ReasonOf(rejection);
    return grasp;
  }

  // Without a gripper nothing is looked for.
  bool Reach(Grasp* grasp, std::size_t* why) const override {
    if (!gripper_) return true;
    const auto approach = gripper_->FreeApproach(*grasp, options_.jaw_opening);
    if (approach) grasp->approach = *approach;
    *why = kCollides;
    return approach.has_value();
  }

  double ExecutedQuality(const Grasp& grasp, const NoiseDraw& noise) const override {
    if (tips_) return tips_->Executed(grasp, noise);
    return antigrasp::ExecutedQuality(object_.scene, object_.com, grasp, options_, noise);
  }

  void ExecutedQualities(const Grasp& grasp, std::span<const NoiseDraw> draws,
                         std::span<double> qualities) const override {
    if (tips_) return GraspModel::ExecutedQualities(grasp, draws, qualities);
    antigrasp::ExecutedQualities(object_.scene, object_.com, grasp, options_, draws, qualities);
  }

 private:
  GraspObject object_;
  MetricOptions options_;
  AntipodalSampler sampler_;
  std::optional<GripperCollision> gripper_;
  std::optional<TipQuality> tips_;
};

}  // namespace

std::unique_ptr<const GraspModel> ParallelJaws(const GraspObject& object,
                                               const MetricOptions& options) {
  AntipodalSampler sampler(object.mesh, object.scene, options.friction, options.jaw_opening);
  if (!(sampler.area() > 0.0)) return nullptr;
  return std::make_unique<const Jaws>(object, options, std::move(sampler));
}

}  // namespace antigrasp
