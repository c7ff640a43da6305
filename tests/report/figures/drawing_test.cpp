#include <gtest/gtest.h>

#include <cmath>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/report/figures/object_picture.h"
#include "antigrasp/report/figures/plot.h"
#include "tests/report/figures/pixels.h"
#include "tests/support/read_png.h"
#include "tests/support/shapes.h"

// Where a page has what colour: canvas and plots by their pixels.
namespace antigrasp {
namespace {

using pixels::Drawn;
using pixels::FindColor;
using pixels::FindInk;
using pixels::Near;
using pixels::Spot;
using pixels::Whole;

constexpr Color kRed = {0.8, 0.0, 0.0}, kBlue = {0.0, 0.0, 0.8}, kGreen = {0.0, 0.6, 0.0};

TEST(FigureOptions, AreMillimetresAndDotsPerInch) {
  FigureOptions options;
  options.width_mm = 25.4;
  EXPECT_NEAR(options.Width(), 72.0, 1e-12);
  EXPECT_NEAR(FigureOptions().Width(), 510.2362, 1e-4);  // 180 mm
  EXPECT_EQ(options.Pixels(72.0), 300);
  options.dpi = 144.0;
  EXPECT_EQ(options.Pixels(10.0), 20);
  EXPECT_EQ(options.Pixels(1.0), 8);
  EXPECT_EQ(options.Pixels(1e6), 2000);
}

TEST(Page, AnSvgIsInPointsAndAPngInDots) {
  const shapes::TempFolder folder;
  const auto nothing = [](Canvas*) {};
  WritePage(folder / "a.svg", {100.0, 60.0, 300.0}, nothing);
  EXPECT_NE(ReadFile(folder / "a.svg").find("viewBox=\"0 0 100 60\""), std::string::npos);
  WritePage(folder / "a.png", {100.0, 72.0, 300.0}, nothing);
  const Image image = ReadPng(folder / "a.png");
  EXPECT_EQ(image.width, 417);  // 100 / 72 inches are 416.7 dots
  EXPECT_EQ(image.height, 300);
}

TEST(Canvas, DrawsFromTheTopLeftInItsColours) {
  const Image image = Drawn(40, 30, 1, [](Canvas* canvas) {
    canvas->Fill(Area{2.0, 3.0, 10.0, 5.0}, kRed);
    canvas->Fill({{20.0, 20.0}, {30.0, 20.0}, {30.0, 28.0}, {20.0, 28.0}}, kBlue);
    canvas->Line({{20.5, 5.0}, {20.5, 15.0}}, kGreen, 3.0);
    canvas->Fill(Area{30.0, 2.0, 4.0, 6.0}, kInk);
  });
  const Spot red = FindColor(image, Whole(image), kRed);
  EXPECT_EQ(red.count, 50);
  EXPECT_EQ(red.left, 2);
  EXPECT_EQ(red.top, 3);
  const Spot blue = FindColor(image, Whole(image), kBlue);
  EXPECT_EQ(blue.count, 80);
  EXPECT_EQ(blue.left, 20);
  EXPECT_EQ(blue.top, 20);
  const Spot green = FindColor(image, Whole(image), kGreen);
  EXPECT_EQ(green.left, 19);
  EXPECT_EQ(green.right, 21);
  const Spot ink = FindColor(image, Whole(image), kInk);
  EXPECT_EQ(ink.count, 24);
  EXPECT_EQ(ink.left, 30);
  EXPECT_EQ(ink.top, 2);
}

TEST(Canvas, APictureStandsUprightInItsOwnColoursAndLetsTheRestShine) {
  RgbaImage picture(2, 3);
  picture.At(0, 0) = {200, 0, 0, 255};
  picture.At(1, 0) = {0, 200, 0, 255};
  picture.At(0, 1) = {0, 0, 200, 255};
  picture.At(0, 2) = {0, 0, 100, 51};  // a fifth of it over white
  const Image image = Drawn(40, 50, 1, [&](Canvas* canvas) {
    canvas->Picture(picture, {10.0, 10.0, 20.0, 30.0});  // 10 points a pixel
  });
  // In the middles: between them colours run into each other.
  EXPECT_TRUE(Near(image.At(15, 15), {200 / 255.0, 0, 0}, 25));
  EXPECT_TRUE(Near(image.At(25, 15), {0, 200 / 255.0, 0}, 25));
  EXPECT_TRUE(Near(image.At(15, 25), {0, 0, 200 / 255.0}, 25));
  EXPECT_TRUE(Near(image.At(15, 35), {0.8, 0.8, 0.8 + 20 / 255.0}, 25));
  EXPECT_TRUE(Near(image.At(27, 37), {1, 1, 1}));
  EXPECT_TRUE(Near(image.At(3, 15), {1, 1, 1}));
}

TEST(Canvas, TextIsAlignedToItsPlaceOnTheBaseLine) {
  double width = 0.0;
  const auto ink = [&](Align align, bool upward) {
    const Image image = Drawn(100, 100, 2, [&](Canvas* canvas) {
      width = canvas->TextWidth("HHHHH", {10.0});
      canvas->Text("HHHHH", {50.0, 50.0}, {10.0, kInk, align, false, upward});
    });
    return FindInk(image, Whole(image));
  };
  // Capitals stand on the line, 0.7 of the size high; a letter's bearing is a point at most.
  const double pixels = 2.0, slack = 4.0;
  const auto expect = [&](const Spot& spot, double left, double top, double right, double bottom) {
    EXPECT_NEAR(spot.left, pixels * left, slack);
    EXPECT_NEAR(spot.top, pixels * top, slack);
    EXPECT_NEAR(spot.right, pixels * right, slack);
    EXPECT_NEAR(spot.bottom, pixels * bottom, slack);
  };
  const Spot left = ink(Align::kLeft, false);
  ASSERT_GT(width, 20.0);
  expect(left, 50.0, 42.7, 50.0 + width, 50.0);
  expect(ink(Align::kMiddle, false), 50.0 - 0.5 * width, 42.7, 50.0 + 0.5 * width, 50.0);
  expect(ink(Align::kRight, false), 50.0 - width, 42.7, 50.0, 50.0);
  expect(ink(Align::kLeft, true), 42.7, 50.0 - width, 50.0, 50.0);  // upward
  expect(ink(Align::kRight, true), 42.7, 50.0, 50.0, 50.0 + width);
}

TEST(Plot, BarsStandOnZeroBetweenTheirEdgesAndAreSharesHigh) {
  // Bins [-1, 1) with three of four values and [3, 5] with one, between them an empty one.
  const Histogram histogram = MakeHistogram({-0.5, 0.0, 0.5, 4.0}, -1.0, 5.0, 3);
  const Area area{10.0, 10.0, 60.0, 80.0};
  const Scale x{-1.0, 5.0, ""}, y{0.0, 1.0, ""};
  const Image bars = Drawn(
      80, 100, 2, [&](Canvas* canvas) { Plot(canvas, area, x, y).DrawBars(histogram, kRed); });
  // 20 points a bin, less 8 % on both sides; 80 points the whole.
  const Spot first = FindColor(bars, {0, 0, 100, 200}, kRed);
  EXPECT_NEAR(first.left, 2 * 11.6, 1.0);
  EXPECT_NEAR(first.right + 1, 2 * 28.4, 1.0);
  EXPECT_NEAR(first.top, 2 * (90.0 - 60.0), 1.0);
  EXPECT_NEAR(first.bottom, 2 * 90.0, 1.0);
  const Spot last = FindColor(bars, {100, 0, 60, 200}, kRed);
  EXPECT_NEAR(last.left, 2 * 51.6, 1.0);
  EXPECT_NEAR(last.right + 1, 2 * 68.4, 1.0);
  EXPECT_NEAR(last.top, 2 * (90.0 - 20.0), 1.0);
  const Image outline = Drawn(80, 100, 2, [&](Canvas* canvas) {
    Plot(canvas, area, x, y).DrawOutline(histogram, kBlue, 1.0);
  });
  const Spot around = FindColor(outline, Whole(outline), kBlue);
  EXPECT_NEAR(around.left, 2 * 9.5, 1.0);
  EXPECT_NEAR(around.right, 2 * 70.5, 1.0);
  EXPECT_NEAR(around.top, 2 * 29.5, 1.0);
  EXPECT_GT(FindColor(outline, {30, 58, 18, 4}, kBlue).count, 20);  // along the first bin's top
  EXPECT_EQ(FindColor(outline, {64, 0, 32, 176}, kBlue).count, 0);  // the empty bin is at zero
}

TEST(Plot, LinesBreakAtGapsAndMarksStandWhereTheirNumberIs) {
  const double none = std::nan("");
  const Image image = Drawn(120, 60, 2, [&](Canvas* canvas) {
    Plot plot(canvas, {10.0, 10.0, 100.0, 40.0}, {0.0, 10.0, ""}, {0.0, 4.0, ""});
    plot.DrawLine({0.0, 2.0, 4.0, 6.0, 8.0, 10.0}, {1.0, 1.0, none, 3.0, none, 2.0}, kRed, 2.0);
    plot.DrawMark(5.0, kBlue, 2.0, {});
    plot.DrawMark(11.0, kBlue, 2.0, {});  // outside
    plot.DrawMark(none, kBlue, 2.0, {});
  });
  const Spot piece = FindColor(image, {0, 0, 100, 120}, kRed);
  EXPECT_NEAR(piece.left, 2 * 9, 1.5);
  EXPECT_NEAR(piece.right + 1, 2 * 31, 1.5);
  EXPECT_NEAR(piece.top, 2 * 39, 1.5);                         // 1 of 4 above 50
  const Spot dot = FindColor(image, {120, 0, 60, 120}, kRed);  // at 6, 3: radius 3
  EXPECT_NEAR(0.5 * (dot.left + dot.right), 2 * 70, 1.0);
  EXPECT_NEAR(0.5 * (dot.top + dot.bottom), 2 * 20, 1.0);
  EXPECT_NEAR(FindColor(image, {180, 0, 60, 120}, kRed).left, 2 * 107, 1.5);
  const Spot mark = FindColor(image, Whole(image), kBlue);
  EXPECT_NEAR(mark.left, 2 * 59, 1.0);
  EXPECT_NEAR(mark.right, 2 * 61, 1.0);
  EXPECT_NEAR(mark.top, 2 * 9, 2.0);
  EXPECT_NEAR(mark.bottom, 2 * 51, 2.0);
}

TEST(Plot, LabelsStandBelowAndBesideTheirOwnAxis) {
  const auto drawn = [](const Scale& x, const Scale& y) {
    return Drawn(140, 90, 2, [&](Canvas* canvas) {
      Plot(canvas, {40.0, 10.0, 90.0, 50.0}, x, y).DrawAxes();
    });
  };
  const Area left{0.0, 0.0, 24.0, 180.0}, below{60.0, 150.0, 220.0, 30.0};
  const Image of_x = drawn({0.0, 1.0, "HHHH", false}, {0.0, 1.0, "", false});
  EXPECT_EQ(FindInk(of_x, left).count, 0);
  const Spot x_label = FindInk(of_x, below);
  EXPECT_GT(x_label.count, 20);
  EXPECT_NEAR(0.5 * (x_label.left + x_label.right), 2 * 85.0, 2.0);
  const Image of_y = drawn({0.0, 1.0, "", false}, {0.0, 1.0, "HHHH", false});
  EXPECT_EQ(FindInk(of_y, below).count, 0);
  const Spot y_label = FindInk(of_y, left);
  EXPECT_GT(y_label.count, 20);
  EXPECT_NEAR(0.5 * (y_label.top + y_label.bottom), 2 * 35.0, 2.0);
  // Numbers at the ticks: 0 and 100 % beside the axis of y.
  const Image numbers = drawn({0.0, 1.0, "", false}, {0.0, 1.0, "", true, true});
  EXPECT_GT(FindInk(numbers, {24.0, 110.0, 46.0, 20.0}).count, 5);
  EXPECT_LT(FindInk(numbers, {24.0, 10.0, 46.0, 20.0}).left,
            FindInk(numbers, {24.0, 110.0, 46.0, 20.0}).left);  // "100 %" is longer than "0 %"
}

TEST(ColorBar, RunsFromTheLowColourOnTheLeftToTheHighOneWithItsWordsBesideIt) {
  const Area bar{50.0, 10.0, 64.0, 6.0};
  const Image image = Drawn(160, 26, 2, [&](Canvas* canvas) {
    DrawColorBar(canvas, bar, &ReliabilityColor, 0.0, 1.0, "HHHH", "");
  });
  EXPECT_TRUE(Near(image.At(2 * 50 + 2, 26), ReliabilityColor(0.0), 8));
  EXPECT_TRUE(Near(image.At(2 * 82, 26), ReliabilityColor(0.5), 8));
  EXPECT_TRUE(Near(image.At(2 * 114 - 3, 26), ReliabilityColor(1.0), 8));
  EXPECT_GT(FindInk(image, {0.0, 0.0, 90.0, 52.0}).count, 20);  // the left words
  EXPECT_NEAR(FindInk(image, {0.0, 0.0, 96.0, 52.0}).right, 2 * 45, 3.0);
  EXPECT_EQ(FindInk(image, {236.0, 0.0, 84.0, 52.0}).count, 0);
  const Image part = Drawn(160, 26, 2, [&](Canvas* canvas) {
    DrawColorBar(canvas, bar, &SignedColor, -1.0, 0.0, "", "HHHH");
  });
  EXPECT_TRUE(Near(part.At(2 * 50 + 2, 26), SignedColor(-1.0), 8));
  EXPECT_TRUE(Near(part.At(2 * 114 - 3, 26), SignedColor(0.0), 8));
  EXPECT_EQ(FindInk(part, {0.0, 0.0, 96.0, 52.0}).count, 0);
  EXPECT_NEAR(FindInk(part, {236.0, 0.0, 84.0, 52.0}).left, 2 * 119, 3.0);
}

TEST(FigureCamera, CentresWhatIsSeenFromAnObliqueSide) {
  // The tetrahedron's picture is not about that of its bounding box's middle.
  View view;
  view.azimuth = 20.0;
  view.elevation = 35.0;
  for (const TriangleMesh& mesh :
       {shapes::Tetrahedron(), Transformed(shapes::Tetrahedron(), 3.0, {10.0, 20.0, 30.0})}) {
    const Camera camera = FigureCamera(mesh, view, 1.25);
    Eigen::Vector2d low(9, 9), high(-9, -9);
    for (const Eigen::Vector3d& v : mesh.vertices) {
      low = low.cwiseMin(camera.Project(v));
      high = high.cwiseMax(camera.Project(v));
    }
    EXPECT_NEAR((low + high - Eigen::Vector2d::Ones()).norm(), 0.0, 1e-9);
    EXPECT_NEAR((high - low).maxCoeff(), 1.0 / 1.25, 1e-9);
  }
}

}  // namespace
}  // namespace antigrasp
