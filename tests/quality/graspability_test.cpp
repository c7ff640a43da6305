#include "antigrasp/quality/graspability.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>

#include "antigrasp/quality/antipodal_sampler.h"
#include "antigrasp/quality/epsilon.h"
#include "antigrasp/quality/reachability.h"
#include "antigrasp/quality/robust_quality.h"
#include "tests/quality/rejected_counts.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

MetricOptions Noise(const std::string& preset) {
  MetricOptions options;
  ApplyNoisePreset(preset, &options);
  return options;
}

void ExpectSame(const Graspability& a, const Graspability& b) {
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.attempts, b.attempts);
  EXPECT_EQ(a.rejected.Of("gripper collides"), b.rejected.Of("gripper collides"));
  if (a.status != GraspabilityStatus::kNotEvaluable) {
    EXPECT_EQ(a.value, b.value);
    EXPECT_EQ(a.ci_low, b.ci_low);
    EXPECT_EQ(a.ci_high, b.ci_high);
    EXPECT_EQ(a.mean, b.mean);
  }
  ASSERT_EQ(a.grasps.size(), b.grasps.size());
  for (std::size_t i = 0; i < a.grasps.size(); ++i) {
    EXPECT_EQ(a.grasps[i].quality, b.grasps[i].quality);
    EXPECT_EQ(a.grasps[i].grasp.center, b.grasps[i].grasp.center);
  }
}

TEST(Graspability, SummarizesTheGraspsBehindIt) {
  const Graspability g = EvaluateGraspability(shapes::Sphere(1.0, 3), {}, 1, 0);
  EXPECT_EQ(g.status, GraspabilityStatus::kOk);
  ASSERT_EQ(g.grasps.size(), 100u);
  EXPECT_GE(g.attempts, 100);
  std::vector<double> qualities;
  double sum = 0.0, nonzero = 0.0;
  for (const ScoredGrasp& scored : g.grasps) {
    qualities.push_back(scored.quality);
    sum += scored.quality;
    nonzero += scored.quality > 0.0 ? 1.0 : 0.0;
  }
  EXPECT_EQ(g.value, DiscretePercentile(qualities, 75.0));
  EXPECT_NEAR(g.mean, sum / 100.0, 1e-15);
  EXPECT_DOUBLE_EQ(g.fraction_nonzero, nonzero / 100.0);
  EXPECT_LE(g.ci_low, g.value);
  EXPECT_GE(g.ci_high, g.value);
  EXPECT_LT(g.ci_low, g.ci_high);
  EXPECT_GT(g.seconds, 0.0);
}

TEST(Graspability, RescalesTheSmallestExtentToFourCentimetres) {
  const Graspability g = EvaluateGraspability(shapes::Box({2.0, 5.0, 3.0}), {}, 1, 0);
  EXPECT_DOUBLE_EQ(g.scale, 0.02);
  for (const ScoredGrasp& scored : g.grasps) {
    EXPECT_NEAR(std::abs(scored.grasp.contacts[0].point.x()), 0.02, 1e-12);
  }
}

TEST(Graspability, DoesNotDependOnTheUnitOrPositionOfTheMesh) {
  const TriangleMesh mesh = shapes::Torus(2.0, 1.0, 24, 12);
  const Graspability a = EvaluateGraspability(mesh, {}, 1, 0);
  const Graspability b = EvaluateGraspability(Transformed(mesh, 4.0, {64.0, -8.0, 2.0}), {}, 1, 0);
  EXPECT_EQ(a.status, b.status);
  EXPECT_NEAR(a.value, b.value, 0.02 * a.value);  // rounding may turn a contact on an edge
}

TEST(Graspability, WithoutNoiseGraspsOfACubeScoreTheirEpsilon) {
  const Graspability g = EvaluateGraspability(shapes::Cube(), Noise("none"), 1, 0);
  ASSERT_EQ(g.status, GraspabilityStatus::kOk);
  for (const ScoredGrasp& scored : g.grasps) {
    EXPECT_NEAR(scored.quality, Epsilon(scored.grasp.contacts, Vector3d::Zero(), {}), 1e-9);
    EXPECT_LE(scored.quality, std::numbers::pi * 0.005 * 0.005 * 0.5 * 1000.0);
  }
  EXPECT_GT(g.fraction_nonzero, 0.8);
}

