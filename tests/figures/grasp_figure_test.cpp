#include "antigrasp/figures/grasp_figure.h"

#include <gtest/gtest.h>

#include <cmath>

#include "antigrasp/core/atomic_file.h"
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
