// The trial of trial.h told once more from its parts, and its options by name.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "antigrasp/core/rng.h"
#include "antigrasp/mesh/convex_hull.h"
#include "antigrasp/quality/epsilon.h"
#include "antigrasp/quality/force_closure.h"
#include "antigrasp/quality/graspability.h"
#include "antigrasp/quality/jaw_closing.h"
#include "antigrasp/quality/robust_quality.h"
#include "antigrasp/trial/model_trial.h"
#include "tests/quality/option_lines.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

// The first pose whose probability and those before it are above u: of .5, .3 and .2, u = .75 draws
// the second and u = .85 the third.
const StablePose& PoseAt(const std::vector<StablePose>& poses, double u) {
  double sum = 0.0;
  for (const StablePose& pose : poses) {
    sum += pose.probability;
    if (u < sum) return pose;
  }
  return poses.back();
}

struct Told {
  int found = 0, planned = 0, closed = 0, held = 0;
  double confidence = 0.0;
};

// One object in metres with all that a trial asks of it.
struct Object {
  TriangleMesh mesh;
  RayScene scene;
  Vector3d com;
  std::vector<StablePose> poses;
  TableReach reach;
  MetricOptions metric;
  TrialOptions options;

  Object(const TriangleMesh& in_metres, const MetricOptions& m, const TrialOptions& o)
      : mesh(in_metres),
        scene(mesh),
        com(CenterOfMass(mesh)),
        poses(StablePoses(mesh, com)),
        reach(mesh, scene, m, o.table),
        metric(m),
        options(o) {
    metric.object_min_extent = 0.0;
  }

  void Execute(const Grasp& grasp, const NoiseDraw& noise, int* closed, int* held) const {
    const JawPose pose = ExecutedPose(grasp, com, noise);
    const auto contacts =
        CloseJaws(scene, pose.center, pose.axis, metric.jaw_opening, noise.friction);
    if (!contacts || !ForceClosure(*contacts, noise.friction, NormalSense::kOutward)) return;
    ++*closed;
    const double epsilon = Epsilon(*contacts, com,
                                   {noise.friction, metric.cone_edges, metric.finger_radius,
                                    metric.torque_scale, Torsion::kUniformPressure});
    *held += epsilon > options.min_epsilon ? 1 : 0;
  }

  void Series(std::uint64_t seed, std::uint64_t object, std::uint64_t number, Told* told) const {
    const std::uint64_t plan = RngStream(seed, "trial-plan", object, number).NextU64();
    auto grasps = EvaluateGraspability(mesh, metric, plan, object).grasps;
    RngStream rng(seed, "trial", object, number);
    for (int i = 0; i < options.grasps_per_series; ++i) {
      const StablePose& pose = PoseAt(poses, rng.Uniform());
      std::size_t best = grasps.size();
      for (std::size_t k = 0; k < grasps.size(); ++k) {
        if (best < grasps.size() && grasps[k].quality <= grasps[best].quality) continue;
        if (reach.Approach(grasps[k].grasp, pose)) best = k;
      }
      if (best == grasps.size()) continue;
      ++told->found;
      told->confidence += grasps[best].quality;
      NoiseDraw as_planned;
      as_planned.friction = metric.friction;
      int unused = 0;
      Execute(grasps[best].grasp, as_planned, &unused, &told->planned);
      for (int k = 0; k < options.executions; ++k) {
        Execute(grasps[best].grasp, DrawNoise(metric, &rng), &told->closed, &told->held);
      }
      grasps.erase(grasps.begin() + static_cast<std::ptrdiff_t>(best));
    }
  }
};

// A box with a roof that leans to one side: no symmetry but that across x, the centre of mass off
// the bounding box's. Its smallest extent is 4.
TriangleMesh House() {
  std::vector<Vector3d> corners = shapes::Box({4.0, 6.0, 5.0}).vertices;
  corners.emplace_back(0.3, 2.0, 5.5);
  return ConvexHull(corners);
}

MetricOptions UnusualMetric() {
  MetricOptions metric;
  metric.friction = 0.4;
  metric.cone_edges = 5;
  metric.torsion = Torsion::kUniformPressure;
  metric.finger_radius = 0.0003;  // torsion 2/3 r mu by the torque scale: 0.016
  metric.torque_scale = 200.0;
  metric.object_min_extent = 0.042;
  metric.jaw_opening = 0.055;
  metric.num_grasps = 12;
  metric.num_draws = 3;
  metric.object_translation_std = 0.004;
  return metric;
}

TEST(RunTrials, IsItsStepsOneByOne) {
  const MetricOptions metric = UnusualMetric();
  TrialOptions options;
  options.series = 25;
  options.grasps_per_series = 4;
  options.executions = 2;
  options.min_epsilon = 0.008;
  options.table.approach_cone = 50.0;
  options.table.clearance = 0.002;
  const Object house(Transformed(House(), 0.042 / 4.0, Vector3d::Zero()), metric, options);
  const auto results = RunTrials({shapes::Cube(), House()}, metric, options, 9);
  Told told;
  for (std::uint64_t number = 0; number < 25; ++number) house.Series(9, 1, number, &told);
  const TrialResult& result = results[1];
  EXPECT_EQ(result.poses, static_cast<int>(house.poses.size()));
  EXPECT_EQ(result.grasps, 100);
  EXPECT_EQ(result.found, told.found);
  EXPECT_EQ(result.holds_planned, told.planned);
  EXPECT_DOUBLE_EQ(result.confidence, told.confidence / told.found);
  EXPECT_DOUBLE_EQ(result.force_closure.value, told.closed / 200.0);
  EXPECT_DOUBLE_EQ(result.held.value, told.held / 200.0);
  // Every step has had something to decide.
  EXPECT_GT(told.found, 30);
  EXPECT_LT(told.found, 95);
  EXPECT_GT(told.planned, 5);
  EXPECT_LT(told.planned, told.found);
  EXPECT_GT(told.held, 5);
  EXPECT_LT(told.held, told.closed);
  EXPECT_LT(told.closed, 2 * told.found);
}

