#include "antigrasp/figures/row_figure.h"

#include <gtest/gtest.h>

#include <cmath>

#include "antigrasp/core/atomic_file.h"
#include "tests/support/shapes.h"
#include "tests/support/well_formed.h"

namespace antigrasp {
namespace {

using shapes::TempFolder;

RowFigure Example() {
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

FigureOptions Small(int threads) {
  FigureOptions options;
  options.width_mm = 90.0;
  options.dpi = 100.0;
  options.threads = threads;
  return options;
}

TEST(RowFigure, HasTheSameBytesForAnyNumberOfThreads) {
  const TempFolder folder;
  for (const char* name : {"f.svg", "f.png"}) {
    WriteRowFigure(folder / name, Example(), Small(1));
    const std::string one = ReadFile(folder / name);
    WriteRowFigure(folder / name, Example(), Small(3));
    EXPECT_EQ(ReadFile(folder / name), one) << name;
  }
  EXPECT_EQ(shapes::WhyNotWellFormed(ReadFile(folder / "f.svg")), "");
}

TEST(RowFigure, ObjectsStandOnTheLeftAndBarsOnTheRight) {
  const TempFolder folder;
  WriteRowFigure(folder / "f.png", Example(), Small(1));
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

TEST(RowFigure, DrawsRowsOfWhichNothingIsThere) {
  const TempFolder folder;
  RowFigure figure;
  figure.rows.resize(2);
  WriteRowFigure(folder / "f.svg", figure, Small(1));
  EXPECT_EQ(shapes::WhyNotWellFormed(ReadFile(folder / "f.svg")), "");
}

}  // namespace
}  // namespace antigrasp
