#include "antigrasp/report/figures/row_figure.h"

#include <gtest/gtest.h>

#include <cmath>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/report/figures/plot.h"
#include "tests/report/figures/pixels.h"
#include "tests/support/read_png.h"
#include "tests/support/shapes.h"
#include "tests/support/well_formed.h"

namespace antigrasp {
namespace {

using shapes::TempFolder;

RowFigure TwoRows() {
  RowFigure figure;
  figure.titles = {"before", "after", "one too many"};
  figure.values_name = "after";
  figure.reference_name = "before";
  FigureRow row;
  row.label = "<first> & last";
  row.examples = {{shapes::Cube(), "1"}, {shapes::Sphere(1.0, 2), "\xff"}};
  row.values = {0.5, 0.6, std::nan(""), 0.7, 40.0};
  row.reference = {0.9, 1.0, 1.1};
  figure.rows.push_back(row);
  FigureRow gap;
  gap.label = "missing";
  gap.examples = {{TriangleMesh(), ""}};
  gap.gap = "no scores";
  figure.rows.push_back(gap);
  return figure;
}

FigureOptions SmallPage(int threads) {
  FigureOptions options;
  options.width_mm = 90.0;
  options.dpi = 100.0;
  options.threads = threads;
  return options;
}

TEST(RowFigure, HasTheSameBytesForAnyNumberOfThreads) {
  const TempFolder folder;
  for (const char* name : {"f.svg", "f.png"}) {
    WriteRowFigure(folder / name, TwoRows(), SmallPage(1));
    const std::string one = ReadFile(folder / name);
    WriteRowFigure(folder / name, TwoRows(), SmallPage(3));
    EXPECT_EQ(ReadFile(folder / name), one) << name;
  }
  EXPECT_EQ(shapes::WhyNotWellFormed(ReadFile(folder / "f.svg")), "");
}

TEST(RowFigure, ObjectsStandOnTheLeftAndBarsOnTheRight) {
  const TempFolder folder;
  WriteRowFigure(folder / "f.png", TwoRows(), SmallPage(1));
  const Image image = ReadPng(folder / "f.png");
  int left = 0, right = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const Rgb& p = image.At(x, y);
      if (p[2] > p[0] + 30) ++(x < image.width / 2 ? left : right);
    }
  }
  EXPECT_GT(left, 200);
  EXPECT_GT(right, 50);
}

// One row at two pixels a point.
Image Row(const TempFolder& folder, const RowFigure& figure) {
  FigureOptions options;
  options.width_mm = 120.0;
  options.dpi = 144.0;
  options.view.samples = 1;
  options.threads = 1;
  WriteRowFigure(folder / "f.png", figure, options);
  return ReadPng(folder / "f.png");
}

TEST(RowFigure, BarsAndTheMarkOfTheMeanAreOfTheValuesAndNotOfTheReference) {
  // 10 bins over [0, 0.8]: values in the third, [0.16, 0.24), the reference in the last.
  const TempFolder folder;
  RowFigure figure;
  figure.rows.resize(1);
  figure.rows[0].values.assign(10, 0.2);
  figure.rows[0].reference.assign(10, 0.8);
  const Image image = Row(folder, figure);
  // The plot begins behind border, label and one example of 120 points with its gap.
  const double zero = 2.0 * (4.0 + 12.0 + 124.0 + kLeftOfPlot + 2.0);
  const double bin = (2.0 * 120.0 / 25.4 * 72.0 - 16.0 - zero) / 10.0;
  const Area below{zero, 150.0, 10.0 * bin, 110.0};  // the words of a plot stand above
  const auto bars = pixels::FindColor(image, below, kBars);
  EXPECT_NEAR(bars.left, zero + 2.08 * bin, 2.0);
  EXPECT_NEAR(bars.right + 1, zero + 2.92 * bin, 2.0);
  const auto mark =
      pixels::Find(image, below, [](const Rgb& p) { return pixels::Near(p, kMark, 45); });
  EXPECT_NEAR(mark.left, zero + 2.5 * bin, 2.0);  // the mean
  EXPECT_NEAR(mark.right, zero + 2.5 * bin, 2.0);
  const auto dark = [&](double from, double to) {
    const Area part{zero + from * bin, below.y, (to - from) * bin, below.height};
    return pixels::Find(image, part, [](const Rgb& p) { return p[0] < 180 && p[2] < 190; }).count;
  };
  EXPECT_GT(dark(8.7, 9.3), 50);  // up the last bin's left side
  EXPECT_EQ(dark(3.3, 8.7), 0);
  std::swap(figure.rows[0].values, figure.rows[0].reference);
  const Image swapped = Row(folder, figure);
  EXPECT_NEAR(pixels::FindColor(swapped, below, kBars).left, zero + 9.08 * bin, 2.0);
}

