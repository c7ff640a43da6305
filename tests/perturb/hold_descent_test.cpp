#include "antigrasp/perturb/hold_descent.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "antigrasp/perturb/subdivide.h"
#include "antigrasp/perturb/validity.h"
#include "antigrasp/quality/object_size.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

const BoundingBox kAnywhere{Vector3d::Constant(-10.0), Vector3d::Constant(10.0)};

TriangleMesh FineCube() { return Subdivided(shapes::Cube(), {5.0}); }

MetricOptions LowFriction() {
  MetricOptions metric;
  metric.friction = 0.25;
  return metric;
}

TriangleMesh Refined(const TriangleMesh& mesh, const BoundingBox& within = kAnywhere,
                     std::uint64_t seed = 1, double hausdorff = 5.0) {
  DescentOptions options;
  options.steps = 120;
  options.budget.hausdorff = hausdorff;
  return RefinedSolid(mesh, LowFriction(), options, within, seed);
}

// The share of executions that hold, on draws of its own.
double HoldOf(const TriangleMesh& mesh) {
  const MetricOptions metric = LowFriction();
  const ObjectiveOptions objective;
  std::vector<NoiseDraw> pool;
  RngStream noise(9, "hold-test");
  for (int i = 0; i < 1000; ++i) pool.push_back(DrawNoise(metric, &noise));
  const double scale = MetresPerUnit(metric, Bounds(mesh).Extent());
  return EvaluateMeanHold(SampleAttackGrasps(Transformed(mesh, scale, Vector3d::Zero()), metric,
                                             objective, pool, 9, 0),
                          FaceNormals(mesh), metric, objective)
      .value;
}

TEST(RefinedSolid, OfACubeIsASolidNearItThatHoldsInFarFewerExecutions) {
  const TriangleMesh cube = FineCube(), refined = Refined(cube, kAnywhere, 1, 10.0);
  EXPECT_EQ(WhyNotPrintable(refined), "");
  EXPECT_LT(HoldOf(refined), 0.8 * HoldOf(cube));
  // No vertex moves farther than the budget allows, so no surface does.
  const double diagonal = Bounds(cube).Extent().norm();
  double farthest = 0.0;
  ASSERT_EQ(refined.vertices.size(), cube.vertices.size());
  for (std::size_t v = 0; v < cube.vertices.size(); ++v) {
    farthest = std::max(farthest, (refined.vertices[v] - cube.vertices[v]).norm());
  }
  EXPECT_LE(farthest, 0.10 * diagonal);
  EXPECT_GT(farthest, 0.03 * diagonal);
}

TEST(RefinedSolid, DependsOnTheSeedAlone) {
  const TriangleMesh cube = FineCube();
  EXPECT_EQ(Refined(cube).vertices, Refined(cube).vertices);
  EXPECT_NE(Refined(cube).vertices, Refined(cube, kAnywhere, 2).vertices);
}

TEST(RefinedSolid, StaysInTheBoxOrIsTheMeshItself) {
  const TriangleMesh cube = FineCube();
  BoundingBox room = Bounds(cube);
  const double more = 0.03 * room.Extent().norm();
  room = {room.min - Vector3d::Constant(more), room.max + Vector3d::Constant(more)};
  const TriangleMesh refined = Refined(cube, room);
  EXPECT_NE(refined.vertices, cube.vertices);
  const BoundingBox bounds = Bounds(refined);
  EXPECT_TRUE((bounds.min.array() >= room.min.array()).all());
  EXPECT_TRUE((bounds.max.array() <= room.max.array()).all());
  // A box that already cuts the mesh holds no change of it.
  room.max.x() = 0.0;
  EXPECT_EQ(Refined(cube, room).vertices, cube.vertices);
}

TEST(RefinedSolid, OfWhatIsNoSolidIsTheMeshItself) {
  TriangleMesh open = FineCube();
  open.faces.pop_back();
  EXPECT_EQ(Refined(open).vertices, open.vertices);
  EXPECT_EQ(Refined(open).faces, open.faces);
}

}  // namespace
}  // namespace antigrasp
