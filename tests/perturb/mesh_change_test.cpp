#include "antigrasp/perturb/mesh_change.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

TEST(MeshChange, AMeshIsLikeItself) {
  const TriangleMesh mesh = shapes::Torus(1.0, 0.4, 24, 12);
  const MeshChange same = CompareMeshes(mesh, mesh);
  EXPECT_EQ(CompareNormals(mesh, mesh).largest, 0.0);
  EXPECT_NEAR(same.hausdorff, 0.0, 1e-12);
  EXPECT_NEAR(same.chamfer, 0.0, 1e-12);
  EXPECT_EQ(same.volume_change, 0.0);
  EXPECT_EQ(same.center_of_mass, 0.0);
}

TEST(MeshChange, OfAGrownBallIsTheDifferenceOfTheRadii) {
  const TriangleMesh ball = shapes::Sphere(1.0, 4), grown = shapes::Sphere(1.02, 4);
  const MeshChange s = CompareMeshes(ball, grown);
  const double percent = 100.0 / Bounds(ball).Extent().norm();
  EXPECT_NEAR(s.hausdorff, 0.02 * percent, 0.02 * 0.01 * percent);
  EXPECT_NEAR(s.chamfer, 0.02 * percent, 0.02 * 0.01 * percent);
  EXPECT_NEAR(s.volume_change, 100 * (1.02 * 1.02 * 1.02 - 1), 1e-9);
  EXPECT_NEAR(CompareNormals(ball, grown).largest, 0.0, 1e-6);
  EXPECT_NEAR(s.center_of_mass, 0.0, 1e-9);
}

TEST(MeshChange, OfABoxWithAMovedCornerIsKnown) {
  const TriangleMesh box = shapes::Box({1, 1, 1});
  TriangleMesh changed = box;
  for (Vector3d& v : changed.vertices) {
    if (v.x() > 0) v.x() += 0.1;  // one side moved out
  }
  const MeshChange s = CompareMeshes(box, changed);
  const double percent = 100.0 / std::sqrt(3.0);
  EXPECT_NEAR(s.hausdorff, 0.1 * percent, 1e-9);
  EXPECT_NEAR(s.volume_change, 10.0, 1e-9);
  EXPECT_NEAR(s.center_of_mass, 0.05 * percent, 1e-9);
  EXPECT_NEAR(CompareNormals(box, changed).largest, 0.0, 1e-6);
  EXPECT_GT(s.chamfer, 0.0);
  EXPECT_LT(s.chamfer, s.hausdorff);
}

TEST(MeshChange, KnowsTheAngleByWhichASideTurned) {
  const TriangleMesh box = shapes::Box({1, 1, 1});
  TriangleMesh changed = box;
  for (Vector3d& v : changed.vertices) {
    if (v.x() > 0 && v.z() > 0) v.z() += std::tan(0.1);  // the top tilts by 0.1 rad
  }
  const NormalDeviation s = CompareNormals(box, changed);
  EXPECT_NEAR(s.largest, 0.1 * 180 / M_PI, 1e-9);
  EXPECT_NEAR(s.mean, 0.1 * 180 / M_PI / 6, 1e-9);  // one of six sides
}

TEST(MeshChange, WeighsTurnedSidesByTheFirstMeshsArea) {
  const TriangleMesh box = shapes::Box({1, 2, 3});
  TriangleMesh changed = box;
  for (Vector3d& v : changed.vertices) {
    if (v.x() > 0 && v.z() > 0) v.z() += std::tan(0.1);
  }
  // The top, 1 x 2 of 2 (2 + 3 + 6), turns by 0.1; back again it is 2 / cos 0.1 large, and the
  // sides at -y, +y and +x have grown by tan 0.1 / 2, / 2 and 2 tan 0.1.
  EXPECT_NEAR(CompareNormals(box, changed).mean, 0.1 * 180 / M_PI * 2 / 22, 1e-9);
  const double top = 2.0 / std::cos(0.1), grown = 3.0 * std::tan(0.1);
  EXPECT_NEAR(CompareNormals(changed, box).mean, 0.1 * 180 / M_PI * top / (20 + top + grown), 1e-9);
  EXPECT_NEAR(CompareNormals(changed, box).largest, 0.1 * 180 / M_PI, 1e-9);
}

TEST(MeshChange, LooksFromBothSurfacesAndMeasuresByTheFirst) {
  // A corner pulled out along the diagonal: the tip is sqrt(3) x 0.3 from the cube, while no point
  // of the cube is that far from the changed one.
  const TriangleMesh cube = shapes::Cube();
  TriangleMesh pulled = cube;
  pulled.vertices[7] += Vector3d::Constant(0.3);
  ASSERT_EQ(cube.vertices[7], Vector3d::Constant(0.5));
  const double tip = 0.3 * std::sqrt(3.0), first = std::sqrt(3.0), second = 1.3 * std::sqrt(3.0);
  const MeshChange there = CompareMeshes(cube, pulled), back = CompareMeshes(pulled, cube);
  EXPECT_NEAR(there.hausdorff, 100.0 * tip / first, 1e-9);
  EXPECT_NEAR(back.hausdorff, 100.0 * tip / second, 1e-9);
  EXPECT_NEAR(there.chamfer * first, back.chamfer * second, 1e-9);
  const double volume = Volume(pulled);
  EXPECT_GT(volume, 1.05);
  EXPECT_NEAR(there.volume_change, 100.0 * (volume - 1.0), 1e-9);
  EXPECT_NEAR(back.volume_change, 100.0 * (1.0 - volume) / volume, 1e-9);
  EXPECT_NEAR(there.center_of_mass * first, back.center_of_mass * second, 1e-9);
  EXPECT_NEAR(there.center_of_mass, 100.0 * CenterOfMass(pulled).norm() / first, 1e-9);
}

TEST(MeshChange, TheMeanDistanceIsOfAreaSamplesOfBothSurfaces) {
  // A slab of 10 x 10 x 1 whose top is moved up by 0.01: of the first surface a share of
  // 100 / 240 lies 0.01 from the second, of the second 100 / 240.4 and of what the four sides grew,
  // 0.4 / 240.4, half of that. The rest is 0.
  const TriangleMesh slab = shapes::Box({10, 10, 1});
  TriangleMesh thicker = slab;
  for (Vector3d& v : thicker.vertices) v.z() += v.z() > 0 ? 0.01 : 0.0;
  const double mean = 0.5 * 0.01 * (100.0 / 240.0 + 100.2 / 240.4);
  const double diagonal = std::sqrt(201.0);
  EXPECT_NEAR(CompareMeshes(slab, thicker, 20000).chamfer, 100.0 * mean / diagonal,
              0.03 * 100.0 * mean / diagonal);
}

TEST(MeshChange, ComparesNoNormalsOfMeshesWithOtherFaces) {
  const TriangleMesh fine = shapes::Sphere(1.0, 3), coarse = shapes::Sphere(1.0, 2);
  EXPECT_TRUE(std::isnan(CompareNormals(fine, coarse).largest));
  EXPECT_TRUE(std::isnan(CompareNormals(fine, coarse).mean));
  const MeshChange s = CompareMeshes(fine, coarse);
  EXPECT_GT(s.hausdorff, 0.1);
  EXPECT_LT(s.hausdorff, 1.0);
}

}  // namespace
}  // namespace antigrasp
