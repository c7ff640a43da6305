#include "antigrasp/report/figures/trial_figure.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "antigrasp/report/figures/plot.h"

namespace antigrasp {
namespace {

constexpr double kSide = 150.0;    // points, the plots' height
constexpr double kLegends = 24.0;  // two lines above the plots
constexpr double kJudge = 12.0;    // beneath all
constexpr double kBetween = 10.0;
constexpr double kFrictionShare = 1.3;  // width of the plot over friction, in those over load
constexpr double kLeastSide = 20.0;     // of a page that is too narrow
constexpr double kLoadMargin = 0.3;     // of the step from load to load, beside the outer ones
constexpr double kLine = 1.2;
constexpr double kBeside = 3.5;                  // points from line to line at a friction
const std::vector<double> kDashes = {3.0, 3.0};  // before a change
constexpr Color kMasses[] = {kMark, {0.80, 0.36, 0.05}};

std::vector<std::string> Names(const TrialFigure& figure, std::string TriedSet::*field) {
  std::vector<std::string> names;
  for (const TriedSet& set : figure.sets) {
    if (std::find(names.begin(), names.end(), set.*field) == names.end()) {
      names.push_back(set.*field);
    }
  }
  return names;
}

std::vector<double> Frictions(const TrialFigure& figure) {
  std::set<double> frictions;
  for (const TriedSet& set : figure.sets) frictions.insert(set.friction);
  return {frictions.begin(), frictions.end()};
}

bool HasBefore(const TrialFigure& figure) {
  return std::any_of(figure.sets.begin(), figure.sets.end(),
                     [](const TriedSet& set) { return std::isfinite(set.before.mean); });
}

// The lowest friction lightest.
Color FrictionColor(std::size_t place, std::size_t count) {
  return DegreeColor(count > 1 ? static_cast<double>(place) / static_cast<double>(count - 1) : 1.0);
}

std::string FrictionText(double friction) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", friction);
  return text;
}

// The plot over friction, then one a kind of mass.
std::vector<Area> PlotAreas(double width, std::size_t loads) {
  const double left = kLeftOfPlot + kBorder, top = kBorder + kLegends;
  const double gaps = left + static_cast<double>(loads) * kBetween + kLeftOfPlot + 2.0 * kBorder;
  const double side =
      std::max((width - gaps) / (kFrictionShare + static_cast<double>(loads)), kLeastSide);
  std::vector<Area> areas = {{left, top, kFrictionShare * side, kSide}};
  for (std::size_t i = 0; i < loads; ++i) {
    const double x = areas.back().Right() + kBetween + (i == 0 ? kLeftOfPlot : 0.0);
    areas.push_back({x, top, side, kSide});
  }
  return areas;
}

// A line through sets, by place on the x axis; before a change or after it.
void DrawSeries(Plot* plot, const std::vector<const TriedSet*>& sets, const std::vector<double>& x,
                bool before, const Color& color, bool intervals) {
  std::vector<double> held;
  for (const TriedSet* set : sets) held.push_back((before ? set->before : set->after).mean);
  plot->DrawLine(x, held, color, kLine, before ? kDashes : std::vector<double>());
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const double half_width = (before ? sets[i]->before : sets[i]->after).half_width;
    if (intervals) plot->DrawInterval(x[i], held[i], half_width, color.WithAlpha(0.6));
    plot->DrawPoint(x[i], held[i], color, kLine, before);
  }
}

// Lines stand a little beside each other, about their friction: else their intervals would cover
// each other.
void DrawOverFriction(Canvas* canvas, const Area& area, const TrialFigure& figure) {
  const auto masses = Names(figure, &TriedSet::masses);
  const std::vector<double> frictions = Frictions(figure);
  const std::string first = Names(figure, &TriedSet::load).front();
  const double high = frictions.back() > 0.0 ? RoundUp(0.0, 1.05 * frictions.back(), 5) : 1.0;
  Plot plot(canvas, area, {0.0, high, "friction"}, {0.0, 100.0, "held at " + first + ", %"});
  plot.DrawAxes();
  const std::size_t sides = HasBefore(figure) ? 2 : 1, lines = sides * masses.size();
  for (std::size_t line = 0; line < lines; ++line) {
    const double beside = static_cast<double>(line) - 0.5 * static_cast<double>(lines - 1);
    std::vector<const TriedSet*> sets;
    std::vector<double> x;
    for (const double friction : frictions) {
      for (const TriedSet& set : figure.sets) {
        if (set.masses != masses[line / sides] || set.load != first) continue;
        if (set.friction != friction) continue;
        sets.push_back(&set);
        x.push_back(friction + kBeside * beside * high / area.width);
      }
    }
    const Color color = kMasses[line / sides % std::size(kMasses)];
    DrawSeries(&plot, sets, x, sides == 2 && line % 2 == 0, color, true);
  }
}

