#include "antigrasp/report/figures/grasp_figure.h"

#include <gtest/gtest.h>

#include <cmath>

#include "antigrasp/core/atomic_file.h"
#include "tests/report/figures/pixels.h"
#include "tests/support/read_png.h"
#include "tests/support/shapes.h"
#include "tests/support/well_formed.h"

namespace antigrasp {
namespace {

using shapes::TempFolder;

GraspedObject Scored(const std::string& name, const TriangleMesh& mesh) {
  MetricOptions metric;
  metric.num_grasps = 20;
  metric.num_draws = 2;
  return {name, "ok", mesh, EvaluateGraspability(mesh, metric, 1, 0)};
}

GraspFigure Example() {
  GraspFigure figure;
  figure.objects.push_back(Scored("a <cube> & \"more\"", shapes::Cube()));
  figure.objects.push_back(Scored("", shapes::Cylinder(0.3, 1.0, 24)));
  figure.objects.push_back({"open", "open: 4 boundary edges", shapes::FlatSquare(), {}});
  figure.objects.push_back({"nothing", "not readable", {}, {}});
  figure.histories = {{"x", {0.0, 1.0, 2.0, 3.0}, {9.0, std::nan(""), 4.0, 2.0}}, {"y", {}, {}}};
  figure.shown = 8;
  return figure;
}

FigureOptions Small(int threads) {
  FigureOptions options;
  options.width_mm = 90.0;
  options.dpi = 100.0;
  options.threads = threads;
  return options;
}

std::string Written(const TempFolder& folder, const std::string& name, const GraspFigure& figure,
                    int threads) {
  WriteGraspFigure(folder / name, figure, Small(threads));
  return ReadFile(folder / name);
}

TEST(GraspFigure, HasTheSameBytesForAnyNumberOfThreads) {
  const TempFolder folder;
  const GraspFigure figure = Example();
  for (const char* name : {"f.svg", "f.png"}) {
    EXPECT_EQ(Written(folder, name, figure, 1), Written(folder, name, figure, 3)) << name;
  }
  EXPECT_EQ(shapes::WhyNotWellFormed(ReadFile(folder / "f.svg")), "");
}

TEST(GraspFigure, AxesAreDrawnFromRedToGreen) {
  const TempFolder folder;
  GraspFigure figure = Example();
  figure.objects.resize(2);
  figure.histories.clear();
  Written(folder, "f.png", figure, 1);
  const Image image = ReadPng(folder / "f.png");
  int red = 0, green = 0;
  for (int y = 0; y < image.height / 2; ++y) {  // above the legend of colours
    for (int x = 0; x < image.width; ++x) {
      const Rgb& p = image.At(x, y);
      red += p[0] > p[1] + 100 && p[0] > p[2] + 100 ? 1 : 0;
      green += p[1] > p[0] + 70 && p[1] > p[2] + 70 ? 1 : 0;
    }
  }
  EXPECT_GT(red, 5);
  EXPECT_GT(green, 5);
}

// A cube as large as all others, grasped along y at these heights; scored twice as large.
GraspedObject GraspedAt(const std::vector<std::pair<double, double>>& height_and_quality) {
  GraspedObject object{"", "", shapes::Cube(), {}};
  object.score.scale = 2.0;
  for (const auto& [z, quality] : height_and_quality) {
    ScoredGrasp grasp;
    grasp.grasp.contacts[0].point = 2.0 * Eigen::Vector3d(0.0, -0.5, z);
    grasp.grasp.contacts[1].point = 2.0 * Eigen::Vector3d(0.0, 0.5, z);
    grasp.grasp.axis = Eigen::Vector3d::UnitY();
    grasp.quality = quality;
    object.score.grasps.push_back(grasp);
  }
  return object;
}

// From +x, y to the right, at two pixels a point; the picture is the first cell.
Image SeenFromX(const TempFolder& folder, GraspFigure figure, int columns) {
  FigureOptions options;
  options.width_mm = 60.0;
  options.dpi = 144.0;
  options.view.samples = 1;
  options.threads = 1;
  options.columns = columns;
  options.view.azimuth = options.view.elevation = 0.0;
  WriteGraspFigure(folder / "f.png", figure, options);
  return ReadPng(folder / "f.png");
}

bool IsRed(const Rgb& p) { return p[0] > p[1] + 60 && p[0] > p[2] + 60; }
bool IsGreen(const Rgb& p) { return p[1] > p[0] + 50 && p[1] > p[2] + 50; }

TEST(GraspFigure, TheMoreReliableAxisIsGreenAndStandsAtItsHeight) {
  const TempFolder folder;
  for (const double sign : {1.0, -1.0}) {
    GraspFigure figure;
    figure.objects.push_back(GraspedAt({{0.3 * sign, 0.9}, {-0.3 * sign, 0.1}}));
    const Image image = SeenFromX(folder, figure, 1);
    const double side = image.width - 16.0;  // four points at either border
    const Area top{8.0, 8.0, side, 0.5 * side}, bottom{8.0, 8.0 + 0.5 * side, side, 0.5 * side};
    const auto green = pixels::Find(image, sign > 0 ? top : bottom, &IsGreen);
    const auto red = pixels::Find(image, sign > 0 ? bottom : top, &IsRed);
    EXPECT_GT(green.count, 20);
    EXPECT_GT(red.count, 20);
    EXPECT_EQ(pixels::Find(image, sign > 0 ? top : bottom, &IsRed).count, 0);
    EXPECT_EQ(pixels::Find(image, sign > 0 ? bottom : top, &IsGreen).count, 0);
    // The picture is 1.24 cubes high: 0.3 of a cube above its middle.
    EXPECT_NEAR(0.5 * (green.top + green.bottom) - (8.0 + 0.5 * side), -0.3 * sign * side / 1.24,
                2.0);
    // 0.14 half sides beyond the cube on both sides.
    EXPECT_NEAR(green.left - 8.0, (0.5 - 0.5 / 1.24 - 0.07) * side, 3.0);
    EXPECT_NEAR(green.right - 8.0, (0.5 + 0.5 / 1.24 + 0.07) * side, 3.0);
  }
}

TEST(GraspFigure, AFewFarBetterGraspsLeaveTheOthersTheirColours) {
  // 0, eighteen times 1, and 100: the 95th percentile of 20 is 1, as green as it gets.
  const TempFolder folder;
  GraspFigure figure;
  std::vector<std::pair<double, double>> grasps(18, {0.3, 1.0});
  grasps.push_back({-0.3, 0.0});
  grasps.push_back({0.0, 100.0});
  figure.objects.push_back(GraspedAt(grasps));
  const Image image = SeenFromX(folder, figure, 1);
  const double side = image.width - 16.0, middle = 8.0 + 0.5 * side;
  const auto line = [&](double z) { return Area{8.0, middle - z * side / 1.24 - 4.0, side, 8.0}; };
  EXPECT_GT(pixels::Find(image, line(0.3), &IsGreen).count, 20);
  EXPECT_GT(pixels::Find(image, line(0.0), &IsGreen).count, 20);
  EXPECT_GT(pixels::Find(image, line(-0.3), &IsRed).count, 20);
}

TEST(GraspFigure, ObjectsOfARowShareAScaleAndRowsDoNot) {
  const TempFolder folder;
  GraspFigure figure;
  for (const double size : {1.0, 0.5, 0.5}) {
    figure.objects.push_back({"", "", shapes::Box(Eigen::Vector3d::Constant(size)), {}});
  }
  const Image image = SeenFromX(folder, figure, 2);
  const auto is_blue = [](const Rgb& p) { return p[2] > p[0] + 20; };
  const double side = (image.width - 16.0 - 20.0) / 2.0;
  const auto wide = [&](int row, int column) {
    const auto spot = pixels::Find(
        image, {8.0 + column * (side + 20.0), 8.0 + row * (side + 48.0), side, side}, is_blue);
    return spot.right + 1 - spot.left;
  };
  EXPECT_NEAR(wide(0, 0), side / 1.24, 2.0);
  EXPECT_NEAR(wide(0, 1), 0.5 * side / 1.24, 2.0);
  EXPECT_NEAR(wide(1, 0), side / 1.24, 2.0);
}

TEST(GraspFigure, OfManyGraspsTheMostRobustAreShown) {
  const TempFolder folder;
  GraspFigure figure;
  figure.objects.push_back(GraspedAt({{-0.4, 0.1}, {0.4, 0.9}, {0.0, 0.2}, {0.2, 0.8}}));
  figure.shown = 2;
  const Image image = SeenFromX(folder, figure, 1);
  const double side = image.width - 16.0, middle = 8.0 + 0.5 * side;
  const auto colored = [&](double z) {
    const Area line{8.0, middle - z * side / 1.24 - 4.0, side, 8.0};
    return pixels::Find(image, line, &IsRed).count + pixels::Find(image, line, &IsGreen).count > 0;
  };
  EXPECT_TRUE(colored(0.4));
  EXPECT_TRUE(colored(0.2));
  EXPECT_FALSE(colored(0.0));
  EXPECT_FALSE(colored(-0.4));
}

TEST(GraspFigure, ObjectsStandRowByRowAndThePlotEndsTheFirstRow) {
  const TempFolder folder;
  const auto is_blue = [](const Rgb& p) { return p[2] > p[0] + 20; };
  for (int shown = 0; shown < 3; ++shown) {
    // The second and third of three objects follow the plot in a page of two columns.
    GraspFigure figure;
    for (int i = 0; i < 3; ++i) {
      figure.objects.push_back({"", "", i == shown ? shapes::Cube() : TriangleMesh(), {}});
    }
    figure.histories = {{"", {0.0, 10.0}, {8.0, 4.0}}};
    const Image image = SeenFromX(folder, figure, 2);
    const double side = (image.width - 16.0 - 20.0) / 2.0;  // in pixels: border 8, gap 20
    const auto cell = [&](int row, int column) {
      const Area area{8.0 + column * (side + 20.0), 8.0 + row * (side + 48.0), side, side};
      // The first history's line is blue, too, but thin.
      return pixels::Find(image, area, is_blue).count > 0.2 * side * side;
    };
    EXPECT_EQ(cell(0, 0), shown == 0);
    EXPECT_FALSE(cell(0, 1));
    EXPECT_EQ(cell(1, 0), shown == 1);
    EXPECT_EQ(cell(1, 1), shown == 2);
  }
}

TEST(GraspFigure, ThePlotFallsWithItsPairs) {
  const TempFolder folder;
  GraspFigure figure;
  figure.objects.push_back({"", "", TriangleMesh(), {}});
  figure.histories = {{"", {0.0, 10.0}, {8.0, 2.0}}};
  const Image image = SeenFromX(folder, figure, 2);
  const Color line{0.13, 0.37, 0.66};
  const double half = 0.5 * image.width;
  const auto all = pixels::FindColor(image, {half, 0.0, half, half}, line);
  ASSERT_GT(all.count, 20);
  const double middle = 0.5 * (all.left + all.right);
  const auto first = pixels::FindColor(image, {half, 0.0, middle - half, half}, line);
  const auto second = pixels::FindColor(image, {middle, 0.0, half, half}, line);
  EXPECT_LT(first.top, second.top - 10);  // y is down
}

TEST(GraspFigure, TheLegendsWordsAreOnTheirOwnSides) {
  const TempFolder folder;
  GraspFigure figure;
  figure.objects.push_back({"", "", TriangleMesh(), {}});
  FigureOptions options;
  options.width_mm = 70.0;
  options.dpi = 576.0;  // 8 dots a point: the two words differ by half a point
  WriteGraspFigure(folder / "f.png", figure, options);
  const Image image = ReadPng(folder / "f.png");
  double least = 0.0, most = 0.0;
  pixels::Drawn(10, 10, 1, [&](Canvas* canvas) {
    least = canvas->TextWidth("least reliable", {7.0});
    most = canvas->TextWidth("most reliable", {7.0});
  });
  ASSERT_GT(std::abs(least - most), 0.5);
  // The bar is 90 points wide, its words 5 beside it; a letter's bearing is less than a point.
  const auto ink = pixels::FindInk(
      image, {0.0, image.height - 8.0 * 22.0, static_cast<double>(image.width), 8.0 * 12.0});
  const double middle = 4.0 * options.Width();
  const double left = (middle - ink.left) / 8.0 - 50.0,
               right = (ink.right + 1 - middle) / 8.0 - 50.0;
  EXPECT_NEAR(left + right, least + most, 2.0);
  EXPECT_GT((left - right) * (least - most), 0.0);
}

TEST(GraspFigure, AnObjectWithoutGraspsAndAPageWithoutObjectsAreDrawn) {
  const TempFolder folder;
  GraspFigure figure;
  figure.objects.push_back({"nothing", "not readable", {}, {}});
  EXPECT_EQ(shapes::WhyNotWellFormed(Written(folder, "f.svg", figure, 1)), "");
  figure.histories = {{"x", {}, {}}};
  EXPECT_EQ(shapes::WhyNotWellFormed(Written(folder, "g.svg", figure, 1)), "");
}

}  // namespace
}  // namespace antigrasp