TEST(Graspability, NoiseLowersItAndMoreNoiseLowersItMore) {
  for (const TriangleMesh& mesh :
       {shapes::Sphere(1.0, 3), shapes::Cube(), shapes::Cylinder(0.5, 2.0, 60)}) {
    const double none = EvaluateGraspability(mesh, Noise("none"), 1, 0).value;
    const double usual = EvaluateGraspability(mesh, Noise("default"), 1, 0).value;
    const double dexnet = EvaluateGraspability(mesh, Noise("dexnet"), 1, 0).value;
    EXPECT_LT(usual, none);
    EXPECT_LT(dexnet, 0.5 * usual);
    EXPECT_GT(dexnet, 0.0);
  }
}

TEST(Graspability, ALongRodIsHarderThanASphere) {
  // Grasps far from the centre of mass leave long torque arms: epsilon falls.
  const double sphere = EvaluateGraspability(shapes::Sphere(1.0, 3), {}, 1, 0).value;
  const double cube = EvaluateGraspability(shapes::Cube(), {}, 1, 0).value;
  const double rod = EvaluateGraspability(shapes::Box({1.0, 1.0, 10.0}), {}, 1, 0).value;
  EXPECT_GT(sphere, 0.0);
  EXPECT_GT(rod, 0.0);
  EXPECT_LT(rod, 0.5 * sphere);
  EXPECT_LT(rod, 0.5 * cube);
}

TEST(Graspability, ATetrahedronIsHarderThanACube) {
  // Its faces meet at 70.5 degrees: no two are within the friction cones of one line.
  const Graspability g = EvaluateGraspability(shapes::Tetrahedron(), {}, 1, 0);
  EXPECT_LT(g.value, 0.5 * EvaluateGraspability(shapes::Cube(), {}, 1, 0).value);
}

TEST(Graspability, AQuarterTurnAboutXChangesOnlyTheSample) {
  // The tangent frames follow the x axis, so each grasp keeps its epsilon; the random directions do
  // not turn with the mesh, so the sample is another one.
  MetricOptions options = Noise("none");
  options.num_grasps = 2000;
  options.max_attempts = 20000;
  const TriangleMesh box = shapes::Box({1.0, 1.2, 1.1});
  Eigen::Matrix3d turn;
  turn << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  const Graspability a = EvaluateGraspability(box, options, 1, 0);
  const Graspability b = EvaluateGraspability(shapes::Rotated(box, turn), options, 1, 0);
  EXPECT_NEAR(a.value, b.value, 0.1 * a.value);
  EXPECT_NEAR(a.mean, b.mean, 0.1 * a.mean);
}

TEST(Graspability, AnObjectWiderThanTheGripperHasNoGrasps) {
  MetricOptions options;
  options.object_min_extent = 0.0;
  options.max_attempts = 500;
  const Graspability g = EvaluateGraspability(shapes::Sphere(0.06, 3), options, 1, 0);
  EXPECT_EQ(g.status, GraspabilityStatus::kNoGrasps);
  EXPECT_EQ(g.value, 0.0);
  EXPECT_EQ(g.mean, 0.0);
  EXPECT_EQ(g.attempts, 500);
  EXPECT_EQ(g.scale, 1.0);
  EXPECT_TRUE(g.grasps.empty());
}

TEST(Graspability, TooFewAttemptsAreReportedAndScored) {
  MetricOptions options;
  options.max_attempts = 20;
  const Graspability g = EvaluateGraspability(shapes::Cube(), options, 1, 0);
  EXPECT_EQ(g.status, GraspabilityStatus::kFewGrasps);
  EXPECT_EQ(g.attempts, 20);
  EXPECT_GT(g.grasps.size(), 0u);
  EXPECT_GT(g.value, 0.0);
}

