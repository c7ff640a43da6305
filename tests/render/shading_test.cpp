#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>

#include "antigrasp/core/angles.h"
#include "antigrasp/render/render_mesh.h"
#include "tests/support/shapes.h"

// What colour a pixel has and from where it is seen, by numbers from paper.
namespace antigrasp {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr Rgb kBlank = {255, 255, 255};

// From +x: y runs to the right, z up.
View FromX() {
  View view;
  view.azimuth = view.elevation = 0.0;
  view.samples = 1;
  view.pixels = 16;
  view.color = {200, 100, 50};  // three values that nothing else has
  return view;
}

// A square of this edge about `center` whose outward normal is `normal`.
TriangleMesh Square(const Vector3d& normal, double edge, const Vector3d& center) {
  const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), normal);
  return Transformed(shapes::Rotated(shapes::FlatSquare(), turn.toRotationMatrix()), edge, center);
}

// 0.42 of the colour everywhere and 0.58 of it by the cosine to the light, times 1.12.
Rgb Shade(double cosine) {
  const double light = 1.12 * (0.42 + 0.58 * std::max(0.0, cosine));
  const auto byte = [&](double value) {
    return static_cast<std::uint8_t>(std::lround(std::min(255.0, light * value)));
  };
  return {byte(200.0), byte(100.0), byte(50.0)};
}

TEST(Shading, TheLightComesFromTheUpperLeftOfTheCamera) {
  // Seen from +x the light comes along (1, -0.5, 0.7): 1 towards the camera, 0.5 to the left, 0.7
  // up. Every normal below has another cosine to it.
  const double length = std::sqrt(1.0 + 0.25 + 0.49);
  const std::pair<Vector3d, double> normals[] = {
      {{1, 0, 0}, 1.0},  {{1, 1, 0}, 0.5},     // looks to the right
      {{1, -1, 0}, 1.5},                       // to the left
      {{1, 0, 1}, 1.7},                        // up
      {{1, 0, -1}, 0.3},                       // down
      {{1, 2, 0}, 0.0},  {{1, 2, -2}, -1.4}};  // away from the light
  for (const auto& [normal, product] : normals) {
    const Image image = RenderMesh(Square(normal.normalized(), 1.0, {7, 8, 9}), FromX());
    EXPECT_EQ(image.At(8, 8), Shade(product / length / normal.norm())) << normal.transpose();
  }
}

TEST(Shading, TheNearestFaceIsSeen) {
  // Both are in the middle of the picture; the tilted one is in front for a camera at +x alone.
  const Vector3d tilted = Vector3d(1, 0, 1).normalized();
  const TriangleMesh near =
      shapes::Joined(Square(Vector3d::UnitX(), 4.0, {-1, 0, 0}), Square(tilted, 1.0, {1, 0, 0}));
  const TriangleMesh far =
      shapes::Joined(Square(Vector3d::UnitX(), 4.0, {1, 0, 0}), Square(tilted, 1.0, {-1, 0, 0}));
  const double length = std::sqrt(1.74);
  EXPECT_EQ(RenderMesh(near, FromX()).At(8, 8), Shade(1.7 / length / std::sqrt(2.0)));
  EXPECT_EQ(RenderMesh(far, FromX()).At(8, 8), Shade(1.0 / length));
}

TEST(Shading, FacesThatTurnByLessThanTheCreaseAreShadedAsOne) {
  // A roof over the ridge y = z = 0 whose sides turn by `turn` from one to the other.
  const auto shades = [](double turn, double crease) {
    const double x = -std::tan(0.5 * turn * kDegree);
    const TriangleMesh roof{{{0, 0, -1}, {0, 0, 1}, {x, -1, -1}, {x, -1, 1}, {x, 1, -1}, {x, 1, 1}},
                            {{0, 1, 2}, {1, 3, 2}, {0, 4, 1}, {1, 4, 5}}};
    View view = FromX();
    view.crease = crease;
    const Image image = RenderMesh(roof, view);
    std::set<Rgb> colors(image.pixels.begin(), image.pixels.end());
    colors.erase(kBlank);
    return colors.size();
  };
  EXPECT_EQ(shades(31.0, View().crease), 2u);  // the default is 30 degrees
  EXPECT_GT(shades(29.0, View().crease), 2u);
  EXPECT_EQ(shades(29.0, 28.0), 2u);
  EXPECT_GT(shades(50.0, 51.0), 2u);
}

TEST(Shading, WhereFacesAreShadedAsOneTheLargerTurnsTheNormalMore) {
  // A roof whose right side is three times as large as its left: cross products (2, -0.5, 0) and
  // (6, 1.5, 0), which sum to (8, 1, 0) along the ridge.
  const TriangleMesh roof{{{0, 0, -1}, {0, 0, 1}, {-0.25, -1, 0}, {-0.75, 3, 0}},
                          {{0, 1, 2}, {0, 3, 1}}};
  Camera camera = CameraFor(roof, 0.0, 0.0);
  camera.half_side = 8.0;            // pixels of 1
  camera.center = {0.0, -0.5, 0.5};  // the middle of pixel (8, 8) is on the ridge
  const Rgba ridge = RenderOnNothing(roof, camera, FromX()).At(8, 8);
  const double cosine = (8.0 - 0.5) / std::sqrt(65.0) / std::sqrt(1.74);
  EXPECT_EQ((Rgb{ridge[0], ridge[1], ridge[2]}), Shade(cosine));
}

