#pragma once

#include <string>
#include <vector>

#include "antigrasp/report/figures/canvas.h"
#include "antigrasp/report/figures/histogram.h"

namespace antigrasp {

// One coordinate axis of a plot.
struct Scale {
  double low = 0.0, high = 1.0;  // low < high
  std::string label;
  bool numbers = true;  // beside the ticks; panels that share an axis write them once
  bool percent = false;
  std::vector<std::string> names = {};  // of x = 0, 1, ...; in place of numbers
};

// Round numbers (1, 2 or 5 times a power of ten apart) inside [low, high], about `count` of them;
// none for a range that is empty or not finite.
std::vector<double> Ticks(double low, double high, int count);
// `high` or the next round number above it, so that an axis from `low` ends at a tick.
double RoundUp(double low, double high, int count);

// A plot inside the area of its axes: ticks and labels stand outside, to the left and below, and
// take up to kLeftOfPlot and kBelowPlot points.
class Plot {
 public:
  Plot(Canvas* canvas, const Area& area, const Scale& x, const Scale& y)
      : canvas_(canvas), area_(area), x_(x), y_(y) {}

  void DrawAxes();
  // Bars from zero; filled, or their outline alone.
  void DrawBars(const Histogram& histogram, const Color& color);
  void DrawOutline(const Histogram& histogram, const Color& color, double width);
  // NaN breaks the line; a lone point is a dot.
  void DrawLine(const std::vector<double>& x, const std::vector<double>& y, const Color& color,
                double width, const std::vector<double>& dashes = {});
  // A dot, or a ring; and a bar over y +- half_width as far as the plot reaches. NaN: none.
  void DrawPoint(double x, double y, const Color& color, double width, bool ring = false);
  void DrawInterval(double x, double y, double half_width, const Color& color);
  // Upright through the whole plot.
  void DrawMark(double x, const Color& color, double width, const std::vector<double>& dashes);

  Place At(double x, double y) const;

 private:
  Canvas* canvas_;
  Area area_;
  Scale x_, y_;
};

inline constexpr double kBorder = 4.0;  // points around every figure
inline constexpr double kLeftOfPlot = 32.0;
inline constexpr double kBelowPlot = 24.0;
inline constexpr double kTickText = 6.0;  // points
inline constexpr double kLabelText = 7.0;

// A legend of colours from `low` (left) to `high` (right), words beside it, centred in the area.
void DrawColorBar(Canvas* canvas, const Area& area, Color (*color)(double), double low, double high,
                  const std::string& left, const std::string& right);

}  // namespace antigrasp