TEST(Graspability, MeshesThatCannotBeEvaluatedGiveNaNAndAStatus) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<TriangleMesh> bad(1);  // empty
  bad.push_back(shapes::FlatSquare());
  bad.push_back(shapes::Cube());
  bad.back().vertices[3].y() = nan;
  bad.push_back(shapes::Cube());
  bad.back().vertices[3].y() = std::numeric_limits<double>::infinity();
  bad.push_back(shapes::Cube());
  bad.back().faces[2][1] = 8;
  bad.push_back(shapes::Cube());
  bad.back().faces[2][1] = -1;
  bad.push_back(shapes::Cube());
  bad.back().faces.clear();
  bad.push_back(Transformed(shapes::Cube(), 1e-320, Vector3d::Zero()));
  bad.push_back(Transformed(shapes::Cube(), 0.0, Vector3d::Zero()));
  for (std::size_t i = 0; i < bad.size(); ++i) {
    const Graspability g = EvaluateGraspability(bad[i], {}, 1, 0);
    EXPECT_EQ(g.status, GraspabilityStatus::kNotEvaluable) << i;
    EXPECT_TRUE(std::isnan(g.value)) << i;
  }
}

TEST(Graspability, BrokenSurfacesAreEvaluatedWithoutACrash) {
  TriangleMesh open = shapes::Sphere(1.0, 3);
  open.faces.resize(open.faces.size() / 2);
  TriangleMesh doubled = shapes::Joined(shapes::Cube(), shapes::Cube());
  TriangleMesh degenerate = shapes::Cube();
  degenerate.faces.push_back({0, 0, 0});
  degenerate.faces.push_back({1, 2, 2});
  MetricOptions options;
  options.max_attempts = 1000;
  for (const TriangleMesh& mesh : {open, doubled, degenerate}) {
    const Graspability g = EvaluateGraspability(mesh, options, 1, 0);
    EXPECT_NE(g.status, GraspabilityStatus::kNotEvaluable);
    EXPECT_TRUE(std::isfinite(g.value));
  }
  const Graspability inverted =
      EvaluateGraspability(shapes::Inverted(shapes::Cube()), options, 1, 0);
  EXPECT_EQ(inverted.status, GraspabilityStatus::kNoGrasps);
}

TEST(Graspability, IsTheSameForTheSameSeedAndObjectAndDiffersOtherwise) {
  const TriangleMesh mesh = shapes::Torus(2.0, 1.0, 24, 12);
  const Graspability g = EvaluateGraspability(mesh, {}, 1, 5);
  ExpectSame(EvaluateGraspability(mesh, {}, 1, 5), g);
  EXPECT_NE(EvaluateGraspability(mesh, {}, 2, 5).value, g.value);
  EXPECT_NE(EvaluateGraspability(mesh, {}, 1, 6).value, g.value);
}

TEST(Graspability, EachGraspCanBeRepeatedFromTheStreamsOfItsCandidate) {
  const TriangleMesh mesh = shapes::Box({0.04, 0.06, 0.05});
  MetricOptions options;
  options.collision = Collision::kJaws;
  const Graspability g = EvaluateGraspability(mesh, options, 1, 5);
  const TriangleMesh scaled = Transformed(mesh, g.scale, Vector3d::Zero());
  const RayScene scene(scaled);
  const AntipodalSampler sampler(scaled, scene, options.friction, options.jaw_opening);
  std::size_t found = 0;
  for (std::uint64_t candidate = 0; found < g.grasps.size(); ++candidate) {
    RngStream grasp_rng(1, "grasp", 5, candidate), noise_rng(1, "noise", 5, candidate);
    const auto grasp = sampler.Try(&grasp_rng);
    if (!grasp) continue;
    EXPECT_EQ(grasp->center, g.grasps[found].grasp.center);
    EXPECT_EQ(RobustQuality(scene, CenterOfMass(scaled), *grasp, options, &noise_rng),
              g.grasps[found].quality);
    ++found;
  }
}