TEST(RowFigure, ExamplesStandInTheirRowAndColumn) {
  const TempFolder folder;
  const auto is_blue = [](const Rgb& p) { return p[2] > p[0] + 20; };
  for (int row = 0; row < 2; ++row) {
    for (int column = 0; column < 3; ++column) {
      RowFigure figure;
      figure.rows.resize(2);
      for (FigureRow& r : figure.rows) r.examples.resize(3);
      figure.rows[static_cast<std::size_t>(row)].examples[static_cast<std::size_t>(column)].mesh =
          shapes::Sphere(1.0, 2);
      const Image image = Row(folder, figure);
      const Area pictures{0.0, 0.0, 0.6 * image.width, static_cast<double>(image.height)};
      const auto ball = pixels::Find(image, pictures, is_blue);
      // Columns begin after border and label, 16 points; rows are a side, 10 and 6 points apart.
      const double width = image.width / 2.0;
      const double side = (width * 0.64 - 4.0 - 12.0 - kLeftOfPlot - 6.0 - 8.0) / 3.0;
      EXPECT_NEAR(0.25 * (ball.left + ball.right + 1), 16.0 + column * (side + 4.0) + 0.5 * side,
                  1.0);
      EXPECT_NEAR(0.25 * (ball.top + ball.bottom + 1), 16.0 + row * (side + 16.0) + 0.5 * side,
                  1.0);
    }
  }
}

TEST(RowFigure, ObjectsOfARowShareAScale) {
  const TempFolder folder;
  const auto is_blue = [](const Rgb& p) { return p[2] > p[0] + 20; };
  RowFigure figure;
  figure.rows.resize(2);
  figure.rows[0].examples = {{shapes::Sphere(1.0, 3), ""}, {shapes::Sphere(0.5, 3), ""}};
  figure.rows[1].examples = {{shapes::Sphere(0.5, 3), ""}};
  const Image image = Row(folder, figure);
  // Two examples side by side: the header is 32 pixels high, a row a side and 16 points.
  const double side = std::floor((0.64 * 120.0 / 25.4 * 72.0 - 54.0 - 4.0) / 2.0);
  const double left = 32.0, top = 32.0, pitch = 2.0 * (side + 16.0);
  const auto first = pixels::Find(image, {left, top, 2.0 * side, 2.0 * side}, is_blue);
  const auto second =
      pixels::Find(image, {left + 2.0 * side + 8.0, top, 2.0 * side, 2.0 * side}, is_blue);
  const auto other = pixels::Find(image, {left, top + pitch, 2.0 * side, 2.0 * side}, is_blue);
  ASSERT_GT(first.count, 1000);
  EXPECT_NEAR(second.right - second.left, 0.5 * (first.right - first.left), 3.0);
  EXPECT_NEAR(other.right - other.left, first.right - first.left, 3.0);
}

TEST(RowFigure, TheNamesOfTheLegendStandBesideTheirOwnSwatches) {
  const TempFolder folder;
  RowFigure figure;
  figure.rows.resize(1);
  figure.values_name = "HHHHHHHH";
  figure.reference_name = "i";
  double wide = 0.0;
  pixels::Drawn(10, 10, 1, [&](Canvas* canvas) { wide = canvas->TextWidth("HHHHHHHH", {6.5}); });
  const Image image = Row(folder, figure);
  const Area header{0.0, 0.0, static_cast<double>(image.width), 30.0};
  const auto swatch = pixels::FindColor(image, header, kBars);
  ASSERT_GT(swatch.count, 20);
  // From 3 points after the swatch the letters of the long name, one every eighth of its width.
  const double x = swatch.right + 1 + 6.0;
  for (int k = 0; k < 8; ++k) {
    EXPECT_GT(pixels::FindInk(image, {x + k * wide / 4.0, 8.0, wide / 4.0, 20.0}).count, 5) << k;
  }
  EXPECT_EQ(pixels::FindInk(image, {x + 2.0 * wide + 2.0, 0.0, 20.0, 30.0}).count, 0);
}

TEST(RowFigure, DrawsRowsOfWhichNothingIsThere) {
  const TempFolder folder;
  RowFigure figure;
  figure.rows.resize(2);
  WriteRowFigure(folder / "f.svg", figure, SmallPage(1));
  EXPECT_EQ(shapes::WhyNotWellFormed(ReadFile(folder / "f.svg")), "");
}

}  // namespace
}  // namespace antigrasp
