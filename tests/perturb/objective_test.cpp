#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "antigrasp/core/angles.h"
#include "antigrasp/perturb/search.h"
#include "antigrasp/perturb/search_objective.h"
#include "antigrasp/perturb/search_projection.h"
#include "tests/support/shapes.h"

// The search's objective and projection by numbers from paper.
namespace antigrasp {
namespace {

using Eigen::Vector3d;

double Phi(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

// Face f has a contact whose normal is off the axis by the tangent tangents[f]; even faces are met
// by jaw 1, odd ones by jaw 2.
std::vector<Vector3d> NormalsWith(const std::vector<double>& tangents) {
  std::vector<Vector3d> normals;
  for (std::size_t f = 0; f < tangents.size(); ++f) {
    normals.push_back(Vector3d(f % 2 == 0 ? -1.0 : 1.0, tangents[f], 0.0).normalized());
  }
  return normals;
}

Closing On(std::int32_t first, std::int32_t second, double reach) {
  return {{first, second}, Vector3d::UnitX(), reach};
}

// A metric and softnesses in which no two numbers are equal.
MetricOptions Metric() {
  MetricOptions metric;
  metric.friction = 0.6;
  metric.friction_std = 0.08;
  metric.cone_edges = 6;
  metric.percentile = 30.0;
  return metric;
}

ObjectiveOptions Softness() {
  ObjectiveOptions options;
  options.draws = 4;
  options.acceptance_softness = 0.05;
  options.slip_softness = 0.06;  // beside 0.08: hypot 0.1
  options.percentile_softness = 0.4;
  return options;
}

TEST(MeanHold, IsTheShareThatHoldsWeighedByWhatIsPlanned) {
  const std::vector<Vector3d> normals = NormalsWith({0.1, 0.45, 0.5, 0.2});
  AttackGrasp first, second;
  first.planned = On(0, 1, 1.0);
  first.executed = {On(0, 1, 0.9), On(0, 3, 0.5),
                    On(2, 3, 0.7)};  // of four draws; how far counts not
  second.planned = On(2, 3, 1.0);
  second.executed = {On(2, 1, 1.0)};
  // Friction 0.6; planned over 0.05, executed over hypot(0.08, 0.06) = 0.1.
  const double h1 = (Phi(1.5) + Phi(4.0) + Phi(1.0)) / 4.0, h2 = Phi(1.0) / 4.0;
  const double w1 = Phi(3.0), w2 = Phi(2.0);
  EXPECT_NEAR(EvaluateMeanHold({first, second}, normals, Metric(), Softness()).value,
              (w1 * h1 + w2 * h2) / (w1 + w2), 1e-12);
  EXPECT_EQ(EvaluateMeanHold({}, normals, Metric(), Softness()).value, 0.0);
}

TEST(MeanHold, ItsDerivativeIsThatOfDifferences) {
  std::vector<Vector3d> normals = NormalsWith({0.1, 0.45, 0.5, 0.2});
  AttackGrasp first, second;
  first.planned = On(0, 1, 1.0);
  first.executed = {On(0, 1, 0.9), On(0, 3, 0.5), On(2, 3, 0.7)};
  second.planned = On(2, 3, 1.0);
  second.executed = {On(2, 1, 1.0)};
  const MeanHold hold = EvaluateMeanHold({first, second}, normals, Metric(), Softness());
  for (std::size_t f = 0; f < normals.size(); ++f) {
    const Vector3d side = normals[f].cross(Vector3d::UnitZ()), normal = normals[f];
    const auto at = [&](double angle) {
      normals[f] = std::cos(angle) * normal + std::sin(angle) * side;
      return EvaluateMeanHold({first, second}, normals, Metric(), Softness()).value;
    };
    const double slope = (at(1e-6) - at(-1e-6)) / 2e-6;
    normals[f] = normal;
    EXPECT_NEAR(hold.by_normal[f].dot(side), slope, 1e-7) << f;
    EXPECT_EQ(slope == 0.0, f == 0) << f;  // whose contact is never the steeper one
  }
}

TEST(Objective, OfOneGraspIsItsMeanOverAllDrawsAtTheLargerTangent) {
  const std::vector<Vector3d> normals = NormalsWith({0.1, 0.45, 0.5, 0.2});
  AttackGrasp grasp;
  grasp.planned = On(0, 1, 1.0);
  // Three of four draws meet the object: jaw 2 is the steeper one in the first, jaw 1 in the last.
  grasp.executed = {On(0, 1, 0.9), On(0, 3, 0.5), On(2, 3, 0.7)};
  const double friction = 0.6 * 0.5 * (1.0 + std::cos(std::numbers::pi / 6.0));
  const double quality = (0.9 * Phi((friction - 0.45) / 0.1) + 0.5 * Phi((friction - 0.2) / 0.1) +
                          0.7 * Phi((friction - 0.5) / 0.1)) /
                         4.0;
  MetricOptions metric = Metric();
  metric.percentile = 50.0;  // of one grasp: its quality, whatever the kernel is
  EXPECT_NEAR(EvaluateObjective({grasp}, normals, metric, Softness()).value, quality, 1e-9);
  // At 30 percent it is Phi^-1(0.3) = -0.52440 kernels of 0.4 times the quality below.
  EXPECT_NEAR(EvaluateObjective({grasp}, normals, Metric(), Softness()).value,
              quality * (1.0 - 0.4 * 0.524400513), 1e-8);
}

TEST(Objective, WeighsGraspsByHowMuchTheirPlanIsSampled) {
  // Planned at tangents 0.55, 0.65 and 0.1, executed at 0 with the reaches 0.2, 0.5 and 0.8.
  const std::vector<Vector3d> normals = NormalsWith({0.55, 0.0, 0.0, 0.65, 0.1, 0.0});
  const auto grasp = [](const Closing& planned, double reach) {
    return AttackGrasp{planned, {4, On(2, 1, reach)}};
  };
  const std::vector<AttackGrasp> grasps = {grasp(On(0, 1, 1.0), 0.2), grasp(On(2, 3, 1.0), 0.5),
                                           grasp(On(4, 5, 1.0), 0.8)};
  const double weight[] = {Phi(1.0), Phi(-1.0), Phi(10.0)};  // (0.6 - tangent) / 0.05
  const double friction = 0.6 * 0.5 * (1.0 + std::cos(std::numbers::pi / 6.0));
  const double holds = Phi(friction / 0.1);
  // 30 percent of 0.841 + 0.159 + 1 lie at the first grasp: the kernel is 0.4 of its quality.
  const double kernel = 0.4 * 0.2 * holds;
  const double v = EvaluateObjective(grasps, normals, Metric(), Softness()).value;
  double sum = 0.0, total = 0.0;
  for (int i = 0; i < 3; ++i) {
    sum += weight[i] * Phi((v - (0.2 + 0.3 * i) * holds) / kernel);
    total += weight[i];
  }
  EXPECT_NEAR(sum, 0.3 * total, 1e-9);
}

TEST(Objective, OfNothingIsZero) {
  const std::vector<Vector3d> normals = NormalsWith({0.1, 0.2});
  const SmoothPercentile none = EvaluateObjective({}, normals, Metric(), Softness());
  EXPECT_EQ(none.value, 0.0);
  ASSERT_EQ(none.by_normal.size(), 2u);
  EXPECT_TRUE(none.by_normal[1].isZero(0.0));
}

TEST(AttackGrasps, ReachFallsWithTheDistanceFromTheCentreOfMassAndFacesAreOfTheirJaws) {
  const TriangleMesh box = shapes::Box({0.1, 0.04, 0.1});
  MetricOptions metric;
  metric.torque_scale = 50.0;
  metric.collision = Collision::kJaws;
  ObjectiveOptions options;
  options.grasps = 40;
  options.draws = 3;
  const std::vector<NoiseDraw> still(5);  // no noise: executed as planned
  const auto grasps = SampleAttackGrasps(box, metric, options, still, 5, 0);
  ASSERT_EQ(grasps.size(), 40u);
  const auto normals = FaceNormals(box);
  double least = 1.0;
  for (const AttackGrasp& grasp : grasps) {
    const Closing& c = grasp.planned;
    // Jaw 1 moves along the axis and meets what looks against it.
    EXPECT_LT(normals[static_cast<std::size_t>(c.face[0])].dot(c.axis), 0.0);
    EXPECT_GT(normals[static_cast<std::size_t>(c.face[1])].dot(c.axis), 0.0);
    EXPECT_GT(c.reach, 1.0 / std::hypot(1.0, 50.0 * 0.072));  // no line is further from the middle
    EXPECT_LE(c.reach, 1.0);
    least = std::min(least, c.reach);
    ASSERT_EQ(grasp.executed.size(), 3u);
    for (const Closing& executed : grasp.executed) {
      EXPECT_EQ(executed.face, c.face);
      EXPECT_NEAR(executed.reach, c.reach, 1e-9);
    }
  }
  EXPECT_LT(least, 0.5);
  // Its own seed and its own step: other grasps each.
  const auto first = [&](std::uint64_t seed, std::uint64_t step) {
    return SampleAttackGrasps(box, metric, options, still, seed, step).front().planned.reach;
  };
  EXPECT_EQ(first(5, 0), grasps.front().planned.reach);
  EXPECT_NE(first(6, 0), first(5, 0));
  EXPECT_NE(first(5, 1), first(5, 0));
  EXPECT_NE(first(6, 0), first(5, 1));
}

// Half of the draws move the object out of the way.
TEST(AttackGrasps, OfDrawsThatMissLeaveTheFacesOfTheOthers) {
  const TriangleMesh box = shapes::Box({0.03, 0.04, 0.05});
  MetricOptions metric;
  metric.collision = Collision::kJaws;
  std::vector<NoiseDraw> pool(2);
  pool[1].object_translation = Vector3d(1.0, 1.0, 1.0);
  ObjectiveOptions options;
  options.grasps = 20;
  const std::vector<Vector3d> normals = FaceNormals(box);
  std::size_t executed = 0;
  for (const AttackGrasp& grasp : SampleAttackGrasps(box, metric, options, pool, 5, 0)) {
    executed += grasp.executed.size();
    for (const Closing& closing : grasp.executed) {
      EXPECT_EQ(closing.face, grasp.planned.face);
      EXPECT_LT(closing.axis.dot(normals[static_cast<std::size_t>(closing.face[0])]), 0.0);
      EXPECT_GT(closing.axis.dot(normals[static_cast<std::size_t>(closing.face[1])]), 0.0);
    }
  }
  EXPECT_GT(executed, 150U);
  EXPECT_LT(executed, 350U);
}

TEST(AttackGrasps, AreSampledBeyondTheFrictionConeByTheGivenTangent) {
  MetricOptions metric;
  metric.friction = 0.3;
  metric.collision = Collision::kJaws;
  ObjectiveOptions options;
  options.grasps = 200;
  options.draws = 1;
  options.cone_width = 0.2;
  const TriangleMesh plate = shapes::Box({0.2, 0.2, 0.02});
  const auto normals = FaceNormals(plate);
  double largest = 0.0;
  for (const AttackGrasp& grasp :
       SampleAttackGrasps(plate, metric, options, std::vector<NoiseDraw>(1), 1, 0)) {
    const Vector3d& normal = normals[static_cast<std::size_t>(grasp.planned.face[0])];
    const double tangent =
        normal.cross(grasp.planned.axis).norm() / -normal.dot(grasp.planned.axis);
    largest = std::max(largest, tangent);
  }
  EXPECT_LE(largest, 0.5 + 1e-9);
  EXPECT_GT(largest, 0.45);
}

TEST(LargestTurn, IsTheAngleOfTheFaceThatTurnedMostAndPiWithoutArea) {
  TriangleMesh box = shapes::Box({1, 2, 3});
  const auto normals = FaceNormals(box);
  EXPECT_NEAR(LargestTurn(box, normals), 0.0, 1e-12);
  for (Vector3d& v : box.vertices) {
    if (v.x() > 0 && v.z() > 0) v.z() += std::tan(0.1);
  }
  EXPECT_NEAR(LargestTurn(box, normals), 0.1, 1e-12);
  box.vertices[1] = box.vertices[0];
  EXPECT_EQ(LargestTurn(box, normals), std::numbers::pi);
}

TEST(TurnBack, TurnsAFaceJustInsideTheRimAboutItsCentroid) {
  // One triangle turned by 20 degrees about y comes back to 10 less 0.2 percent.
  const TriangleMesh start{{{0, 0, 0}, {3, 0, 0}, {0, 1, 0}}, {{{0, 1, 2}}}};
  const Vector3d centroid(1.0, 1.0 / 3.0, 0.0);
  const auto turned = [&](double degrees) {
    TriangleMesh mesh = start;
    const Eigen::AngleAxisd turn(degrees * kDegree, Vector3d::UnitY());
    for (Vector3d& v : mesh.vertices) v = centroid + turn * (v - centroid);
    return mesh;
  };
  TriangleMesh mesh = turned(20.0);
  EXPECT_EQ(TurnBack(start, FaceNormals(start), 10.0 * kDegree, 1, &mesh), 1);
  const TriangleMesh expected = turned(10.0 * (1.0 - 2e-3));
  for (std::size_t v = 0; v < 3; ++v) {
    EXPECT_NEAR((mesh.vertices[v] - expected.vertices[v]).norm(), 0.0, 1e-12);
  }
  EXPECT_EQ(TurnBack(start, FaceNormals(start), 10.0 * kDegree, 1, &mesh), 0);
  // Beyond three times the angle it is put back, moved by the mean: not at all.
  mesh = turned(31.0);
  EXPECT_EQ(TurnBack(start, FaceNormals(start), 10.0 * kDegree, 1, &mesh), 1);
  for (std::size_t v = 0; v < 3; ++v) {
    EXPECT_NEAR((mesh.vertices[v] - start.vertices[v]).norm(), 0.0, 1e-12);
  }
}

TEST(SearchOptions, EveryKeySetsItsOwnField) {
  SearchOptions options;
  ObjectiveOptions& objective = options.objective;
  OptionTable table;
  Bind(&table, &options);
  const std::pair<const char*, double*> numbers[] = {
      {"alpha", &options.alpha},
      {"step", &options.step},
      {"last_step", &options.last_step},
      {"start_noise", &options.start_noise},
      {"max_move", &options.max_move},
      {"cone_width", &objective.cone_width},
      {"acceptance_softness", &objective.acceptance_softness},
      {"slip_softness", &objective.slip_softness},
      {"percentile_softness", &objective.percentile_softness}};
  double value = 0.125;
  for (const auto& [key, field] : numbers) {
    table.ApplyOverride("search." + std::string(key) + "=" + std::to_string(value));
    EXPECT_EQ(*field, value) << key;
    value += 0.0625;
  }
  const std::pair<const char*, int*> counts[] = {{"steps", &options.steps},
                                                 {"coarse", &options.coarse},
                                                 {"sweeps", &options.sweeps},
                                                 {"candidates", &options.candidates},
                                                 {"scoring_rounds", &options.scoring_rounds},
                                                 {"grasps", &objective.grasps},
                                                 {"draws", &objective.draws},
                                                 {"noise_pool", &objective.noise_pool}};
  int count = 11;
  for (const auto& [key, field] : counts) {
    table.ApplyOverride("search." + std::string(key) + "=" + std::to_string(count));
    EXPECT_EQ(*field, count++) << key;
  }
  table.ApplyOverride("search.keep_extents=false");
  EXPECT_FALSE(options.keep_extents);
}

TEST(PerturbBySearch, NoVertexLeavesTheBoxOrMovesFurtherThanAsked) {
  // Long steps throw vertices against both limits, a share of the diagonal and the box.
  const TriangleMesh ball = shapes::Sphere(1.0, 2);
  const auto searched = [&](double max_move, bool keep_extents) {
    SearchOptions options;
    options.alpha = 20.0;
    options.steps = 20;
    options.step = 0.5;
    options.max_move = max_move;
    options.keep_extents = keep_extents;
    options.candidates = 4;
    options.scoring_rounds = 1;
    options.objective.grasps = 60;
    options.objective.draws = 5;
    MetricOptions metric;
    metric.num_grasps = 30;
    metric.num_draws = 5;
    RngStream rng(1, "perturb");
    return PerturbBySearch(ball, metric, options, &rng);
  };
  const auto largest = [](const PerturbResult& result) {
    double move = 0.0;
    for (std::size_t v = 0; v < result.mesh.vertices.size(); ++v) {
      move = std::max(move, (result.mesh.vertices[v] - result.start.vertices[v]).norm());
    }
    return move / Bounds(result.start).Extent().norm();
  };
  const auto grown = [](const PerturbResult& result) {
    return (Bounds(result.mesh).Extent() - Bounds(result.start).Extent()).maxCoeff();
  };
  const PerturbResult inside = searched(2.0, true), free = searched(2.0, false);
  for (const PerturbResult* result : {&inside, &free}) {
    EXPECT_EQ(result->failure, "");
    EXPECT_EQ(result->iterations, 20);
    EXPECT_GT(result->moved, 10);  // a state of the second half
    EXPECT_LE(largest(*result), 0.02);
    EXPECT_GT(largest(*result), 0.018);
  }
  EXPECT_LE(grown(inside), 0.002);
  EXPECT_GT(grown(free), 0.05);
  EXPECT_LE(largest(searched(1.0, true)), 0.01);
}

}  // namespace
}  // namespace antigrasp