void DrawOverLoad(Canvas* canvas, const Area& area, const TrialFigure& figure,
                  const std::string& masses, bool numbers) {
  const auto loads = Names(figure, &TriedSet::load);
  const std::vector<double> frictions = Frictions(figure);
  Scale x{-kLoadMargin, static_cast<double>(loads.size() - 1) + kLoadMargin, "load"};
  x.names = loads;
  Plot plot(canvas, area, x, {0.0, 100.0, numbers ? "held, %" : "", numbers});
  plot.DrawAxes();
  for (std::size_t f = 0; f < frictions.size(); ++f) {
    std::vector<const TriedSet*> sets;
    std::vector<double> places;
    for (std::size_t k = 0; k < loads.size(); ++k) {
      for (const TriedSet& set : figure.sets) {
        if (set.masses != masses || set.load != loads[k] || set.friction != frictions[f]) continue;
        sets.push_back(&set);
        places.push_back(static_cast<double>(k));
      }
    }
    for (const bool before : {true, false}) {
      DrawSeries(&plot, sets, places, before, FrictionColor(f, frictions.size()), false);
    }
  }
  canvas->Text(masses, {area.x + 0.5 * area.width, area.y - 4.0}, {7.0, kInk, Align::kMiddle});
}

// A piece of a line with its name; where the next one may stand.
double DrawKey(Canvas* canvas, const Place& at, const std::string& name, const Color& color,
               const std::vector<double>& dashes) {
  const TextStyle style{6.5, kInk};
  canvas->Line({{at.x, at.y - 2.2}, {at.x + 12.0, at.y - 2.2}}, color, kLine, dashes);
  canvas->Text(name, {at.x + 15.0, at.y}, style);
  return at.x + 15.0 + canvas->TextWidth(name, style) + 10.0;
}

void DrawKeys(Canvas* canvas, const Area& left, const Area& right, const TrialFigure& figure) {
  const double first = kBorder + 6.0, second = left.y - 4.0;
  double x = left.x;
  const auto masses = Names(figure, &TriedSet::masses);
  for (std::size_t m = 0; m < masses.size(); ++m) {
    x = DrawKey(canvas, {x, first}, masses[m], kMasses[m % std::size(kMasses)], {});
  }
  if (HasBefore(figure)) {
    canvas->Dot({left.x + 6.0, second - 2.2}, 1.5 * kLine, kMuted);
    x = DrawKey(canvas, {left.x, second}, "after", kMuted, {});
    DrawKey(canvas, {x, second}, "before", kMuted, kDashes);
    canvas->Dot({x + 6.0, second - 2.2}, 1.5 * kLine, kMuted);
    canvas->Dot({x + 6.0, second - 2.2}, 0.9 * kLine, {1.0, 1.0, 1.0});
  }
  const TextStyle style{6.5, kInk};
  canvas->Text("friction", {right.x, first}, style);
  x = right.x + canvas->TextWidth("friction", style) + 6.0;
  const std::vector<double> frictions = Frictions(figure);
  for (std::size_t f = 0; f < frictions.size(); ++f) {
    x = DrawKey(canvas, {x, first}, FrictionText(frictions[f]), FrictionColor(f, frictions.size()),
                {});
  }
}

}  // namespace

void WriteTrialFigure(const std::filesystem::path& path, const TrialFigure& figure,
                      const FigureOptions& options) {
  const auto masses = Names(figure, &TriedSet::masses);
  const std::vector<Area> areas = PlotAreas(options.Width(), masses.size());
  const double height = areas[0].Bottom() + kBelowPlot + kJudge;
  WritePage(path, {options.Width(), height, options.dpi}, [&](Canvas* canvas) {
    DrawOverFriction(canvas, areas[0], figure);
    for (std::size_t m = 0; m < masses.size(); ++m) {
      DrawOverLoad(canvas, areas[m + 1], figure, masses[m], m == 0);
    }
    DrawKeys(canvas, areas[0], areas[1], figure);
    canvas->Text(figure.caption, {0.5 * options.Width(), height - 4.0},
                 {6.0, kMuted, Align::kMiddle});
  });
}

}  // namespace antigrasp
