#include "antigrasp/report/figures/plot.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "antigrasp/core/format.h"

namespace antigrasp {
namespace {

constexpr double kTickLength = 2.0;
constexpr double kAxisWidth = 0.5;
constexpr double kIntervalWidth = 0.7, kCap = 2.0;  // of an interval's bar, half of its ends

double Step(double low, double high, int count) {
  const double rough = (high - low) / std::max(count, 1);
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  const double lead = rough / power;
  return power * (lead < 1.5 ? 1.0 : lead < 3.5 ? 2.0 : lead < 7.5 ? 5.0 : 10.0);
}

bool IsRange(double low, double high) { return std::isfinite(high - low) && low < high; }

std::string TickText(double value, bool percent) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", percent ? 100.0 * value : value);
  const std::string number = text[0] == '-' ? "\u2212" + std::string(text + 1) : text;
  return percent ? number + " %" : number;
}

}  // namespace

std::vector<double> Ticks(double low, double high, int count) {
  std::vector<double> ticks;
  if (!IsRange(low, high)) return ticks;
  const double step = Step(low, high, count), slack = 1e-9 * (high - low);
  for (double k = std::ceil((low - slack) / step); k * step <= high + slack; k += 1.0) {
    ticks.push_back(k * step + 0.0);
  }
  return ticks;
}

double RoundUp(double low, double high, int count) {
  if (!IsRange(low, high)) return high;
  const double step = Step(low, high, count);
  return step * std::ceil(high / step - 1e-9);
}

Place Plot::At(double x, double y) const {
  return {area_.x + area_.width * (x - x_.low) / (x_.high - x_.low),
          area_.Bottom() - area_.height * (y - y_.low) / (y_.high - y_.low)};
}

void Plot::DrawAxes() {
  const auto along = std::max(2, static_cast<int>(area_.width / 28.0));
  const auto upward = std::max(2, static_cast<int>(area_.height / 28.0));
  TextStyle style{kTickText, kMuted, Align::kRight};
  for (const double tick : Ticks(y_.low, y_.high, upward)) {
    const Place at = At(x_.low, tick);
    canvas_->Line({{at.x - kTickLength, at.y}, at}, kMuted, kAxisWidth);
    if (y_.numbers) {
      canvas_->Text(TickText(tick, y_.percent), {at.x - 2.0 * kTickLength, at.y + 0.35 * kTickText},
                    style);
    }
  }
  style.align = Align::kMiddle;
  const auto tick_below = [&](double x, const std::string& text) {
    const Place at = At(x, y_.low);
    canvas_->Line({at, {at.x, at.y + kTickLength}}, kMuted, kAxisWidth);
    if (x_.numbers) {
      canvas_->Text(text, {at.x, at.y + 1.8 * kTickLength + kTickText * 0.8}, style);
    }
  };
  for (std::size_t k = 0; k < x_.names.size(); ++k) {
    tick_below(static_cast<double>(k), x_.names[k]);
  }
  if (x_.names.empty()) {
    for (const double tick : Ticks(x_.low, x_.high, along)) {
      tick_below(tick, TickText(tick, x_.percent));
    }
  }
  canvas_->Line({{area_.x, area_.y}, {area_.x, area_.Bottom()}, {area_.Right(), area_.Bottom()}},
                kMuted, kAxisWidth);
  canvas_->Text(x_.label, {area_.x + 0.5 * area_.width, area_.Bottom() + kBelowPlot - 4.0},
                {kLabelText, kInk, Align::kMiddle});
  canvas_->Text(y_.label, {area_.x - kLeftOfPlot + kLabelText, area_.y + 0.5 * area_.height},
                {kLabelText, kInk, Align::kMiddle, false, true});
}

void Plot::DrawBars(const Histogram& histogram, const Color& color) {
  for (int k = 0; k < static_cast<int>(histogram.counts.size()); ++k) {
    if (histogram.counts[static_cast<std::size_t>(k)] == 0) continue;
    const Place low = At(histogram.Edge(k), 0.0);
    const Place high = At(histogram.Edge(k + 1), histogram.Share(k));
    const double gap = 0.08 * (high.x - low.x);
    canvas_->Fill(Area{low.x + gap, high.y, high.x - low.x - 2.0 * gap, low.y - high.y}, color);
  }
}

void Plot::DrawOutline(const Histogram& histogram, const Color& color, double width) {
  std::vector<Place> outline{At(histogram.low, 0.0)};
  for (int k = 0; k < static_cast<int>(histogram.counts.size()); ++k) {
    outline.push_back(At(histogram.Edge(k), histogram.Share(k)));
    outline.push_back(At(histogram.Edge(k + 1), histogram.Share(k)));
  }
  outline.push_back(At(histogram.high, 0.0));
  canvas_->Line(outline, color, width);
}

void Plot::DrawLine(const std::vector<double>& x, const std::vector<double>& y, const Color& color,
                    double width, const std::vector<double>& dashes) {
  std::vector<Place> piece;
  const auto finish = [&] {
    if (piece.size() == 1) canvas_->Dot(piece.front(), 1.5 * width, color);
    if (piece.size() > 1) canvas_->Line(piece, color, width, dashes);
    piece.clear();
  };
  for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i) {
    if (std::isfinite(x[i]) && std::isfinite(y[i])) {
      piece.push_back(At(x[i], y[i]));
    } else {
      finish();
    }
  }
  finish();
}

void Plot::DrawPoint(double x, double y, const Color& color, double width, bool ring) {
  if (!std::isfinite(x) || !std::isfinite(y)) return;
  canvas_->Dot(At(x, y), 1.5 * width, color);
  if (ring) canvas_->Dot(At(x, y), 0.9 * width, {1.0, 1.0, 1.0});
}

void Plot::DrawInterval(double x, double y, double half_width, const Color& color) {
  if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(half_width)) return;
  const Place low = At(x, std::max(y - half_width, y_.low));
  const Place high = At(x, std::min(y + half_width, y_.high));
  canvas_->Line({low, high}, color, kIntervalWidth);
  for (const Place& end : {low, high}) {
    canvas_->Line({{end.x - kCap, end.y}, {end.x + kCap, end.y}}, color, kIntervalWidth);
  }
}

void Plot::DrawMark(double x, const Color& color, double width, const std::vector<double>& dashes) {
  if (!std::isfinite(x) || x < x_.low || x > x_.high) return;
  canvas_->Line({At(x, y_.low), At(x, y_.high)}, color, width, dashes);
}

void DrawColorBar(Canvas* canvas, const Area& area, Color (*color)(double), double low, double high,
                  const std::string& left, const std::string& right) {
  constexpr int kSteps = 64;
  for (int k = 0; k < kSteps; ++k) {  // each to the right end: no seam between two steps
    const double x = area.x + area.width * k / kSteps;
    canvas->Fill(Area{x, area.y, area.Right() - x, area.height},
                 color(low + (high - low) * k / (kSteps - 1)));
  }
  canvas->Frame(area, kHairline, 0.4);
  const double base = area.y + 0.5 * area.height + 0.36 * kLabelText;
  canvas->Text(left, {area.x - 5.0, base}, {kLabelText, kInk, Align::kRight});
  canvas->Text(right, {area.Right() + 5.0, base}, {kLabelText, kInk, Align::kLeft});
}

}  // namespace antigrasp
