#include "antigrasp/report/figures/row_figure.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "antigrasp/core/parallel.h"
#include "antigrasp/quality/graspability.h"
#include "antigrasp/report/figures/plot.h"

namespace antigrasp {
namespace {

constexpr double kExampleGap = 4.0;  // points
constexpr double kLabel = 12.0;      // the rows' labels, upward
constexpr double kTitles = 12.0;     // the columns' titles and the legend
constexpr double kCaption = 10.0;    // beneath an example
constexpr double kRowGap = 6.0;
constexpr double kLargestSide = 120.0;  // of an example
constexpr double kPlotShare = 0.36;     // of the page's width, at least

struct RowLayout {
  RowLayout(const RowFigure& figure, const FigureOptions& options) {
    std::size_t most = 1;
    for (const FigureRow& row : figure.rows) most = std::max(most, row.examples.size());
    columns = static_cast<int>(most);
    width = options.Width();
    const double pictures = width * (1.0 - kPlotShare) - kBorder - kLabel - kLeftOfPlot - 6.0;
    side = std::clamp((pictures - (columns - 1) * kExampleGap) / columns, 20.0, kLargestSide);
    pitch = side + kCaption + kRowGap;
    rows = static_cast<int>(figure.rows.size());
    height = kBorder + kTitles + rows * pitch + kBelowPlot - kRowGap;
  }
  Area Example(int row, int column) const {
    return {kBorder + kLabel + column * (side + kExampleGap), Top(row), side, side};
  }
  Area PlotArea(int row) const {
    const double left = kBorder + kLabel + columns * (side + kExampleGap) + kLeftOfPlot + 2.0;
    return {left, Top(row), width - left - kBorder - 4.0, side + kCaption};
  }
  double Top(int row) const { return kBorder + kTitles + row * pitch; }
  int columns = 1, rows = 0;
  double width = 0.0, height = 0.0, side = 0.0, pitch = 0.0;
};

// Pictures by row and column.
using Pictures = std::vector<std::vector<RgbaImage>>;

Pictures RenderExamples(const RowFigure& figure, const RowLayout& layout,
                        const FigureOptions& options) {
  struct Task {
    std::size_t row, column;
    Camera camera;
  };
  std::vector<Task> tasks;
  Pictures pictures(figure.rows.size());
  for (std::size_t r = 0; r < figure.rows.size(); ++r) {
    const auto& examples = figure.rows[r].examples;
    pictures[r].resize(examples.size());
    const std::size_t first = tasks.size();
    double largest = 0.0;
    for (std::size_t c = 0; c < examples.size(); ++c) {
      if (examples[c].mesh.faces.empty()) continue;
      tasks.push_back({r, c, FigureCamera(examples[c].mesh, options.view)});
      largest = std::max(largest, tasks.back().camera.half_side);
    }
    for (std::size_t t = first; t < tasks.size(); ++t) tasks[t].camera.half_side = largest;
  }
  View view = options.view;
  view.pixels = options.Pixels(layout.side);
  ParallelFor(std::ssize(tasks), options.threads, [&](std::int64_t i) {
    const Task& task = tasks[static_cast<std::size_t>(i)];
    pictures[task.row][task.column] =
        RenderOnNothing(figure.rows[task.row].examples[task.column].mesh, task.camera, view);
  });
  return pictures;
}

// Histograms of all rows over the same bins.
struct Distributions {
  explicit Distributions(const std::vector<FigureRow>& rows) {
    std::vector<double> all;
    for (const FigureRow& row : rows) {
      for (const auto* values : {&row.values, &row.reference}) {
        std::copy_if(values->begin(), values->end(), std::back_inserter(all),
                     [](double v) { return std::isfinite(v); });
      }
    }
    if (!all.empty()) {
      std::sort(all.begin(), all.end());
      const auto at = static_cast<std::size_t>(0.995 * static_cast<double>(all.size() - 1));
      high = std::max(RoundUp(0.0, all[at], 5), 1e-9);
    }
    std::size_t most = 0;
    for (const FigureRow& row : rows) most = std::max(most, row.values.size());
    const double root = std::sqrt(static_cast<double>(most));
    const int bins = std::clamp(static_cast<int>(std::lround(2.0 * root)), 10, 40);
    for (const FigureRow& row : rows) {
      values.push_back(MakeHistogram(row.values, 0.0, high, bins));
      reference.push_back(MakeHistogram(row.reference, 0.0, high, bins));
      largest = std::max({largest, values.back().LargestShare(), reference.back().LargestShare()});
    }
    if (largest <= 0.0) largest = 1.0;
  }
  double high = 1.0, largest = 0.0;
  std::vector<Histogram> values, reference;
};

std::string Kappa(double mean) {
  char text[40];
  std::snprintf(text, sizeof text, "\u03ba = %.2f", mean);
  return text;
}

void DrawDistribution(Canvas* canvas, const Area& area, const FigureRow& row,
                      const Distributions& all, std::size_t index, bool last,
                      const std::string& axis) {
  const Scale x{0.0, all.high, last ? axis : "", last};
  const Scale y{0.0, 1.08 * all.largest, "", true, true};
  Plot plot(canvas, area, x, y);
  const Histogram& values = all.values[index];
  const double right = area.Right() - 2.0;
  if (values.Total() == 0) {
    plot.DrawAxes();
    canvas->Text(row.gap, {right, area.y + 8.0}, {7.0, kMuted, Align::kRight});
    return;
  }
  const double mean = MeanWithInterval(row.values).mean;
  const double of_reference = MeanWithInterval(row.reference).mean;
  plot.DrawBars(values, kBars);
  if (!row.reference.empty()) plot.DrawOutline(all.reference[index], kInk.WithAlpha(0.55), 0.7);
  plot.DrawMark(of_reference, kInk.WithAlpha(0.55), 0.6, {1.2, 1.8});
  plot.DrawMark(mean, kMark, 0.8, {3.0, 1.5});
  plot.DrawAxes();
  canvas->Text(Kappa(mean), {right, area.y + 8.0}, {8.5, kMark, Align::kRight, true});
  canvas->Text("n = " + std::to_string(values.Total()), {right, area.y + 17.0},
               {6.5, kMuted, Align::kRight});
}

void DrawLegend(Canvas* canvas, const Area& plot, const RowFigure& figure) {
  const double base = plot.y - 4.0;
  const TextStyle style{6.5, kInk};
  double x = plot.x;
  canvas->Fill(Area{x, base - 4.5, 7.0, 4.5}, kBars);
  canvas->Text(figure.values_name, {x + 10.0, base}, style);
  if (figure.reference_name.empty()) return;
  x += 10.0 + canvas->TextWidth(figure.values_name, style) + 12.0;
  canvas->Line({{x, base}, {x, base - 4.0}, {x + 7.0, base - 4.0}, {x + 7.0, base}},
               kInk.WithAlpha(0.55), 0.7);
  canvas->Text(figure.reference_name, {x + 10.0, base}, style);
}

void DrawRow(Canvas* canvas, const RowLayout& layout, const FigureRow& row, int index,
             const std::vector<RgbaImage>& pictures) {
  const TextStyle label{7.5, kInk, Align::kMiddle, true, true};
  canvas->Text(canvas->Shortened(row.label, layout.pitch, label),
               {kBorder + 7.0, layout.Top(index) + 0.5 * (layout.side + kCaption)}, label);
  const TextStyle caption{6.0, kMuted, Align::kMiddle};
  for (std::size_t c = 0; c < pictures.size(); ++c) {
    const Area area = layout.Example(index, static_cast<int>(c));
    canvas->Picture(pictures[c], area);
    canvas->Text(canvas->Shortened(row.examples[c].caption, layout.side, caption),
                 {area.x + 0.5 * area.width, area.Bottom() + 7.0}, caption);
  }
}

}  // namespace

void WriteRowFigure(const std::filesystem::path& path, const RowFigure& figure,
                    const FigureOptions& options) {
  const RowLayout layout(figure, options);
  const Pictures pictures = RenderExamples(figure, layout, options);
  const Distributions all(figure.rows);
  WritePage(path, {layout.width, layout.height, options.dpi}, [&](Canvas* canvas) {
    for (std::size_t c = 0; c < figure.titles.size() && static_cast<int>(c) < layout.columns; ++c) {
      const Area area = layout.Example(0, static_cast<int>(c));
      canvas->Text(figure.titles[c], {area.x + 0.5 * area.width, area.y - 4.0},
                   {7.0, kInk, Align::kMiddle});
    }
    for (std::size_t r = 0; r < figure.rows.size(); ++r) {
      const int row = static_cast<int>(r);
      DrawRow(canvas, layout, figure.rows[r], row, pictures[r]);
      DrawDistribution(canvas, layout.PlotArea(row), figure.rows[r], all, r, row + 1 == layout.rows,
                       figure.axis);
    }
    const Area first = layout.PlotArea(0), last = layout.PlotArea(layout.rows - 1);
    DrawLegend(canvas, first, figure);
    canvas->Text("share of the objects",
                 {first.x - kLeftOfPlot + kLabelText, 0.5 * (first.y + last.Bottom())},
                 {kLabelText, kInk, Align::kMiddle, false, true});
  });
}

}  // namespace antigrasp
