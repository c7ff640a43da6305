#include "antigrasp/perturb/search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "antigrasp/core/angles.h"
#include "antigrasp/core/error.h"
#include "antigrasp/datasets/prior_set.h"
#include "antigrasp/mesh/inspect.h"
#include "antigrasp/perturb/mesh_change.h"
#include "antigrasp/perturb/search_projection.h"
#include "antigrasp/quality/epsilon.h"
#include "antigrasp/quality/graspability.h"
#include "antigrasp/sdf/remesh.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

Vector3d RandomVector(RngStream* rng) {
  const double x = rng->Normal(), y = rng->Normal();
  return {x, y, rng->Normal()};
}

TriangleMesh InMetres(const TriangleMesh& mesh) {
  return Transformed(mesh, 0.04 / Bounds(mesh).Extent().minCoeff(), Vector3d::Zero());
}

std::vector<AttackGrasp> Sampled(const TriangleMesh& metres, const ObjectiveOptions& options) {
  std::vector<NoiseDraw> pool;
  RngStream rng(3, "pool");
  for (int i = 0; i < 500; ++i) pool.push_back(DrawNoise({}, &rng));
  return SampleAttackGrasps(metres, {}, options, pool, 5, 0);
}

// Few and cheap steps.
SearchOptions Quick(double alpha) {
  SearchOptions options;
  options.alpha = alpha;
  options.steps = 60;
  options.candidates = 2;
  options.objective.grasps = 60;
  return options;
}

std::vector<TriangleMesh> Cylinders(int count) {
  PriorSetOptions options;
  options.count = 2 * count;
  options.resolution = 20;
  std::vector<TriangleMesh> meshes;
  for (const SdfGrid& grid : MakePriorSet(options).grids) {
    const RemeshResult result = Remesh(grid);
    if (result.ok() && static_cast<int>(meshes.size()) < count) meshes.push_back(result.mesh);
  }
  return meshes;
}

TEST(AttackGrasps, ReachIsEpsilonUpToTheTorsionAwayFromTheRim) {
  // Two contacts that face each other along a line at distance d from the centre of mass.
  const double cap = std::numbers::pi * 0.005 * 0.005 * 0.5 * 1000.0;
  for (const double d : {0.0, 0.002, 0.01, 0.03}) {
    std::array<Contact, 2> contacts;
    contacts[0] = {{-0.02, d, 0.0}, {-1.0, 0.0, 0.0}, 1.0};
    contacts[1] = {{0.02, d, 0.0}, {1.0, 0.0, 0.0}, 1.0};
    const double torque = 1000.0 * d;
    EXPECT_NEAR(Epsilon(contacts, Vector3d::Zero(), {}) / cap,
                1.0 / std::sqrt(1.0 + torque * torque), 0.02)
        << d;
  }
}

TEST(Objective, TracksTheGraspabilityOfTheMetric) {
  ObjectiveOptions options;
  options.grasps = 1000;
  options.percentile_softness = 0.05;  // next to no smoothing
  options.acceptance_softness = 0.005;
  options.slip_softness = 0.005;
  MetricOptions metric;
  metric.num_grasps = 1000;
  metric.max_attempts = 40000;
  const double cap = std::numbers::pi * 0.005 * 0.005 * 0.5 * 1000.0;
  for (const TriangleMesh& mesh : {shapes::Cylinder(1.0, 3.0, 48), shapes::Box({1.0, 1.2, 2.0})}) {
    const TriangleMesh metres = InMetres(mesh);
    const double value =
        EvaluateObjective(Sampled(metres, options), FaceNormals(metres), metric, options).value;
    const double exact = EvaluateGraspability(metres, metric, 2, 0).value;
    // Above, because epsilon falls by its cosine and before the cone's rim.
    EXPECT_GT(cap * value / exact, 0.95);
    EXPECT_LT(cap * value / exact, 1.4);
  }
}

TEST(Objective, DerivativeByNormalsAgreesWithDifferences) {
  const TriangleMesh metres = InMetres(shapes::Cylinder(1.0, 3.0, 24));
  ObjectiveOptions options;
  options.grasps = 80;
  const auto grasps = Sampled(metres, options);
  ASSERT_EQ(grasps.size(), 80U);
  RngStream rng(7, "normals");
  std::vector<Vector3d> normals = FaceNormals(metres);
  for (Vector3d& n : normals) n = (n + 0.1 * RandomVector(&rng)).normalized();
  const SmoothPercentile at = EvaluateObjective(grasps, normals, {}, options);
  double size = 0.0;
  for (const Vector3d& d : at.by_normal) size = std::max(size, d.norm());
  EXPECT_GT(size, 0.0);
  constexpr double kStep = 1e-6;
  int compared = 0, agree = 0;
  for (std::size_t f = 0; f < normals.size(); ++f) {
    if (at.by_normal[f].norm() < 0.2 * size) continue;
    const Vector3d direction = RandomVector(&rng).normalized();
    auto more = normals, less = normals;
    more[f] += kStep * direction;
    less[f] -= kStep * direction;
    const double slope = (EvaluateObjective(grasps, more, {}, options).value -
                          EvaluateObjective(grasps, less, {}, options).value) /
                         (2.0 * kStep);
    ++compared;
    agree += std::abs(slope - at.by_normal[f].dot(direction)) < 1e-4 * size ? 1 : 0;
  }
  EXPECT_GE(compared, 5);
  // A face that the one grasp meets that sets the kernel's width moves the width as well.
  EXPECT_GE(agree, 0.7 * compared);
}