TEST(Graspability, AttemptsAreTheGraspsAndTheRejectedOfEveryReason) {
  for (const TriangleMesh& mesh :
       {shapes::Torus(2.0, 1.0, 24, 12), shapes::Cube(), shapes::Box({1.0, 6.0, 6.0})}) {
    for (const Collision collision : {Collision::kGripper, Collision::kJaws}) {
      MetricOptions options;
      options.collision = collision;
      const Graspability g = EvaluateGraspability(mesh, options, 1, 0);
      EXPECT_EQ(g.attempts, static_cast<int>(g.grasps.size()) + CountOfAll(g.rejected));
      EXPECT_EQ(g.rejected.Of("gripper collides") > 0, options.collision == Collision::kGripper);
    }
  }
}

TEST(Graspability, TheGripperKeepsThoseOfTheJawsGraspsThatItReaches) {
  // A cube held askew does not fit between the fingers; the others keep their scores.
  const TriangleMesh mesh = shapes::Cube();
  MetricOptions gripper;
  gripper.num_grasps = 4000;
  gripper.max_attempts = 200;
  MetricOptions jaws = gripper;
  jaws.collision = Collision::kJaws;
  const Graspability reached = EvaluateGraspability(mesh, gripper, 1, 0);
  const Graspability all = EvaluateGraspability(mesh, jaws, 1, 0);
  EXPECT_EQ(reached.attempts, all.attempts);
  EXPECT_EQ(
      reached.grasps.size() + static_cast<std::size_t>(reached.rejected.Of("gripper collides")),
      all.grasps.size());
  const TriangleMesh scaled = Transformed(mesh, all.scale, Vector3d::Zero());
  const RayScene scene(scaled);
  const GripperCollision collision(scaled, scene, gripper.gripper);
  std::size_t next = 0;
  for (const ScoredGrasp& scored : all.grasps) {
    EXPECT_EQ(scored.grasp.approach, Vector3d::Zero());
    const auto approach = collision.FreeApproach(scored.grasp, gripper.jaw_opening);
    if (!approach) continue;
    ASSERT_LT(next, reached.grasps.size());
    const ScoredGrasp& same = reached.grasps[next++];
    EXPECT_EQ(same.grasp.center, scored.grasp.center);
    EXPECT_EQ(same.grasp.approach, *approach);
    EXPECT_EQ(same.quality, scored.quality);
  }
  EXPECT_EQ(next, reached.grasps.size());
}

TEST(Graspability, ABallInAClosedBoxHasGraspsForTheJawsButNoneForTheGripper) {
  const TriangleMesh box = shapes::Joined(shapes::Box({0.14, 0.14, 0.14}),
                                          shapes::Inverted(shapes::Box({0.12, 0.12, 0.12})));
  MetricOptions options;
  options.object_min_extent = 0.0;
  options.max_attempts = 3000;
  const TriangleMesh mesh = shapes::Joined(box, shapes::Sphere(0.01, 3));
  options.collision = Collision::kJaws;
  EXPECT_GT(EvaluateGraspability(mesh, options, 1, 0).value, 0.0);
  options.collision = Collision::kGripper;
  const Graspability g = EvaluateGraspability(mesh, options, 1, 0);
  for (const ScoredGrasp& scored : g.grasps) EXPECT_GT(scored.grasp.center.norm(), 0.05);
  EXPECT_GT(g.rejected.Of("gripper collides"), 5);
}

TEST(ScoreAll, GivesTheSameBitsForAnyNumberOfThreadsAndEachObjectItsOwnStream) {
  const std::vector<TriangleMesh> meshes{shapes::Sphere(1.0, 2),
                                         shapes::Cube(),
                                         TriangleMesh{},
                                         shapes::Cylinder(0.5, 2.0, 30),
                                         shapes::Torus(2.0, 1.0, 20, 10),
                                         shapes::Tetrahedron()};
  const auto score = [&meshes](int threads) {
    return ScoreAll(
        std::ssize(meshes), [&](std::int64_t i) { return &meshes[static_cast<std::size_t>(i)]; },
        [](std::int64_t i) { return static_cast<std::uint64_t>(10 + 3 * i); }, {}, 3, threads);
  };
  const auto one = score(1), two = score(2);
  ASSERT_EQ(one.size(), meshes.size());
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    ExpectSame(one[i], two[i]);
    ExpectSame(one[i], EvaluateGraspability(meshes[i], {}, 3, 10 + 3 * i));
  }
}

