#include "antigrasp/perturb/face_tree.h"

#include <gtest/gtest.h>

#include <set>

#include "antigrasp/perturb/sum_tree.h"
#include "tests/perturb/perturbed_shapes.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

std::set<std::int32_t> Overlapping(const FaceTree& tree, const BoundingBox& box) {
  std::set<std::int32_t> found;
  tree.AnyOverlap(box, [&](std::int32_t face) {
    found.insert(face);
    return false;
  });
  return found;
}

TEST(FaceTree, FindsTheFacesWhoseBoxesMeetABoxAlsoAfterTheMeshMoved) {
  RngStream rng(1, "face_tree");
  TriangleMesh mesh = shapes::Sphere(1.0, 2);
  FaceTree tree(mesh);
  for (int round = 0; round < 5; ++round) {
    for (int i = 0; i < 50; ++i) {
      const Vector3d center(rng.Uniform(-1, 1), rng.Uniform(-1, 1), rng.Uniform(-1, 1));
      const Vector3d half = Vector3d::Constant(rng.Uniform(0.0, 0.4));
      const BoundingBox box{center - half, center + half};
      std::set<std::int32_t> expected;
      for (std::int32_t f = 0; f < 320; ++f) {
        if (BoxesMeet(FaceBox(mesh, f), box)) expected.insert(f);
      }
      EXPECT_EQ(Overlapping(tree, box), expected);
    }
    mesh = shapes::Shaken(mesh, 0.2, &rng);
    for (std::int32_t f = 0; f < 320; ++f) tree.Refit(mesh, f);
  }
}

TEST(FaceTree, ARayFromTheMiddleOfASphereMeetsTheFaceItPointsAt) {
  const TriangleMesh mesh = shapes::Sphere(1.0, 3);
  const FaceTree tree(mesh);
  for (std::int32_t f = 0; f < 1280; f += 7) {
    const auto& face = mesh.faces[f];
    const Vector3d middle =
        (mesh.vertices[face[0]] + mesh.vertices[face[1]] + mesh.vertices[face[2]]) / 3.0;
    const auto hit = tree.FirstHit(mesh, Vector3d::Zero(), middle.normalized(), -1);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->face, f);
    EXPECT_NEAR(hit->distance, middle.norm(), 1e-12);
    // From the face through the middle to the other side, the face itself left out.
    const auto across = tree.FirstHit(mesh, middle, -middle.normalized(), f);
    ASSERT_TRUE(across);
    EXPECT_NEAR(across->distance, 2.0, 0.02);
    EXPECT_FALSE(tree.FirstHit(mesh, 1.1 * middle, middle.normalized(), -1));
  }
  // Along an axis: a zero in the direction.
  EXPECT_TRUE(tree.FirstHit(mesh, {0.1, 0.2, 0.0}, Vector3d::UnitZ(), -1));
}

TEST(SumTree, DrawsInProportionAndNeverAnItemOfWeightZero) {
  SumTree tree(5);
  tree.Set(1, 1.0);
  tree.Set(3, 3.0);
  EXPECT_EQ(tree.Total(), 4.0);
  EXPECT_EQ(tree.Find(0.0), 1u);
  EXPECT_EQ(tree.Find(0.999), 1u);
  EXPECT_EQ(tree.Find(1.0), 3u);
  EXPECT_EQ(tree.Find(3.999), 3u);
  EXPECT_EQ(tree.Find(4.0), 3u);  // rounding of a product may reach the total
  tree.Set(3, 0.0);
  EXPECT_EQ(tree.Find(0.999), 1u);
  tree.Set(0, 2.0);
  EXPECT_EQ(tree.Find(1.5), 0u);
  EXPECT_EQ(tree.Find(2.5), 1u);
}

}  // namespace
}  // namespace antigrasp
