#include "antigrasp/perturb/subdivide.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "antigrasp/core/error.h"
#include "antigrasp/mesh/inspect.h"
#include "antigrasp/perturb/perturb_folder.h"
#include "antigrasp/perturb/perturb_summary.h"
#include "antigrasp/perturb/scored_perturbation.h"
#include "antigrasp/perturb/search.h"
#include "antigrasp/perturb/validity.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

double ShortestEdge(const TriangleMesh& mesh) {
  double shortest = 1e300;
  for (const auto& f : mesh.faces) {
    for (std::size_t k = 0; k < 3; ++k) {
      shortest = std::min(shortest, (mesh.vertices[static_cast<std::size_t>(f[(k + 1) % 3])] -
                                     mesh.vertices[static_cast<std::size_t>(f[k])])
                                        .norm());
    }
  }
  return shortest;
}

// In degrees.
double SmallestAngle(const TriangleMesh& mesh) {
  double smallest = 180.0;
  for (const auto& f : mesh.faces) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3d& a = mesh.vertices[static_cast<std::size_t>(f[k])];
      const Vector3d to_b = mesh.vertices[static_cast<std::size_t>(f[(k + 1) % 3])] - a;
      const Vector3d to_c = mesh.vertices[static_cast<std::size_t>(f[(k + 2) % 3])] - a;
      const double angle = std::atan2(to_b.cross(to_c).norm(), to_b.dot(to_c));
      smallest = std::min(smallest, angle * 180.0 / std::numbers::pi);
    }
  }
  return smallest;
}

TEST(SplitLongEdges, KeepsABoxABox) {
  // Lopsided and away from the origin: every corner lies on one of the six planes.
  const Vector3d extents(1.0, 2.0, 3.5), centre(4.0, -5.0, 6.0);
  const TriangleMesh box = Transformed(shapes::Box(extents), 1.0, centre);
  const TriangleMesh fine = SplitLongEdges(box, 0.2);
  EXPECT_LE(LongestEdge(fine), 0.2);
  EXPECT_GT(fine.faces.size(), 1000U);
  const MeshReport report = Inspect(fine);
  EXPECT_EQ(WhyNotSolid(report), "");
  EXPECT_NEAR(report.volume, 7.0, 1e-12);
  EXPECT_NEAR(SurfaceArea(fine), SurfaceArea(box), 1e-12);
  for (const Vector3d& v : fine.vertices) {
    const Vector3d from_side = ((v - centre).cwiseAbs() - 0.5 * extents).cwiseAbs();
    EXPECT_LE(from_side.minCoeff(), 1e-12);
    EXPECT_TRUE(((v - centre).cwiseAbs().array() <= (0.5 * extents).array() + 1e-12).all());
  }
  // The first corners are the box's own, in their order.
  for (std::size_t v = 0; v < box.vertices.size(); ++v) {
    EXPECT_EQ(fine.vertices[v], box.vertices[v]);
  }
}

TEST(SplitLongEdges, SplitsTheLongestFirstSoThatNoAngleIsMuchSmaller) {
  // Each side of a cube is two right triangles with two edges of 1: their bisection along the
  // longest edge gives such triangles for ever.
  const TriangleMesh cube = SplitLongEdges(shapes::Cube(), 0.3);
  EXPECT_NEAR(SmallestAngle(cube), 45.0, 1e-9);
  EXPECT_GE(ShortestEdge(cube), 0.3 / 2.0 - 1e-12);
  // A cylinder's sides are slivers 3 long and 0.13 wide.
  const TriangleMesh rod = shapes::Cylinder(1.0, 3.0, 48);
  EXPECT_GE(SmallestAngle(SplitLongEdges(rod, 0.2)), 0.5 * SmallestAngle(rod));
}

TEST(SplitLongEdges, LeavesFineMeshesAlone) {
  const TriangleMesh ball = shapes::Sphere(1.0, 3);
  const TriangleMesh same = SplitLongEdges(ball, LongestEdge(ball));
  EXPECT_EQ(same.vertices, ball.vertices);
  EXPECT_EQ(same.faces, ball.faces);
  EXPECT_GT(SplitLongEdges(ball, 0.99 * LongestEdge(ball)).faces.size(), ball.faces.size());
}

TEST(LongestEdge, IsTheLongest) {
  EXPECT_NEAR(LongestEdge(shapes::Box({3.0, 4.0, 1.0})), 5.0, 1e-15);  // a side's diagonal
  EXPECT_EQ(LongestEdge(TriangleMesh{}), 0.0);
}