TEST(RunTrials, DrawEachStablePoseByItsProbability) {
  // A box of 1 x 2 x 5 on one of its large sides holds the only graspable width upright, where no
  // gripper gets under it: two poses of six with the solid angles of 2 x 5 from 1/2 away, 0.66 of
  // all. On the others every grasp near the top is reachable: a third is found, not two thirds.
  const double angle = 4.0 * std::atan(10.0 / (2.0 * 0.5 * std::sqrt(4.0 * 0.25 + 4.0 + 25.0)));
  const double lying = 2.0 * angle / (4.0 * std::numbers::pi);
  MetricOptions metric;
  metric.num_grasps = 8;
  metric.num_draws = 1;
  metric.collision = Collision::kJaws;  // the cone alone counts
  TrialOptions options;
  options.series = 400;
  options.grasps_per_series = 1;
  options.executions = 1;
  const TrialResult result = RunTrials({shapes::Box({1.0, 2.0, 5.0})}, metric, options, 2).front();
  EXPECT_NEAR(lying, 0.68, 0.02);
  EXPECT_NEAR(result.found / 400.0, 1.0 - lying, 0.05);
}

TEST(RunTrials, EverySeriesAndEveryObjectHasItsOwnStreams) {
  MetricOptions metric = UnusualMetric();
  TrialOptions one;
  one.series = 1;
  one.grasps_per_series = 8;
  const auto results = RunTrials({House(), House()}, metric, one, 9);
  EXPECT_NE(results[0].confidence, results[1].confidence);
  TrialOptions three = one;
  three.series = 3;  // three alike would have the mean of one
  EXPECT_NE(RunTrials({House()}, metric, three, 9).front().confidence, results[0].confidence);
}

TEST(RunTrials, AnObjectWithItsStreamIsTriedAloneAsBesideOthers) {
  const MetricOptions metric = UnusualMetric();
  TrialOptions options;
  options.series = 3;
  const auto both =
      RunTrials({shapes::Cube(), House()}, metric, options, 9, 0, nullptr, {71, 1'000'000'007});
  const auto alone = RunTrials({House()}, metric, options, 9, 0, nullptr, {1'000'000'007}),
             other = RunTrials({House()}, metric, options, 9, 0, nullptr, {71});
  EXPECT_EQ(both[1].confidence, alone[0].confidence);
  EXPECT_EQ(both[1].held.value, alone[0].held.value);
  EXPECT_NE(both[1].confidence, other[0].confidence);
}

TEST(TrialOptions, EveryKeyIsBoundToItsFieldAndEveryDefaultIsItsNumber) {
  EXPECT_EQ(
      LinesOf(TrialOptions()),
      (std::vector<std::string>{"trial.series = 100", "trial.grasps_per_series = 5",
                                "trial.executions = 3", "trial.min_epsilon = 0.002",
                                "trial.approach_cone = 45.0", "trial.table_clearance = 0.0"}));
  EXPECT_EQ(
      LinesOf(TrialOptions{7, 6, 4, 0.5, {30.0, 0.01}}),
      (std::vector<std::string>{"trial.series = 7", "trial.grasps_per_series = 6",
                                "trial.executions = 4", "trial.min_epsilon = 0.5",
                                "trial.approach_cone = 30.0", "trial.table_clearance = 0.01"}));
}

TEST(FrictionReading, EachHasItsOwnName) {
  EXPECT_EQ(ChoiceName(FrictionReading::kHalfAngle), "half-angle");
  EXPECT_EQ(ChoiceName(FrictionReading::kFullCone), "full-cone");
}

TEST(ShareOfSeries, TakesTheSpreadOfASampleOverTheSeries) {
  // 3, 0 and 1 of 4: shares 3/4, 0, 1/4 about 1/3. Squares 7/24, over n - 1 and n: 7/144, worth
  // (2/9) / (7/144) = 32/7 executions. Wilson with z^2 = 3.841459 for 1/3 of 32/7.
  const Share share = ShareOfSeries({3, 0, 1}, 4);
  EXPECT_DOUBLE_EQ(share.value, 1.0 / 3.0);
  const double z2 = 3.841458820694124, n = 32.0 / 7.0;
  const double middle = (1.0 / 3.0 + z2 / (2.0 * n)) / (1.0 + z2 / n);
  const double half = std::sqrt(z2 * (2.0 / 9.0 + z2 / (4.0 * n)) / n) / (1.0 + z2 / n);
  EXPECT_NEAR(share.interval.low, middle - half, 1e-12);
  EXPECT_NEAR(share.interval.high, middle + half, 1e-12);
  EXPECT_NEAR(share.interval.low, 0.0819, 1e-4);
  EXPECT_NEAR(share.interval.high, 0.7369, 1e-4);
}

}  // namespace
}  // namespace antigrasp
