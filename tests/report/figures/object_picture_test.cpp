#include "antigrasp/report/figures/object_picture.h"

#include <gtest/gtest.h>

#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

// From +x: y runs to the right, z up.
View FromX() {
  View view;
  view.azimuth = view.elevation = 0.0;
  return view;
}

TEST(SeenLine, IsHiddenBehindTheMeshAndSeenBesideIt) {
  const TriangleMesh cube = shapes::Cube();
  const RayScene scene(cube);
  const Camera camera = FigureCamera(cube, FromX(), 4.0);  // the picture is four cubes wide
  const auto pieces = SeenLine(scene, camera, 2.0, {-1.0, -1.0, 0.0}, {-1.0, 1.0, 0.0});
  ASSERT_EQ(pieces.size(), 3u);
  EXPECT_TRUE(pieces[0].visible);
  EXPECT_FALSE(pieces[1].visible);
  EXPECT_TRUE(pieces[2].visible);
  EXPECT_NEAR(pieces[0].from.x, 0.25, 1e-9);
  EXPECT_NEAR(pieces[1].from.x, 0.375, 0.005);  // the cube's sides
  EXPECT_NEAR(pieces[1].to.x, 0.625, 0.005);
  EXPECT_NEAR(pieces[2].to.x, 0.75, 1e-9);
  EXPECT_NEAR(pieces[2].to.y, 0.5, 1e-9);
}

TEST(SeenLine, InFrontOfTheMeshIsSeenAsAWholeAndSoIsAPointOnIt) {
  const TriangleMesh cube = shapes::Cube();
  const RayScene scene(cube);
  const Camera camera = FigureCamera(cube, FromX(), 4.0);
  const auto front = SeenLine(scene, camera, 2.0, {1.0, -1.0, 0.0}, {1.0, 1.0, 0.0});
  ASSERT_EQ(front.size(), 1u);
  EXPECT_TRUE(front[0].visible);
  const Vector3d on(0.5, 0.1, 0.2), behind(-0.5, 0.1, 0.2);
  EXPECT_TRUE(SeenLine(scene, camera, 2.0, on, on).front().visible);
  EXPECT_FALSE(SeenLine(scene, camera, 2.0, behind, behind).front().visible);
}

TEST(FigureCamera, PutsWhatIsSeenInTheMiddleAndFillsThePicture) {
  TriangleMesh mesh = Transformed(shapes::Box({1.0, 2.0, 4.0}), 1.0, {10.0, 20.0, 30.0});
  mesh.vertices.push_back({30.0, 20.0, 30.0});  // far in front: the ball about it is large
  const Camera camera = FigureCamera(mesh, FromX(), 1.0);
  EXPECT_NEAR(camera.half_side, 2.0, 1e-9);
  EXPECT_NEAR(camera.Project({10.0, 20.0, 32.0}).y(), 0.0, 1e-9);
  EXPECT_NEAR(camera.Project({10.0, 21.0, 30.0}).x(), 0.75, 1e-9);
  EXPECT_EQ(FigureCamera(TriangleMesh(), FromX()).half_side, 1.0);
}

}  // namespace
}  // namespace antigrasp
