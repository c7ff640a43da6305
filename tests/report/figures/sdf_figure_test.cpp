#include "antigrasp/report/figures/sdf_figure.h"

#include <gtest/gtest.h>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/sdf/mesh_to_sdf.h"
#include "antigrasp/sdf/remesh.h"
#include "tests/report/figures/pixels.h"
#include "tests/support/read_png.h"
#include "tests/support/shapes.h"
#include "tests/support/well_formed.h"

namespace antigrasp {
namespace {

TEST(SdfFigure, ShowsTheMeshTheGridAndItsSection) {
  const shapes::TempFolder folder;
  SdfFigure figure;
  figure.name = "ball <&>";
  figure.original = shapes::Sphere(0.4, 3);
  figure.grid = UnitCubeGrid(16);
  MeshToSdf(figure.original, &figure.grid);
  figure.remeshed = Remesh(figure.grid).mesh;
  FigureOptions options;
  options.width_mm = 90.0;
  options.dpi = 72.0;
  WriteSdfFigure(folder / "f.png", figure, options);
  const Image image = ReadPng(folder / "f.png");
  const int row = image.width / 6;  // through the middles of the three panels
  const Rgb inside = image.At(5 * image.width / 6, row), outside = image.At(image.width - 8, 8);
  EXPECT_GT(inside[0], inside[2] + 80);  // orange in the middle, blue in the corner
  EXPECT_GT(outside[2], outside[0] + 80);
  EXPECT_NE(image.At(image.width / 6, row), (Rgb{255, 255, 255}));
  EXPECT_NE(image.At(image.width / 2, row), (Rgb{255, 255, 255}));
  WriteSdfFigure(folder / "f.svg", figure, options);
  const std::string svg = ReadFile(folder / "f.svg");
  EXPECT_EQ(shapes::WhyNotWellFormed(svg), "");
  options.threads = 2;
  WriteSdfFigure(folder / "f.svg", figure, options);
  EXPECT_EQ(ReadFile(folder / "f.svg"), svg);
}

TEST(SdfFigure, TheSectionIsAcrossItsAxisAtItsPlaceWithUpUp) {
  // Inside where u > 0.2 and v > 0.3 of the section, in the half of the layers with w > 0.
  const shapes::TempFolder folder;
  for (int axis = 0; axis < 3; ++axis) {
    const int u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2;
    SdfFigure figure;
    figure.axis = axis;
    figure.grid = UnitCubeGrid(20);
    for (int z = 0; z < 20; ++z) {
      for (int y = 0; y < 20; ++y) {
        for (int x = 0; x < 20; ++x) {
          const Eigen::Vector3d p = figure.grid.Node(x, y, z);
          const bool inside = p[axis] > 0.0 && p[u] > 0.1 && p[v] > 0.3;
          figure.grid.values[figure.grid.Index(x, y, z)] = inside ? 0.01f : -0.5f;
        }
      }
    }
    for (const double position : {0.25, -0.25}) {
      figure.position = position;
      FigureOptions options;
      options.width_mm = 100.0;
      options.dpi = 72.0;
      WriteSdfFigure(folder / "f.png", figure, options);
      const Image image = ReadPng(folder / "f.png");
      const double side = (options.Width() - 8.0 - 24.0) / 3.0;
      const auto at = [&](double across, double up) {
        return image.At(static_cast<int>(4.0 + 2.0 * (side + 12.0) + across * side),
                        static_cast<int>(4.0 + (1.0 - up) * side));
      };
      const auto is_inside = [](const Rgb& p) { return p[0] > p[2] + 80; };
      EXPECT_EQ(is_inside(at(0.8, 0.9)), position > 0.0) << axis;
      EXPECT_FALSE(is_inside(at(0.8, 0.2)));
      EXPECT_FALSE(is_inside(at(0.3, 0.9)));
      EXPECT_FALSE(is_inside(at(0.8, 0.7)));                // v = 0.2
      EXPECT_EQ(is_inside(at(0.65, 0.9)), position > 0.0);  // u = 0.15
    }
  }
}

TEST(SdfFigure, TheOriginalStandsBeforeTheRemeshedOne) {
  const shapes::TempFolder folder;
  SdfFigure figure;
  figure.original = shapes::Sphere(0.4, 3);
  figure.remeshed = Transformed(shapes::Sphere(0.2, 3), 1.0, {0.0, 0.0, 0.1});
  figure.grid = UnitCubeGrid(8);
  FigureOptions options;
  options.dpi = 72.0;
  options.view.azimuth = options.view.elevation = 0.0;
  WriteSdfFigure(folder / "f.png", figure, options);
  const Image image = ReadPng(folder / "f.png");
  const double side = (options.Width() - 8.0 - 24.0) / 3.0;
  const auto is_blue = [](const Rgb& p) { return p[2] > p[0] + 20; };
  const auto panel = [&](int k) {
    return pixels::Find(image, {4.0 + k * (side + 12.0), 4.0, side, side}, is_blue);
  };
  // One camera for both: half as wide, and 0.1 of 0.8 / 1.04 of the side above the middle.
  EXPECT_NEAR(panel(0).right - panel(0).left, side / 1.04, 3.0);
  EXPECT_NEAR(panel(1).right - panel(1).left, 0.5 * side / 1.04, 3.0);
  EXPECT_NEAR(0.5 * (panel(1).top + panel(1).bottom), 4.0 + side * (0.5 - 0.125 / 1.04), 2.0);
}

}  // namespace
}  // namespace antigrasp
