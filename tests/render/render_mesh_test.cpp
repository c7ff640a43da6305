#include "antigrasp/render/render_mesh.h"

#include <gtest/gtest.h>

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

TEST(RenderMesh, DoesNotDependOnPlaceAndSize) {
  const TriangleMesh mesh = shapes::Torus(1.0, 0.3, 40, 20);
  const Image here = RenderMesh(mesh, Sharp());
  const Image there = RenderMesh(Transformed(mesh, 1024.0, {0.0, 0.0, 0.0}), Sharp());
  EXPECT_EQ(here.pixels, there.pixels);
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

TEST(RenderMesh, AnEmptyMeshIsWhite) { EXPECT_EQ(Covered(RenderMesh(TriangleMesh{})), 0); }

}  // namespace
}  // namespace antigrasp
