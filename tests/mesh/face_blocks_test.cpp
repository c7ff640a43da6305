#include "antigrasp/mesh/face_blocks.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "antigrasp/mesh/ray_scene.h"
#include "tests/support/random_draws.h"
#include "tests/support/rippled_solid.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

// The faces of the blocks near a box.
std::set<std::uint32_t> FacesNear(const FaceBlocks& blocks, const OrientedBox& box) {
  std::vector<std::uint32_t> near;
  blocks.Near(box, &near);
  std::set<std::uint32_t> faces;
  for (const std::uint32_t block : near) {
    for (std::uint32_t lane = 0; lane < 8; ++lane) faces.insert(blocks.FaceOf(8 * block + lane));
  }
  faces.erase(FaceBlocks::kNoFace);
  return faces;
}

OrientedBox UprightBox(const Vector3d& center, const Vector3d& half) {
  return {Eigen::Matrix3d::Identity(), center, half};
}

TEST(FaceBlocks, HoldEveryFaceOnce) {
  for (const int rings : {2, 3, 40}) {
    const TriangleMesh mesh = RippledSolid(rings);
    const RayScene scene(mesh);
    const auto faces =
        FacesNear(scene.Blocks(), UprightBox(Vector3d::Zero(), Vector3d::Constant(1.0)));
    EXPECT_EQ(faces.size(), mesh.faces.size());
    EXPECT_EQ(*faces.rbegin(), mesh.faces.size() - 1);
  }
}

// 6,240 faces are five levels. A box around one corner of a face alone must lead to that face.
TEST(FaceBlocks, LeadToAFaceThatABoxMeetsAtOneCornerOnly) {
  const TriangleMesh mesh = Transformed(RippledSolid(40), 1.0, Vector3d(7.0, -3.0, 0.5));
  const RayScene scene(mesh);
  RngStream rng(1, "boxes");
  for (std::size_t face = 0; face < mesh.faces.size(); face += 13) {
    const Vector3d corner = mesh.vertices[static_cast<std::size_t>(mesh.faces[face][face % 3])];
    OrientedBox box = UprightBox(corner, Vector3d(0.05, 1e-6, 0.02));
    box.axes = DrawRotation(&rng);
    box.center += box.axes * Vector3d(0.05, -1e-6, 0.02);  // the corner is the box's own
    EXPECT_TRUE(FacesNear(scene.Blocks(), box).contains(static_cast<std::uint32_t>(face))) << face;
  }
}

TEST(FaceBlocks, LeaveOutWhatIsFarFromTheBox) {
  const TriangleMesh mesh = RippledSolid(40);  // about 0.1 across
  const RayScene scene(mesh);
  EXPECT_TRUE(
      FacesNear(scene.Blocks(), UprightBox(Vector3d(0.07, 0.0, 0.0), Vector3d::Constant(0.01)))
          .empty());
  const auto faces =
      FacesNear(scene.Blocks(), UprightBox(Vector3d(0.05, 0.0, 0.0), Vector3d::Constant(0.005)));
  EXPECT_GT(faces.size(), 10U);
  EXPECT_LT(faces.size(), mesh.faces.size() / 10);
}

TEST(FaceBlocks, OfferTheFacesWhoseBoundsReachIntoTheBoxUntilOneIsTaken) {
  const TriangleMesh mesh = shapes::Box({0.03, 0.04, 0.05});
  const RayScene scene(mesh);
  const OrientedBox box = UprightBox(Vector3d(0.015, 0.0, 0.0), Vector3d(0.001, 0.1, 0.1));
  std::vector<std::uint32_t> near;
  scene.Blocks().Near(box, &near);
  std::set<std::size_t> offered;
  EXPECT_EQ(scene.Blocks().FindIn(box, near,
                                  [&](std::size_t face) {
                                    offered.insert(face);
                                    return false;
                                  }),
            -1);
  for (std::size_t face = 0; face < mesh.faces.size(); ++face) {
    const bool reaches = std::any_of(mesh.faces[face].begin(), mesh.faces[face].end(), [&](int v) {
      return mesh.vertices[static_cast<std::size_t>(v)].x() > 0.0;
    });
    EXPECT_EQ(offered.contains(face), reaches) << face;
  }
  const std::size_t last = *offered.rbegin();
  EXPECT_EQ(scene.Blocks().FindIn(box, near, [&](std::size_t face) { return face == last; }),
            static_cast<std::int64_t>(last));
}

// Every pair once, by the boxes of the vertices as they are rounded.
TEST(FaceBlocks, FindEveryTwoFacesWhoseBoxesTouch) {
  for (const int rings : {2, 3, 12}) {
    const TriangleMesh mesh = RippledSolid(rings);
    std::vector<Eigen::Vector3f> vertices;
    for (const Vector3d& v : mesh.vertices) vertices.push_back(v.cast<float>());
    const FaceBlocks blocks(vertices, mesh.faces, Vector3d::Zero());
    const auto box = [&](std::size_t face) {
      Eigen::AlignedBox3f out;
      for (const std::int32_t v : mesh.faces[face])
        out.extend(vertices[static_cast<std::size_t>(v)]);
      return out;
    };
    std::multiset<std::pair<std::uint32_t, std::uint32_t>> found, expected;
    EXPECT_FALSE(blocks.AnyTouching([&](std::uint32_t f, std::uint32_t g) {
      found.insert(std::minmax(f, g));
      return false;
    }));
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
      for (std::uint32_t g = f + 1; g < mesh.faces.size(); ++g) {
        if (box(f).intersects(box(g))) expected.insert({f, g});
      }
    }
    EXPECT_EQ(found, expected);
    std::size_t visited = 0;
    EXPECT_TRUE(blocks.AnyTouching([&](std::uint32_t, std::uint32_t) { return ++visited == 7; }));
    EXPECT_EQ(visited, 7U);
  }
}

}  // namespace
}  // namespace antigrasp
