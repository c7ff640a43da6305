// Planned grasps of whole objects, executed.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <set>

#include "antigrasp/trial/trial_summary.h"
#include "antigrasp/trial/trials_csv.h"
#include "tests/trial/physics_shapes.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

MetricOptions Metric(int grasps, double friction = 0.5) {
  MetricOptions metric;
  metric.friction = friction;
  metric.num_grasps = grasps;
  metric.num_draws = 5;
  return metric;
}

PhysicsTrial TryOnce(const TriangleMesh& mesh, const MetricOptions& metric,
                     const PhysicsTrialOptions& options, int threads = 0,
                     Pace pace = Pace::kEarly) {
  return PhysicsTrials(metric, options, 7, threads, pace).Try(mesh, 3);
}

std::string Rows(const PhysicsTrial& trial) {
  ExecutionsTable table;
  table.Add({"six-ways", "after", "own", 0.5}, "object", trial);
  return table.TakeText();
}

// Executions whose first stage came out otherwise.
double ShareOther(const PhysicsTrial& a, const PhysicsTrial& b) {
  int all = 0, other = 0;
  for (std::size_t i = 0; i < a.grasps.size(); ++i) {
    for (std::size_t k = 0; k < a.grasps[i].draws.size(); ++k) {
      ++all;
      other +=
          (a.grasps[i].draws[k].execution.stages > 0) != (b.grasps[i].draws[k].execution.stages > 0)
              ? 1
              : 0;
    }
  }
  return static_cast<double>(other) / all;
}

TEST(PhysicsTrials, GiveTheSameBytesForAnyNumberOfThreads) {
  const TriangleMesh cube = BevelledCube(15.0, 0.04);
  PhysicsTrials two(Metric(12, 0.3), {}, 7, 2);
  two.Try(shapes::Box({0.03, 0.05, 0.06}), 1);  // what an engine did before leaves no trace
  EXPECT_EQ(Rows(TryOnce(cube, Metric(12, 0.3), {}, 1)), Rows(two.Try(cube, 3)));
}

TEST(PhysicsTrials, DecideEarlyAsTheyWouldAtTheEnd) {
  const TriangleMesh cube = BevelledCube(15.0, 0.04);
  const PhysicsTrial early = TryOnce(cube, Metric(20, 0.3), {});
  const PhysicsTrial fixed = TryOnce(cube, Metric(20, 0.3), {}, 0, Pace::kFixed);
  EXPECT_LE(ShareOther(early, fixed), 0.02);
}

// The jaws that begin near the object have the speed that they would have there, and the object
// lies on its table as it would: it is pushed to the same place.
TEST(PhysicsTrials, BeginNearTheTouchAsIfFromOpenJaws) {
  const TriangleMesh cube = BevelledCube(15.0, 0.04);
  const PhysicsTrial early = TryOnce(cube, Metric(20, 0.3), {});
  const PhysicsTrial fixed = TryOnce(cube, Metric(20, 0.3), {}, 0, Pace::kFixed);
  int held = 0, elsewhere = 0;
  std::int64_t early_steps = 0, fixed_steps = 0;
  for (std::size_t i = 0; i < early.grasps.size(); ++i) {
    for (std::size_t k = 0; k < early.grasps[i].draws.size(); ++k) {
      const Execution &a = early.grasps[i].draws[k].execution,
                      &b = fixed.grasps[i].draws[k].execution;
      early_steps += a.steps;
      fixed_steps += b.steps;
      if (a.stages == 0 || b.stages == 0) continue;
      ++held;
      elsewhere += std::abs(a.closing_move - b.closing_move) > 2e-5 ? 1 : 0;
    }
  }
  EXPECT_GT(held, 50);
  EXPECT_EQ(elsewhere, 0);
  EXPECT_LT(8 * early_steps, fixed_steps);
}

// One jaw throws it off, it flies free for longer than a held object may, and the other catches it.
TEST(PhysicsTrials, GiveNothingUpThatTheOtherJawWillCatch) {
  const TriangleMesh hull = RandomHull(2, 30, {0.02, 0.03, 0.04});
  MetricOptions metric = Metric(20, 0.3);
  metric.object_min_extent = 0.0;
  const PhysicsTrial early = TryOnce(hull, metric, {});
  const PhysicsTrial fixed = TryOnce(hull, metric, {}, 0, Pace::kFixed);
  int given_up = 0, lost = 0;
  for (std::size_t i = 0; i < early.grasps.size(); ++i) {
    for (std::size_t k = 0; k < early.grasps[i].draws.size(); ++k) {
      if (early.grasps[i].draws[k].execution.outcome != Outcome::kLostClosing) continue;
      ++lost;
      given_up += fixed.grasps[i].draws[k].execution.outcome == Outcome::kHeld ? 1 : 0;
    }
  }
  EXPECT_GT(lost, 0);
  EXPECT_EQ(given_up, 0);
}

