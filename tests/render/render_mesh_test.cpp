#include "antigrasp/render/render_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

constexpr Rgb kWhite = {255, 255, 255};

int Covered(const Image& image) {
  int covered = 0;
  for (const Rgb& pixel : image.pixels) covered += pixel == kWhite ? 0 : 1;
  return covered;
}

View Sharp() {
  View view;
  view.samples = 1;
  return view;
}

TEST(RenderMesh, ASphereIsADiscOfTheRightSizeInTheMiddle) {
  const Image image = RenderMesh(shapes::Sphere(1.0, 4), Sharp());
  const double radius = 256.0 / (2.0 * 1.04);  // the picture's side is 1.04 diameters
  EXPECT_NEAR(Covered(image), std::numbers::pi * radius * radius, 0.01 * Covered(image));
  EXPECT_NE(image.At(128, 128), kWhite);
  EXPECT_NE(image.At(128 + static_cast<int>(radius) - 2, 128), kWhite);
  EXPECT_EQ(image.At(128 + static_cast<int>(radius) + 2, 128), kWhite);
}

// How many pixels differ by more than rounding.
int Different(const Image& a, const Image& b) {
  int different = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (std::abs(a.pixels[i][k] - b.pixels[i][k]) > 1) {
        ++different;
        break;
      }
    }
  }
  return different;
}

TEST(RenderMesh, DoesNotDependOnPlaceAndSize) {
  const TriangleMesh mesh = shapes::Torus(1.0, 0.3, 40, 20);
  const Image here = RenderMesh(mesh, Sharp());
  EXPECT_EQ(here.pixels, RenderMesh(Transformed(mesh, 1024.0, {0.0, 0.0, 0.0}), Sharp()).pixels);
  // Moved, coordinates are rounded otherwise: a few pixels of the border may fall to its other
  // side.
  const Image there = RenderMesh(Transformed(mesh, 0.5, {3.0, -40.0, 7.0}), Sharp());
  EXPECT_LT(Different(here, there), Covered(here) / 1000);
}

TEST(RenderMesh, FromAboveATorusHasAHole) {
  View view = Sharp();
  view.elevation = 90.0;
  EXPECT_EQ(RenderMesh(shapes::Torus(1.0, 0.3, 40, 20), view).At(128, 128), kWhite);
  EXPECT_NE(RenderMesh(shapes::Sphere(1.0, 2), view).At(128, 128), kWhite);
}

TEST(RenderMesh, ACubeShowsThreeFlatShadesAndASphereManySmoothOnes) {
  const auto shades = [](const TriangleMesh& mesh) {
    const Image image = RenderMesh(mesh, Sharp());
    std::set<Rgb> colors(image.pixels.begin(), image.pixels.end());
    colors.erase(kWhite);
    return colors.size();
  };
  EXPECT_EQ(shades(shapes::Cube()), 3u);
  EXPECT_GT(shades(shapes::Sphere(1.0, 3)), 50u);
}

TEST(RenderOnNothing, OverWhiteIsWhatRenderMeshDrawsInsideAndClearOutside) {
  const View view = Sharp();
  const TriangleMesh ball = shapes::Sphere(1.0, 4);
  const Image white = RenderMesh(ball, view);
  const RgbaImage clear =
      RenderOnNothing(ball, CameraFor(ball, view.azimuth, view.elevation), view);
  for (std::size_t i = 0; i < white.pixels.size(); ++i) {
    const Rgba& pixel = clear.pixels[i];
    if (pixel[3] == 0) {
      ASSERT_EQ(white.pixels[i], kWhite);
    } else {
      ASSERT_EQ(pixel[3], 255);
      ASSERT_EQ(white.pixels[i], (Rgb{pixel[0], pixel[1], pixel[2]}));
    }
  }
}

TEST(RenderOnNothing, ACameraWithAWiderPictureShowsASmallerObjectWithSmoothBorders) {
  View view;
  const TriangleMesh ball = shapes::Sphere(1.0, 4);
  Camera camera = CameraFor(ball, view.azimuth, view.elevation);
  camera.half_side *= 2.0;
  const RgbaImage image = RenderOnNothing(ball, camera, view);
  double covered = 0.0;
  int between = 0;
  for (const Rgba& pixel : image.pixels) {
    covered += pixel[3] / 255.0;
    between += pixel[3] > 0 && pixel[3] < 255 ? 1 : 0;
  }
  const double radius = 256.0 / (4.0 * 1.04);
  EXPECT_NEAR(covered, std::numbers::pi * radius * radius, 0.01 * covered);
  EXPECT_GT(between, 100);
  EXPECT_EQ(RenderOnNothing(TriangleMesh{}, camera, view).At(128, 128)[3], 0);
}

TEST(Camera, ProjectsItsMiddleToTheMiddleAndUpToTheTop) {
  const TriangleMesh cube = Transformed(shapes::Cube(), 1.0, {3.0, 4.0, 5.0});
  const Camera camera = CameraFor(cube, 90.0, 0.0);  // from +y: x runs to the left
  EXPECT_NEAR((camera.Project({3.0, 4.0, 5.0}) - Eigen::Vector2d(0.5, 0.5)).norm(), 0.0, 1e-12);
  EXPECT_LT(camera.Project({3.0, 4.0, 5.4}).y(), 0.4);
  EXPECT_LT(camera.Project({3.4, 4.0, 5.0}).x(), 0.4);
  EXPECT_NEAR(camera.half_side, 1.04 * 0.5 * std::sqrt(3.0), 1e-12);
}

TEST(RenderMesh, AnEmptyMeshIsWhite) { EXPECT_EQ(Covered(RenderMesh(TriangleMesh{})), 0); }

}  // namespace
}  // namespace antigrasp
