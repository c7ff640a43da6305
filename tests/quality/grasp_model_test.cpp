// A second hand: what the evaluation does for it shows what belongs to the parallel jaws alone.
#include "antigrasp/quality/grasp_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "antigrasp/mesh/convex_hull.h"
#include "antigrasp/mesh/surface_sampler.h"
#include "antigrasp/quality/graspability.h"
#include "tests/quality/rejected_counts.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

const Vector3d kUp = Vector3d::UnitZ();

// A suction cup that comes from above, presses on a point of the surface along its normal and has
// to carry the object by friction alone: it holds where the normal lies within the friction cone of
// gravity. Its quality is the cosine between them.
class Cup final : public GraspModel {
 public:
  Cup(const GraspObject& object, const MetricOptions& options)
      : object_(object), surface_(object.mesh), friction_(options.friction) {}

  std::vector<std::string> Reasons() const override { return {"too steep", "covered"}; }

  std::optional<Grasp> Candidate(RngStream* rng, std::size_t* why) const override {
    const SurfaceSampler::Sample sample = surface_.Draw(rng);
    *why = 0;
    if (!Holds(sample.normal, friction_)) return std::nullopt;
    Grasp grasp;
    grasp.contacts.fill({sample.point, sample.normal, 1.0});
    grasp.center = sample.point;
    grasp.axis = -sample.normal;
    return grasp;
  }

  bool Reach(Grasp* grasp, std::size_t* why) const override {
    *why = 1;
    grasp->approach = -kUp;
    const auto first = object_.scene.Closest(grasp->center + 10.0 * kUp, -kUp, 10.5);
    return first && (first->point - grasp->center).norm() < 1e-4;
  }

  double ExecutedQuality(const Grasp& grasp, const NoiseDraw& noise) const override {
    const JawPose pose = ExecutedPose(grasp, object_.com, noise);
    const auto hit = object_.scene.Closest(pose.center - 0.05 * pose.axis, pose.axis, 0.1);
    return hit && Holds(hit->normal, noise.friction) ? hit->normal.dot(kUp) : 0.0;
  }

 private:
  static bool Holds(const Vector3d& normal, double friction) {
    return normal.z() > 0.0 && !Slips(normal, kUp, friction);
  }

  GraspObject object_;
  SurfaceSampler surface_;
  double friction_;
};

std::unique_ptr<const GraspModel> MakeCup(const GraspObject& object, const MetricOptions& options) {
  return std::make_unique<const Cup>(object, options);
}

// A gable roof, 2 wide in y: from x = 0 it rises by 0.4 to the ridge at x = 1, and falls by 0.2 per
// metre to x = 3. A slab of 1 x 2 x 0.5 floats over the lower half of the gentle side.
TriangleMesh RoofUnderASlab() {
  std::vector<Vector3d> corners;
  for (const double y : {0.0, 2.0}) {
    corners.insert(corners.end(), {{0.0, y, 0.0}, {1.0, y, 0.4}, {3.0, y, 0.0}});
  }
  return shapes::Joined(ConvexHull(corners),
                        Transformed(shapes::Box({1.0, 2.0, 0.5}), 1.0, Vector3d(2.5, 1.0, 1.25)));
}

// Areas in square metres. Steep: the roof's base 6 and its two ends 1.2, the slab's underside 2 and
// its sides 3.
const double kSteepSide = 2.0 * std::sqrt(1.16), kGentleSide = std::sqrt(4.16), kTop = 2.0,
             kCovered = std::sqrt(4.16), kSteep = 12.2;
const double kSurface = kSteepSide + kGentleSide + kTop + kCovered + kSteep;
const double kSteepQuality = 1.0 / std::sqrt(1.16), kGentleQuality = 1.0 / std::sqrt(1.04);

MetricOptions WithoutNoise() {
  MetricOptions options;
  ApplyNoisePreset("none", &options);
  options.object_min_extent = 0.0;
  options.num_draws = 2;
  options.num_grasps = 1000;
  return options;
}

