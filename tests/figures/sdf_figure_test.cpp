#include "antigrasp/figures/sdf_figure.h"

#include <gtest/gtest.h>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/sdf/mesh_to_sdf.h"
#include "antigrasp/sdf/remesh.h"
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

}  // namespace
}  // namespace antigrasp
