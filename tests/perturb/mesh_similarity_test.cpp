#include "antigrasp/perturb/mesh_similarity.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

TEST(MeshSimilarity, AMeshIsLikeItself) {
  const TriangleMesh mesh = shapes::Torus(1.0, 0.4, 24, 12);
  const MeshSimilarity same = CompareMeshes(mesh, mesh);
  EXPECT_EQ(CompareNormals(mesh, mesh).largest, 0.0);
  EXPECT_NEAR(same.hausdorff, 0.0, 1e-12);
  EXPECT_NEAR(same.chamfer, 0.0, 1e-12);
  EXPECT_EQ(same.volume_change, 0.0);
  EXPECT_EQ(same.center_of_mass, 0.0);
}

TEST(MeshSimilarity, OfAGrownBallIsTheDifferenceOfTheRadii) {
  const TriangleMesh ball = shapes::Sphere(1.0, 4), grown = shapes::Sphere(1.02, 4);
  const MeshSimilarity s = CompareMeshes(ball, grown);
  const double percent = 100.0 / Bounds(ball).Extent().norm();
  EXPECT_NEAR(s.hausdorff, 0.02 * percent, 0.02 * 0.01 * percent);
  EXPECT_NEAR(s.chamfer, 0.02 * percent, 0.02 * 0.01 * percent);
  EXPECT_NEAR(s.volume_change, 100 * (1.02 * 1.02 * 1.02 - 1), 1e-9);
  EXPECT_NEAR(CompareNormals(ball, grown).largest, 0.0, 1e-6);
  EXPECT_NEAR(s.center_of_mass, 0.0, 1e-9);
}

TEST(MeshSimilarity, OfABoxWithAMovedCornerIsKnown) {
  const TriangleMesh box = shapes::Box({1, 1, 1});
  TriangleMesh changed = box;
  for (Vector3d& v : changed.vertices) {
    if (v.x() > 0) v.x() += 0.1;  // one side moved out
  }
  const MeshSimilarity s = CompareMeshes(box, changed);
  const double percent = 100.0 / std::sqrt(3.0);
  EXPECT_NEAR(s.hausdorff, 0.1 * percent, 1e-9);
  EXPECT_NEAR(s.volume_change, 10.0, 1e-9);
  EXPECT_NEAR(s.center_of_mass, 0.05 * percent, 1e-9);
  EXPECT_NEAR(CompareNormals(box, changed).largest, 0.0, 1e-6);
  EXPECT_GT(s.chamfer, 0.0);
  EXPECT_LT(s.chamfer, s.hausdorff);
}

TEST(MeshSimilarity, KnowsTheAngleByWhichASideTurned) {
  const TriangleMesh box = shapes::Box({1, 1, 1});
  TriangleMesh changed = box;
  for (Vector3d& v : changed.vertices) {
    if (v.x() > 0 && v.z() > 0) v.z() += std::tan(0.1);  // the top tilts by 0.1 rad
  }
  const NormalDeviation s = CompareNormals(box, changed);
  EXPECT_NEAR(s.largest, 0.1 * 180 / M_PI, 1e-9);
  EXPECT_NEAR(s.mean, 0.1 * 180 / M_PI / 6, 1e-9);  // one of six sides
}

TEST(MeshSimilarity, ComparesNoNormalsOfMeshesWithOtherFaces) {
  const TriangleMesh fine = shapes::Sphere(1.0, 3), coarse = shapes::Sphere(1.0, 2);
  EXPECT_TRUE(std::isnan(CompareNormals(fine, coarse).largest));
  EXPECT_TRUE(std::isnan(CompareNormals(fine, coarse).mean));
  const MeshSimilarity s = CompareMeshes(fine, coarse);
  EXPECT_GT(s.hausdorff, 0.1);
  EXPECT_LT(s.hausdorff, 1.0);
}

}  // namespace
}  // namespace antigrasp