TEST(Shading, APixelIsTheMeanOfItsSamplesOverWhite) {
  const TriangleMesh ball = shapes::Sphere(1.0, 3);
  View coarse = FromX(), fine = FromX();
  coarse.samples = 2;
  fine.pixels = 32;
  const Image pixels = RenderMesh(ball, coarse), samples = RenderMesh(ball, fine);
  int mixed = 0;
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      double sum = 0.0;
      int white = 0;
      for (const int i : {0, 1, 2, 3}) {
        const Rgb& sample = samples.At(2 * x + i % 2, 2 * y + i / 2);
        white += sample == kBlank ? 1 : 0;
        sum += sample == kBlank ? 1.12 * 255.0 : sample[1];  // white is cut after the mean
      }
      ASSERT_NEAR(pixels.At(x, y)[1], std::min(255.0, sum / 4.0), 1.0) << x << " " << y;
      mixed += white > 0 && white < 4 ? 1 : 0;
    }
  }
  EXPECT_GT(mixed, 20);
}

TEST(RenderOnNothing, ABorderIsThinnerAndKeepsItsColour) {
  View view = FromX();
  view.samples = 4;
  const TriangleMesh plate = Square(Vector3d::UnitX(), 1.0, {0, 0, 0});
  Camera camera = CameraFor(plate, 0.0, 0.0);
  camera.half_side = 1.0;
  camera.center += Vector3d(0.0, 0.03125, 0.0);  // a quarter of a pixel to the right
  const RgbaImage image = RenderOnNothing(plate, camera, view);
  // 8 pixels of 1 / 8 from column 4 to 11, less a quarter on the left and a quarter more on the
  // other side: moving the camera to the right moves the plate to the left.
  const auto alpha = [](int quarters) { return std::lround(255.0 * quarters / 4.0); };
  EXPECT_EQ(image.At(2, 8)[3], 0);
  EXPECT_EQ(image.At(3, 8)[3], alpha(1));
  EXPECT_EQ(image.At(4, 8)[3], 255);
  EXPECT_EQ(image.At(11, 8)[3], alpha(3));
  EXPECT_EQ(image.At(12, 8)[3], 0);
  for (const int x : {3, 4, 8, 11}) {
    const Rgb shade = Shade(1.0 / std::sqrt(1.74));
    EXPECT_EQ(image.At(x, 8), (Rgba{shade[0], shade[1], shade[2], image.At(x, 8)[3]})) << x;
  }
  EXPECT_EQ(image.At(8, 3)[3], 0);
  EXPECT_EQ(image.At(8, 4)[3], 255);
  EXPECT_EQ(image.At(8, 11)[3], 255);
  EXPECT_EQ(image.At(8, 12)[3], 0);
}

TEST(Camera, IsARightHandedFrameAtItsAzimuthAndElevation) {
  const TriangleMesh box = Transformed(shapes::Box({1.0, 2.0, 4.0}), 1.0, {10.0, 20.0, 30.0});
  const Camera camera = CameraFor(box, 30.0, 60.0);
  // sin 30 = cos 60 = 1 / 2, the others are h.
  const double h = 0.5 * std::sqrt(3.0);
  EXPECT_NEAR((camera.forward - Vector3d(-0.5 * h, -0.25, -h)).norm(), 0.0, 1e-15);
  EXPECT_NEAR((camera.right - Vector3d(-0.5, h, 0.0)).norm(), 0.0, 1e-15);
  EXPECT_NEAR((camera.up - Vector3d(-h * h, -0.5 * h, 0.5)).norm(), 0.0, 1e-15);
  EXPECT_NEAR((camera.center - Vector3d(10.0, 20.0, 30.0)).norm(), 0.0, 1e-15);
  EXPECT_NEAR(camera.half_side, 1.04 * 0.5 * std::sqrt(21.0), 1e-12);
  const double side = 2.0 * camera.half_side;
  const Vector2d at =
      camera.Project(camera.center + 3.0 * camera.right + 2.0 * camera.up + 5.0 * camera.forward);
  EXPECT_NEAR((at - Vector2d(0.5 + 3.0 / side, 0.5 - 2.0 / side)).norm(), 0.0, 1e-12);
  EXPECT_EQ(CameraFor(TriangleMesh{}, 0.0, 0.0).half_side, 1.0);
}

TEST(View, LooksFromTheFrontLeftAndALittleFromAbove) {
  const View view;
  EXPECT_EQ(view.azimuth, -60.0);
  EXPECT_EQ(view.elevation, 25.0);
  EXPECT_EQ(view.color, (Rgb{118, 148, 196}));
}

}  // namespace
}  // namespace antigrasp