TEST(ScoreAll, ReportsEveryObjectOnceAndNothingForNone) {
  std::vector<std::int64_t> seen;
  MetricOptions options;
  options.num_grasps = 5;
  const TriangleMesh cube = shapes::Cube();
  const auto mesh = [&cube](std::int64_t) { return &cube; };
  const auto stream = [](std::int64_t i) { return static_cast<std::uint64_t>(i); };
  ScoreAll(3, mesh, stream, options, 1, 2, [&seen](std::int64_t done, std::int64_t total) {
    EXPECT_EQ(total, 3);
    seen.push_back(done);
  });
  EXPECT_EQ(seen, (std::vector<std::int64_t>{1, 2, 3}));
  EXPECT_TRUE(ScoreAll(0, mesh, stream, options, 1, 2).empty());
}

TEST(ScoreAll, AsksForEveryMeshOnceAndLeavesAnObjectWithoutOneUnscored) {
  // The meshes are made when they are asked for, as a reader of files or a remesher does.
  MetricOptions options;
  options.num_grasps = 5;
  std::vector<TriangleMesh> made(3);
  std::vector<int> asked(3, 0);
  const auto scores = ScoreAll(
      3,
      [&](std::int64_t i) -> const TriangleMesh* {
        const auto slot = static_cast<std::size_t>(i);
        ++asked[slot];
        if (i == 1) return nullptr;
        made[slot] = shapes::Box({1.0, 2.0, 3.0 + static_cast<double>(i)});
        return &made[slot];
      },
      [](std::int64_t i) {
        EXPECT_NE(i, 1);
        return std::uint64_t{7};
      },
      options, 1, 2);
  EXPECT_EQ(asked, (std::vector<int>{1, 1, 1}));
  ASSERT_EQ(scores.size(), 3u);
  EXPECT_EQ(scores[1].status, GraspabilityStatus::kNotEvaluable);
  EXPECT_TRUE(std::isnan(scores[1].value));
  for (const std::size_t i : {0u, 2u}) {
    ExpectSame(scores[i], EvaluateGraspability(made[i], options, 1, 7));
  }
}

TEST(GraspabilityStatus, EveryStatusHasItsOwnName) {
  EXPECT_EQ(Name(GraspabilityStatus::kOk), "ok");
  EXPECT_EQ(Name(GraspabilityStatus::kFewGrasps), "few_grasps");
  EXPECT_EQ(Name(GraspabilityStatus::kNoGrasps), "no_grasps");
  EXPECT_EQ(Name(GraspabilityStatus::kNotEvaluable), "not_evaluable");
}

TEST(Graspability, ACopyMovedByRoundNumbersHasTheSameBitsAndItsContactsLieOnIt) {
  TriangleMesh near = shapes::Cylinder(30.0, 110.0, 32);
  for (Eigen::Vector3d& v : near.vertices) v = (v * 0x1p18).array().round() * 0x1p-18;
  const Eigen::Vector3d place(400000.0, -800000.0, 10000.0);
  const Graspability a = EvaluateGraspability(near, {}, 1, 2);
  const Graspability b = EvaluateGraspability(Transformed(near, 1.0, place), {}, 1, 2);
  ASSERT_GT(a.value, 0.0);
  EXPECT_EQ(b.value, a.value);
  EXPECT_EQ(b.mean, a.mean);
  ASSERT_EQ(b.grasps.size(), a.grasps.size());
  for (std::size_t i = 0; i < a.grasps.size(); ++i) {
    const Grasp &here = a.grasps[i].grasp, &there = b.grasps[i].grasp;
    EXPECT_NEAR((there.center - here.center - b.scale * place).norm(), 0.0, 1e-9);
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_NEAR((there.contacts[k].point - here.contacts[k].point - b.scale * place).norm(), 0.0,
                  1e-9);
    }
  }
}

}  // namespace
}  // namespace antigrasp