TEST(PhysicsTrials, HalfTheTimeStepChangesFewOutcomes) {
  const TriangleMesh cube = BevelledCube(15.0, 0.04);
  PhysicsTrialOptions half;
  half.physics.time_step = 0.0005;
  EXPECT_LE(ShareOther(TryOnce(cube, Metric(40, 0.3), {}), TryOnce(cube, Metric(40, 0.3), half)),
            0.02);
}

// Without noise, at a friction that leaves a margin, every grasp that closes on a cube is held.
TEST(PhysicsTrials, HoldACubeWithoutNoise) {
  MetricOptions metric = Metric(10);
  ApplyNoisePreset("none", &metric);
  PhysicsTrialOptions options;
  options.draws = 1;
  const PhysicsTrial trial = TryOnce(shapes::Box(Vector3d::Constant(0.03)), metric, options);
  ASSERT_EQ(trial.grasps.size(), 10u);
  for (const ExecutedGrasp& grasp : trial.grasps) {
    EXPECT_EQ(grasp.draws[0].execution.outcome, Outcome::kHeld);
    EXPECT_LT(grasp.draws[0].execution.closing_move, 0.001);
  }
}

// At 26 degrees hardly a pair of faces can be pinched at friction 0.25 (angle 14): physics sees
// what the metric's percentile does not.
TEST(PhysicsTrials, DropABevelledCubeAtLowFriction) {
  const auto held = [](double degrees) {
    const PhysicsTrial trial = TryOnce(BevelledCube(degrees, 0.04), Metric(30, 0.25), {});
    return SummaryOf("cube", trial, ProtocolOf(ProtocolName::kSixWays)).held[0].value;
  };
  EXPECT_GT(held(0.0), held(26.0) + 0.2);
}

TEST(PhysicsTrials, PlanAndMetricPairByTheirDraws) {
  const TriangleMesh mesh = shapes::Box({0.04, 0.05, 0.06});
  PhysicsTrialOptions options;
  options.draws = 5;  // as many as the metric's
  const MetricOptions metric = Metric(8);
  const PhysicsTrial trial = TryOnce(mesh, metric, options);
  for (const ExecutedGrasp& grasp : trial.grasps) {
    double sum = 0.0;
    for (const ExecutedDraw& draw : grasp.draws) sum += draw.predicted;
    EXPECT_DOUBLE_EQ(sum / 5.0, grasp.planned.quality);
  }
}

TEST(PhysicsTrials, EveryProtocolRunsToItsEnd) {
  for (const auto& [name, text] : ChoicesOf(ProtocolName{})) {
    MetricOptions metric = Metric(4);
    PhysicsTrialOptions options;
    options.series.series = 2;
    ApplyProtocol(ProtocolOf(name), &metric, &options);
    const PhysicsTrial trial = TryOnce(shapes::Box({0.04, 0.05, 0.06}), metric, options);
    const TrialSummary summary = SummaryOf("box", trial, ProtocolOf(name));
    EXPECT_EQ(summary.status, "ok") << text;
    EXPECT_GT(summary.held[0].value, 0.1) << text;
    EXPECT_EQ(summary.outcomes[static_cast<std::size_t>(Outcome::kUnstable)], 0) << text;
  }
}

// In the air the plan is the metric's own: what it sampled, proposed, meets the same draws and ends
// the same way. Two of them take the places of others without a trace.
TEST(PhysicsTrials, ProposedGraspsAreExecutedAsPlannedOnesAre) {
  const TriangleMesh cube = BevelledCube(15.0, 0.04);
  MetricOptions metric = Metric(8, 0.3);
  PhysicsTrialOptions options;
  ApplyProtocol(ProtocolOf(ProtocolName::kGraspDataGen), &metric, &options);
  PhysicsTrials trials(metric, options, 7);
  const PhysicsTrial planned = trials.Try(cube, 3);
  std::vector<ProposedGrasp> proposed;
  for (const ScoredGrasp& scored : EvaluateGraspability(cube, metric, 7, 3).grasps) {
    proposed.push_back({scored.grasp, scored.candidate});
  }
  const PhysicsTrial again = trials.Try(cube, 3, proposed);
  EXPECT_EQ(Rows(again), Rows(planned));
  EXPECT_EQ(again.wanted, 8);
  EXPECT_EQ(again.grasps[7].planned.place, 7U);
  std::swap(proposed[0], proposed[7]);
  const PhysicsTrial swapped = trials.Try(cube, 3, proposed);
  EXPECT_EQ(swapped.grasps[7].planned.quality, planned.grasps[0].planned.quality);
  EXPECT_EQ(swapped.grasps[7].draws[1].execution.seconds,
            planned.grasps[0].draws[1].execution.seconds);
}