TEST(GraspModel, GivesTheCandidatesAndNamesTheReasonsOfTheRefusedOnes) {
  MetricOptions options = WithoutNoise();
  options.max_attempts = 3000;
  const Graspability g = EvaluateGraspability(RoofUnderASlab(), options, 1, 0, &MakeCup);
  EXPECT_EQ(g.attempts, 3000);
  ASSERT_EQ(g.rejected.reasons.size(), 2u);
  EXPECT_EQ(g.rejected.reasons[0].name, "too steep");
  EXPECT_EQ(g.rejected.reasons[1].name, "covered");
  EXPECT_EQ(g.rejected.copies, 0);
  EXPECT_EQ(CountOfAll(g.rejected) + static_cast<int>(g.grasps.size()), 3000);
  // Shares of the surface; three standard deviations of a share are at most 0.027.
  EXPECT_NEAR(g.rejected.Of("too steep") / 3000.0, kSteep / kSurface, 0.027);
  EXPECT_NEAR(g.rejected.Of("covered") / 3000.0, kCovered / kSurface, 0.027);
  for (const ScoredGrasp& scored : g.grasps) {
    EXPECT_EQ(scored.grasp.contacts[1].point, scored.grasp.contacts[0].point);
    EXPECT_EQ(scored.grasp.approach, -kUp);
  }
}

TEST(GraspModel, CopiesOfAOneContactGraspAreThoseNearItsPoint) {
  MetricOptions options = WithoutNoise();
  options.max_attempts = 3000;
  options.grasp_separation = 0.1;
  const Graspability g = EvaluateGraspability(RoofUnderASlab(), options, 1, 0, &MakeCup);
  EXPECT_GT(g.rejected.copies, 100);
  EXPECT_EQ(CountOfAll(g.rejected) + static_cast<int>(g.grasps.size()), 3000);
  for (std::size_t i = 0; i < g.grasps.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GE((g.grasps[i].grasp.center - g.grasps[j].grasp.center).norm(), 0.1);
    }
  }
}

TEST(GraspModel, GivesTheQualitiesWhosePercentileIsTheGraspability) {
  // Nearly equal thirds of the cup's grasps lie on the steep side, the gentle one and the slab.
  MetricOptions options = WithoutNoise();
  const auto value = [&](double percentile) {
    options.percentile = percentile;
    return EvaluateGraspability(RoofUnderASlab(), options, 1, 0, &MakeCup).value;
  };
  EXPECT_NEAR(value(20.0), kSteepQuality, 1e-6);
  EXPECT_NEAR(value(50.0), kGentleQuality, 1e-6);
  EXPECT_NEAR(value(80.0), 1.0, 1e-6);
  const Graspability g = EvaluateGraspability(RoofUnderASlab(), options, 1, 0, &MakeCup);
  EXPECT_EQ(g.status, GraspabilityStatus::kOk);
  EXPECT_EQ(g.fraction_nonzero, 1.0);
  const double mean = (kSteepSide * kSteepQuality + kGentleSide * kGentleQuality + kTop) /
                      (kSteepSide + kGentleSide + kTop);
  EXPECT_NEAR(g.mean, mean, 0.003);
}

