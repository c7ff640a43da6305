#include "antigrasp/trial/model_trial.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "antigrasp/mesh/convex_hull.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

// The unit cube with the middles of the faces at +x, +y and +z moved out: those faces' parts oppose
// the flat faces under this angle.
TriangleMesh PyramidCube(double degrees) {
  std::vector<Vector3d> corners = shapes::Cube().vertices;
  const double out = 0.5 + 0.5 * std::tan(degrees * std::numbers::pi / 180.0);
  for (int k = 0; k < 3; ++k) corners.push_back(out * Vector3d::Unit(k));
  return ConvexHull(corners);
}

MetricOptions Metric(FrictionReading reading, const char* noise) {
  MetricOptions metric;
  metric.friction = FrictionCoefficient(17.0, reading);
  metric.num_grasps = 30;
  metric.num_draws = 4;
  ApplyNoisePreset(noise, &metric);
  return metric;
}

TrialOptions Short() {
  TrialOptions options;
  options.series = 6;
  options.min_epsilon = 0.0;
  return options;
}

TEST(FrictionCoefficient, IsTheTangentOfTheConesHalfAngle) {
  EXPECT_NEAR(FrictionCoefficient(17.0, FrictionReading::kHalfAngle), 0.30573, 1e-5);
  EXPECT_NEAR(FrictionCoefficient(17.0, FrictionReading::kFullCone), 0.14945, 1e-5);
  EXPECT_EQ(FrictionCoefficient(34.0, FrictionReading::kFullCone),
            FrictionCoefficient(17.0, FrictionReading::kHalfAngle));
}

TEST(ShareOfSeries, IsWilsonsIntervalForSingleExecutions) {
  std::vector<int> held(100, 0);
  for (std::size_t i = 0; i < 50; ++i) held[i] = 1;
  const Share half = ShareOfSeries(held, 1);
  EXPECT_EQ(half.value, 0.5);
  EXPECT_NEAR(half.interval.low, 0.4038, 1e-4);
  EXPECT_NEAR(half.interval.high, 0.5962, 1e-4);
}

TEST(ShareOfSeries, CountsSeriesThatAreAllAlikeInsideAsOneExecutionEach) {
  std::vector<int> held(100, 0);
  for (std::size_t i = 0; i < 50; ++i) held[i] = 15;
  EXPECT_NEAR(ShareOfSeries(held, 15).interval.low, 0.4038, 1e-4);
  const Share all = ShareOfSeries(std::vector<int>(100, 15), 15);
  EXPECT_EQ(all.value, 1.0);
  EXPECT_NEAR(all.interval.low, 0.9630, 1e-4);
  EXPECT_NEAR(all.interval.high, 1.0, 1e-15);
  const Share none = ShareOfSeries(std::vector<int>(100, 0), 15);
  EXPECT_NEAR(none.interval.low, 0.0, 1e-15);
  EXPECT_NEAR(none.interval.high, 0.0370, 1e-4);
}

TEST(ShareOfSeries, CountsEveryExecutionWhenSeriesSpreadNoMoreThanChance) {
  std::vector<int> held;
  for (int i = 0; i < 50; ++i) held.push_back(i % 2 == 0 ? 7 : 8);
  const Share share = ShareOfSeries(held, 15);
  EXPECT_EQ(share.value, 0.5);
  EXPECT_NEAR(share.interval.high - share.interval.low, 2 * 1.96 * std::sqrt(0.25 / 750), 1e-3);
}

TEST(RunTrials, ThePlainCubeAlwaysHoldsAndWithoutNoiseSurely) {
  for (const auto reading : {FrictionReading::kHalfAngle, FrictionReading::kFullCone}) {
    const auto result = RunTrials({shapes::Cube()}, Metric(reading, "none"), Short(), 1).front();
    EXPECT_EQ(result.poses, 6);
    EXPECT_EQ(result.grasps, 30);
    EXPECT_EQ(result.found, 30);
    EXPECT_EQ(result.holds_planned, 30);
    EXPECT_EQ(result.force_closure.value, 1.0);
    EXPECT_EQ(result.held.value, 1.0);
    EXPECT_GT(result.confidence, 0.0);
  }
}