TEST(Subdivided, SplitsWhatIsCoarseUnlessALengthIsGiven) {
  // A cube's diagonal is sqrt(3): its longest edge, sqrt(2), is 82 % of that.
  const double diagonal = std::sqrt(3.0);
  EXPECT_TRUE(IsCoarse(shapes::Cube()));
  EXPECT_FALSE(IsCoarse(shapes::Sphere(1.0, 2)));
  EXPECT_EQ(Subdivided(shapes::Cube(), {100.0}).faces.size(), 12U);
  EXPECT_EQ(SubdivideOptions{}.longest, 100.0);
  EXPECT_LE(LongestEdge(Subdivided(shapes::Cube(), {0.0})), 0.04 * diagonal);
  EXPECT_GT(LongestEdge(Subdivided(shapes::Cube(), {0.0})), 0.02 * diagonal);
  EXPECT_LE(LongestEdge(Subdivided(shapes::Cube(), {20.0})), 0.2 * diagonal);
  const TriangleMesh ball = shapes::Sphere(1.0, 2);  // edges of 9 % of the diagonal
  EXPECT_EQ(Subdivided(ball, {0.0}).faces.size(), ball.faces.size());
  EXPECT_GT(Subdivided(ball, {5.0}).faces.size(), ball.faces.size());
}

TEST(Subdivided, RefusesALengthThatGivesMillionsOfFaces) {
  EXPECT_NO_THROW(RequireSubdivision({0.0}, "here"));
  EXPECT_NO_THROW(RequireSubdivision({0.5}, "here"));
  EXPECT_THROW(RequireSubdivision({0.4}, "here"), InputError);
}

PerturbSettings QuickSearch(double longest, double alpha) {
  PerturbSettings settings;
  settings.subdivide.longest = longest;
  settings.method = [metric = settings.metric, alpha](const TriangleMesh& mesh, const PairLimits&,
                                                      const PerturbOptions&, RngStream* rng,
                                                      const ProgressFn& progress) {
    SearchOptions options;
    options.alpha = alpha;
    options.steps = 30;
    options.candidates = 2;
    options.objective.grasps = 60;
    return PerturbBySearch(mesh, metric, options, rng, progress);
  };
  return settings;
}

TEST(PerturbAndScore, MovesAFlatBoxOnceItHasCorners) {
  const TriangleMesh box = shapes::Box({20.0, 30.0, 50.0});  // millimetres, and so the result
  const ScoredPerturbation s = PerturbAndScore(box, QuickSearch(0.0, 20.0), 0);
  EXPECT_EQ(s.result.failure, "");
  EXPECT_GT(s.result.moved, 0);
  EXPECT_LT(s.graspability_after, s.graspability_before);
  EXPECT_GT(s.normals.largest, 5.0);
  EXPECT_LE(s.normals.largest, 20.0);
  EXPECT_EQ(s.before.faces.size(), s.result.mesh.faces.size());
  EXPECT_NEAR(Volume(s.before), 30000.0, 1e-6);
  EXPECT_NEAR(Bounds(s.result.mesh).Extent().z(), 50.0, 2.0);
}

TEST(PerturbAndScore, NamesABoxOfTwelveFacesThatItCouldNotMove) {
  const ScoredPerturbation s =
      PerturbAndScore(shapes::Box({1.0, 1.5, 2.5}), QuickSearch(100.0, 10.0), 0);
  EXPECT_EQ(s.result.failure, "unchanged: too few vertices: 8");
  EXPECT_EQ(s.result.moved, 0);
  EXPECT_EQ(s.graspability_after, s.graspability_before);
}

TEST(PerturbAndScore, AFineMeshThatDidNotMoveIsNoFailure) {
  PerturbSettings settings;
  settings.method = [](const TriangleMesh& mesh, const PairLimits&, const PerturbOptions&,
                       RngStream*, const ProgressFn&) {
    PerturbResult result;
    result.start = result.mesh = InSinglePrecision(mesh);
    result.iterations = 7;
    return result;
  };
  EXPECT_EQ(PerturbAndScore(shapes::Sphere(1.0, 2), settings, 0).result.failure, "");
  EXPECT_EQ(PerturbAndScore(shapes::Cube(), settings, 0).result.failure,
            "unchanged: too few vertices: 8");
  settings.subdivide.longest = 0.0;
  EXPECT_EQ(PerturbAndScore(shapes::Cube(), settings, 0).result.failure, "");
}

TEST(PerturbMeans, LeaveOutWhatHadTooFewVertices) {
  const auto object = [](double before, double after, const std::string& failure) {
    PerturbedObject item;
    item.object.status = "ok";
    item.scored.graspability_before = before;
    item.scored.graspability_after = after;
    item.scored.result.failure = failure;
    item.scored.result.mesh = shapes::Cube();
    return item;
  };
  const std::vector<PerturbedObject> objects = {
      object(0.004, 0.002, ""), object(0.008, 0.008, "unchanged: too few vertices: 8")};
  const PerturbMeans means = MeansOf({RowOf(objects[0]), RowOf(objects[1])});
  EXPECT_EQ(means.objects, 2);
  EXPECT_EQ(means.ok, 1);
  EXPECT_NEAR(means.reduction.mean, 50.0, 1e-12);
  EXPECT_EQ(FailedText({RowOf(objects[0]), RowOf(objects[1])}), "1 unchanged");
}

}  // namespace
}  // namespace antigrasp