TEST(Objective, DerivativeByVerticesAgreesWithDifferences) {
  const TriangleMesh mesh = shapes::Sphere(1.0, 1);
  RngStream rng(1, "weights");
  std::vector<Vector3d> weights;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) weights.push_back(RandomVector(&rng));
  const auto value = [&](const TriangleMesh& at) {
    double sum = 0.0;
    const auto normals = FaceNormals(at);
    for (std::size_t f = 0; f < normals.size(); ++f) sum += weights[f].dot(normals[f]);
    return sum;
  };
  const auto by_vertex = DerivativeByVertices(mesh, weights);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    for (int k = 0; k < 3; ++k) {
      TriangleMesh more = mesh, less = mesh;
      more.vertices[v][k] += 1e-6;
      less.vertices[v][k] -= 1e-6;
      EXPECT_NEAR(by_vertex[v][k], (value(more) - value(less)) / 2e-6, 1e-6);
    }
  }
}

TEST(TurnBack, BringsEveryNormalOfARoughAndOfATurnedOverMeshIntoItsCone) {
  const TriangleMesh start = shapes::Sphere(1.0, 3);
  const auto normals = FaceNormals(start);
  RngStream rng(2, "rough");
  TriangleMesh rough = start;
  for (Vector3d& v : rough.vertices) v *= 1.0 + 0.05 * rng.Normal();
  rough.vertices[17] *= -0.5;  // turns all faces around it over
  for (const double angle : {2.0 * kDegree, 10.0 * kDegree, 30.0 * kDegree}) {
    TriangleMesh mesh = rough;
    EXPECT_GT(LargestTurn(mesh, normals), angle);
    EXPECT_EQ(TurnBack(start, normals, angle, 1000, &mesh), 0);
    EXPECT_LE(LargestTurn(mesh, normals), angle * (1.0 + 1e-12));
  }
}

TEST(TurnBack, LeavesAMeshInsideItsConesAlone) {
  const TriangleMesh start = shapes::Sphere(1.0, 2);
  TriangleMesh moved = Transformed(start, 1.2, {1.0, 2.0, 3.0});  // normals are the same
  const TriangleMesh before = moved;
  EXPECT_EQ(TurnBack(start, FaceNormals(start), 1e-3, 10, &moved), 0);
  EXPECT_EQ(moved.vertices, before.vertices);
}

TEST(PerturbBySearch, KeepsTheVolumeOfAMeshWithFewFaces) {
  // The normals alone would let the corners of a cube run together.
  RngStream rng(1, "perturb");
  const TriangleMesh cube = shapes::Cube();
  const PerturbResult result = PerturbBySearch(cube, {}, Quick(10.0), &rng);
  EXPECT_EQ(result.failure, "");
  const double most = 0.06 * Bounds(cube).Extent().norm();
  for (std::size_t v = 0; v < cube.vertices.size(); ++v) {
    EXPECT_LE((result.mesh.vertices[v] - cube.vertices[v]).norm(), most * (1.0 + 1e-6));
  }
  EXPECT_GT(Volume(result.mesh), 0.7 * Volume(cube));
}

TEST(PerturbBySearch, FromCoarseToFineMovesTheSurfaceFurtherUnderTheSameLimit) {
  const TriangleMesh mesh = Cylinders(1).front();
  SearchOptions fine = Quick(10.0), coarse = fine;
  coarse.coarse = 100;
  double distance[2];
  for (const int i : {0, 1}) {
    RngStream rng(1, "perturb");
    const PerturbResult result = PerturbBySearch(mesh, {}, i == 0 ? fine : coarse, &rng);
    EXPECT_LE(CompareNormals(result.start, result.mesh).largest, 10.0);
    EXPECT_TRUE(Inspect(result.mesh).IsSolid());
    distance[i] = CompareMeshes(result.start, result.mesh).chamfer;
  }
  EXPECT_GT(distance[1], 1.5 * distance[0]);
}