TEST(RunTrials, TheSecondReadingAsksForMoreThanForceClosure) {
  TrialOptions options = Short();
  options.min_epsilon = 0.003;
  const MetricOptions metric = Metric(FrictionReading::kHalfAngle, "none");
  const auto result = RunTrials({shapes::Cube()}, metric, options, 1).front();
  EXPECT_EQ(result.force_closure.value, 1.0);
  EXPECT_GT(result.held.value, 0.0);
  EXPECT_LT(result.held.value, 1.0);  // far from the centre of mass epsilon is small
  options.min_epsilon = 1.0;
  EXPECT_EQ(RunTrials({shapes::Cube()}, metric, options, 1).front().holds_planned, 0);
}

TEST(RunTrials, FacesThatOpposeUnderMoreThanTheFullConeCannotBePinched) {
  MetricOptions full = Metric(FrictionReading::kFullCone, "none");
  MetricOptions half = Metric(FrictionReading::kHalfAngle, "none");
  const TriangleMesh cube = PyramidCube(26.0);  // 2 x 8.5 < 26 < 2 x 17
  const auto none = RunTrials({cube}, full, Short(), 1).front();
  EXPECT_EQ(none.poses, 15);  // twelve triangles and three squares
  EXPECT_EQ(none.found, 0);
  EXPECT_EQ(none.held.value, 0.0);
  EXPECT_EQ(none.confidence, 0.0);
  EXPECT_GT(RunTrials({cube}, half, Short(), 1).front().found, 0);
  EXPECT_GT(RunTrials({PyramidCube(15.0)}, full, Short(), 1).front().found, 0);  // 15 < 17
}

TEST(RunTrials, WithoutNoiseAnExecutionEqualsThePlan) {
  const auto result =
      RunTrials({PyramidCube(10.0)}, Metric(FrictionReading::kHalfAngle, "none"), Short(), 3)
          .front();
  EXPECT_GT(result.found, 0);
  EXPECT_DOUBLE_EQ(result.force_closure.value, result.found / 30.0);
  EXPECT_DOUBLE_EQ(result.held.value, result.holds_planned / 30.0);
}

TEST(RunTrials, NoiseLetsSomeGraspsSlip) {
  MetricOptions metric = Metric(FrictionReading::kFullCone, "default");
  TrialOptions options = Short();
  options.series = 12;
  const auto result = RunTrials({PyramidCube(10.0)}, metric, options, 1).front();
  EXPECT_GT(result.found, 0);
  EXPECT_LT(result.force_closure.value, result.found / 60.0);
  EXPECT_LE(result.held.value, result.force_closure.value);
  EXPECT_LT(result.held.interval.low, result.held.value);
  EXPECT_GT(result.held.interval.high, result.held.value);
}

TEST(RunTrials, ExecutesNoGraspTwiceInASeries) {
  MetricOptions metric = Metric(FrictionReading::kHalfAngle, "none");
  metric.num_grasps = 2;
  const auto result = RunTrials({shapes::Cube()}, metric, Short(), 1).front();
  EXPECT_LE(result.found, 2 * 6);
  EXPECT_GT(result.found, 0);
}

TEST(RunTrials, DependsOnTheSeedAndNotOnTheThreads) {
  const std::vector<TriangleMesh> meshes{PyramidCube(10.0), PyramidCube(20.0)};
  const MetricOptions metric = Metric(FrictionReading::kFullCone, "default");
  std::int64_t done = 0;
  const auto one = RunTrials(meshes, metric, Short(), 5, 1);
  const auto two =
      RunTrials(meshes, metric, Short(), 5, 2, [&](std::int64_t i, std::int64_t) { done = i; });
  const auto other = RunTrials(meshes, metric, Short(), 6, 2);
  EXPECT_EQ(done, 12);
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    EXPECT_EQ(one[i].confidence, two[i].confidence);
    EXPECT_EQ(one[i].held.value, two[i].held.value);
    EXPECT_EQ(one[i].found, two[i].found);
  }
  EXPECT_NE(one[0].confidence, other[0].confidence);
}

TEST(RunTrials, AnObjectThatCannotBeTriedIsData) {
  const auto results = RunTrials({{}, shapes::FlatSquare(), shapes::Cube()},
                                 Metric(FrictionReading::kHalfAngle, "none"), Short(), 1);
  EXPECT_EQ(results[0].poses, 0);
  EXPECT_TRUE(std::isnan(results[0].held.value));
  EXPECT_EQ(results[1].poses, 0);
  EXPECT_EQ(results[2].held.value, 1.0);
}

}  // namespace
}  // namespace antigrasp