// A box rests on its six faces. Along z from above: in the two poses on the faces of z. Across a
// corner, 54.7 degrees from every face's normal: in none, unless another way in may be looked for.
TEST(PhysicsTrials, AProposedGraspStandsInThePoseThatItsOwnApproachReaches) {
  PhysicsTrials trials(Metric(8), {}, 7);
  Grasp along_x;
  along_x.axis = Vector3d::UnitX();
  along_x.approach = -Vector3d::UnitZ();
  Grasp by_corner = along_x;
  by_corner.axis = Vector3d(1, -1, 0).normalized();
  by_corner.approach = Vector3d(-1, -1, -1).normalized();
  const TriangleMesh box = shapes::Box({0.03, 0.032, 0.034});
  const PhysicsTrial trial = trials.Try(box, 3, {{by_corner, 0}, {along_x, 1}});
  ASSERT_EQ(trial.grasps.size(), 1U);
  EXPECT_EQ(trial.wanted, 2);
  EXPECT_EQ(trial.grasps[0].planned.place, 1U);
  EXPECT_EQ(trial.grasps[0].planned.grasp.approach, along_x.approach);
  EXPECT_EQ(trial.grasps[0].draws.size(), 5U);
  const auto poses = StablePoses(box, Vector3d::Zero());
  EXPECT_NEAR(poses[trial.grasps[0].planned.pose].table_from_object(2, 2), 1.0, 1e-9);
  along_x.approach.setZero();
  EXPECT_EQ(trials.Try(box, 3, {{along_x, 0}}).grasps.size(), 1U);
}

TEST(PhysicsTrials, PadsHoldABox) {
  PhysicsTrialOptions options;
  options.physics.tip.shape = TipShape::kPad;
  MetricOptions metric = Metric(10);
  ApplyNoisePreset("none", &metric);
  const PhysicsTrial trial = TryOnce(shapes::Box({0.03, 0.05, 0.06}), metric, options);
  EXPECT_GT(SummaryOf("box", trial, ProtocolOf(ProtocolName::kSixWays)).held[0].value, 0.8);
}

TEST(PhysicsTrials, AnObjectWiderThanTheJawsOpenHasNoGrasp) {
  const PhysicsTrial trial = TryOnce(shapes::Box({0.2, 0.2, 0.2}),
                                     [] {
                                       MetricOptions metric = Metric(5);
                                       metric.object_min_extent = 0.0;
                                       metric.max_attempts = 200;
                                       return metric;
                                     }(),
                                     {});
  const TrialSummary summary = SummaryOf("wide", trial, ProtocolOf(ProtocolName::kSixWays));
  EXPECT_EQ(summary.status, "no reachable grasp");
  EXPECT_FALSE(summary.HasShare());
  // A protocol that wants grasps counts those that were not found.
  EXPECT_EQ(SummaryOf("wide", trial, ProtocolOf(ProtocolName::kPaper)).held[0].value, 0.0);
}

TEST(TrialSummary, GroupsAreByRobustQuality) {
  PhysicsTrial trial;
  trial.tried = true;
  for (int i = 0; i < 20; ++i) {
    ExecutedGrasp grasp;
    grasp.planned.quality = i;
    trial.grasps.push_back(grasp);
  }
  EXPECT_EQ(GraspsOf(trial, GraspGroup::kBest), std::vector<std::size_t>{19});
  EXPECT_EQ(GraspsOf(trial, GraspGroup::kTopQuarter),
            (std::vector<std::size_t>{19, 18, 17, 16, 15}));
  EXPECT_EQ(GraspsOf(trial, GraspGroup::kPercentile), (std::vector<std::size_t>{15, 14}));
  EXPECT_EQ(GraspsOf(trial, GraspGroup::kAll).size(), 20u);
}

// A grasp that was not found is not held: two series of two, one grasp missing, all held.
TEST(TrialSummary, GraspsNotFoundCountAsNotHeldInAProtocolOfSeries) {
  PhysicsTrial trial;
  trial.tried = true;
  trial.wanted = 4;
  for (const std::uint64_t series : {0u, 0u, 1u}) {
    ExecutedGrasp grasp;
    grasp.series = series;
    grasp.draws.resize(1);
    grasp.draws[0].execution.outcome = Outcome::kHeld;
    grasp.draws[0].execution.stages = 1;
    trial.grasps.push_back(grasp);
  }
  EXPECT_DOUBLE_EQ(SummaryOf("o", trial, ProtocolOf(ProtocolName::kPaper)).held[0].value, 0.75);
}

}  // namespace
}  // namespace antigrasp