TEST(GraspModel, IsExecutedUnderTheDrawsOfTheMetricsNoise) {
  // Friction 0.5 +- 0.1 holds a slope of 0.4 in Phi(1) = 84.1 % of the draws, of 0.2 in Phi(3).
  MetricOptions options = WithoutNoise();
  options.friction_std = 0.1;
  options.num_draws = 200;
  options.num_grasps = 300;
  const Graspability g = EvaluateGraspability(RoofUnderASlab(), options, 1, 0, &MakeCup);
  double steep = 0.0, gentle = 0.0, flat = 0.0;
  int steeps = 0, gentles = 0, flats = 0;
  for (const ScoredGrasp& scored : g.grasps) {
    EXPECT_EQ(scored.draws, 200);
    const double cosine = scored.grasp.contacts[0].normal.z();
    (cosine > 0.99 ? flat : cosine > 0.95 ? gentle : steep) += scored.quality;
    ++(cosine > 0.99 ? flats : cosine > 0.95 ? gentles : steeps);
  }
  ASSERT_GT(std::min({steeps, gentles, flats}), 80);
  EXPECT_NEAR(steep / steeps, 0.8413 * kSteepQuality, 0.009);
  EXPECT_NEAR(gentle / gentles, 0.9987 * kGentleQuality, 0.001);
  EXPECT_NEAR(flat / flats, 1.0, 1e-6);
}

TEST(GraspModel, IsDrawnAdaptivelyToo) {
  MetricOptions options = WithoutNoise();
  options.friction_std = 0.1;
  options.num_draws = 100;
  options.num_grasps = 100;
  options.percentile = 90.0;
  options.adaptive = true;
  const Graspability g = EvaluateGraspability(RoofUnderASlab(), options, 1, 0, &MakeCup);
  EXPECT_NEAR(g.value, 1.0, 1e-6);
  int few = 0, all = 0;
  for (const ScoredGrasp& scored : g.grasps) {
    few += scored.draws < 100 ? 1 : 0;
    all += scored.draws == 100 ? 1 : 0;
  }
  EXPECT_GT(few, 10);
  EXPECT_GT(all, 10);
}

TEST(GraspModel, ThatFindsNothingToGraspLeavesNoCandidateTried) {
  const auto none = [](const GraspObject&, const MetricOptions&) {
    return std::unique_ptr<const GraspModel>();
  };
  const Graspability g = EvaluateGraspability(shapes::Cube(), {}, 1, 0, none);
  EXPECT_EQ(g.status, GraspabilityStatus::kNoGrasps);
  EXPECT_EQ(g.value, 0.0);
  EXPECT_EQ(g.attempts, 0);
  EXPECT_TRUE(g.rejected.reasons.empty());
}

TEST(GraspModel, LooksAtTheObjectRescaledAboutItsCentreOfMass) {
  const auto look = [](const GraspObject& object, const MetricOptions&) {
    EXPECT_NEAR(object.com.x(), 0.005, 1e-12);  // a quarter of the edge, 0.02
    EXPECT_NEAR(Bounds(object.mesh).Extent().z(), 0.02, 1e-12);
    return std::unique_ptr<const GraspModel>();
  };
  MetricOptions options;
  options.object_min_extent = 0.02;
  EXPECT_EQ(EvaluateGraspability(shapes::Tetrahedron(), options, 1, 0, look).scale, 0.02);
}

TEST(RejectedGrasps, AddUpByNameInTheFirstOnesOrder) {
  RejectedGrasps sum;
  sum.Add({{{"slip", 2}, {"covered", 3}}, 4});
  sum.Add({});
  sum.Add({{{"covered", 10}, {"slip", 20}, {"too steep", 30}}, 40});
  ASSERT_EQ(sum.reasons.size(), 3u);
  EXPECT_EQ(sum.reasons[0].name, "slip");
  EXPECT_EQ(sum.reasons[0].count, 22);
  EXPECT_EQ(sum.reasons[1].name, "covered");
  EXPECT_EQ(sum.reasons[1].count, 13);
  EXPECT_EQ(sum.reasons[2].name, "too steep");
  EXPECT_EQ(sum.reasons[2].count, 30);
  EXPECT_EQ(sum.copies, 44);
  EXPECT_EQ(CountOfAll(sum), 109);
  EXPECT_EQ(sum.Of("covered"), 13);
  EXPECT_EQ(sum.Of("blocked"), 0);
}

}  // namespace
}  // namespace antigrasp