TEST(PerturbBySearch, LowersGraspabilityOnGraspsItNeverSawWithinItsLimits) {
  // Plain IV-B lowers it by 8 % at 10 degrees and 33 % at 20; the noise of one mean is 4 %.
  const std::vector<TriangleMesh> meshes = Cylinders(2);
  ASSERT_EQ(meshes.size(), 2U);
  for (const auto& [alpha, share] : {std::pair{10.0, 0.9}, std::pair{20.0, 0.65}}) {
    double before = 0.0, after = 0.0;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      RngStream rng(1, "perturb", i);
      const PerturbResult result = PerturbBySearch(meshes[i], {}, Quick(alpha), &rng);
      ASSERT_EQ(result.failure, "");
      EXPECT_GT(result.moved, 0);
      EXPECT_TRUE(Inspect(result.mesh).IsSolid());
      const double turned = CompareNormals(result.start, result.mesh).largest;
      EXPECT_LE(turned, alpha + 1e-9);
      EXPECT_GT(turned, 0.9 * alpha);
      const Eigen::Array3d extents =
          Bounds(result.mesh).Extent().array() / Bounds(result.start).Extent().array();
      EXPECT_LT(extents.maxCoeff(), 1.005);
      EXPECT_GT(extents.minCoeff(), 0.95);
      for (const std::uint64_t seed : {1000, 1001}) {
        before += EvaluateGraspability(result.start, {}, seed, i).value;
        after += EvaluateGraspability(result.mesh, {}, seed, i).value;
      }
    }
    EXPECT_LT(after, share * before) << alpha;
  }
}

TEST(PerturbBySearch, KeepsItsLimitsWhereTheyAreWide) {
  RngStream rng(1, "perturb");
  SearchOptions options = Quick(60.0);
  options.step = 2.0;  // throws vertices about
  const PerturbResult result = PerturbBySearch(shapes::Sphere(1.0, 3), {}, options, &rng);
  EXPECT_EQ(result.failure, "");
  EXPECT_LE(CompareNormals(result.start, result.mesh).largest, 60.0 + 1e-9);
  EXPECT_TRUE(Inspect(result.mesh).IsSolid());
}

TEST(PerturbBySearch, AlphaZeroChangesNothing) {
  const TriangleMesh mesh = shapes::Cylinder(1.0, 3.0, 24);
  RngStream rng(1, "perturb");
  const PerturbResult result = PerturbBySearch(mesh, {}, Quick(0.0), &rng);
  EXPECT_EQ(result.failure, "");
  EXPECT_EQ(result.mesh.vertices, InSinglePrecision(mesh).vertices);
  EXPECT_EQ(result.mesh.faces, mesh.faces);
  EXPECT_EQ(result.moved, 0);
}

TEST(PerturbBySearch, GivesTheSameMeshOnAnyThreadAndAnotherForAnotherStream) {
  const TriangleMesh mesh = shapes::Sphere(1.0, 2);
  SearchOptions options = Quick(15.0);
  options.steps = 20;
  std::vector<PerturbResult> results(4);
  ParallelFor(4, 3, [&](std::int64_t i) {
    RngStream rng(1, "perturb", i == 3 ? 1 : 0);
    results[static_cast<std::size_t>(i)] = PerturbBySearch(mesh, {}, options, &rng);
  });
  EXPECT_GT(results[0].moved, 0);
  EXPECT_EQ(results[0].mesh.vertices, results[1].mesh.vertices);
  EXPECT_EQ(results[0].mesh.vertices, results[2].mesh.vertices);
  EXPECT_NE(results[0].mesh.vertices, results[3].mesh.vertices);
}

TEST(PerturbBySearch, SaysWhyABrokenMeshIsNotMovedAndReportsProgress) {
  RngStream rng(1, "perturb");
  EXPECT_EQ(PerturbBySearch(shapes::FlatSquare(), {}, {}, &rng).failure.rfind("before: ", 0), 0U);
  SearchOptions options = Quick(10.0);
  options.steps = 5;
  std::int64_t calls = 0;
  PerturbBySearch(shapes::Sphere(1.0, 2), {}, options, &rng,
                  [&](std::int64_t done, std::int64_t total) {
                    EXPECT_EQ(done, ++calls);
                    EXPECT_EQ(total, 5);
                  });
  EXPECT_EQ(calls, 5);
}

TEST(PerturbBySearch, SurvivesAMetricWithoutNoiseAndAnObjectThatNoGraspFits) {
  MetricOptions metric;
  ApplyNoisePreset("none", &metric);
  RngStream rng(1, "perturb");
  SearchOptions options = Quick(10.0);
  options.steps = 10;
  EXPECT_EQ(PerturbBySearch(shapes::Sphere(1.0, 2), metric, options, &rng).failure, "");
  metric.jaw_opening = 0.01;  // narrower than the object
  const PerturbResult result = PerturbBySearch(shapes::Sphere(1.0, 2), metric, options, &rng);
  EXPECT_EQ(result.failure, "");
  EXPECT_EQ(result.moved, 0);
}

TEST(SearchOptions, AreRefusedOutsideTheirRanges) {
  SearchOptions options;
  OptionTable table;
  Bind(&table, &options);
  for (const char* bad : {"search.alpha=-1", "search.alpha=61", "search.steps=0", "search.step=0",
                          "search.draws=0", "search.percentile_softness=0"}) {
    EXPECT_THROW(table.ApplyOverride(bad), InputError) << bad;
  }
  table.ApplyOverride("search.alpha=20");
  EXPECT_EQ(options.alpha, 20.0);
}

}  // namespace
}  // namespace antigrasp
