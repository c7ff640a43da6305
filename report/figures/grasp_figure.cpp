#include "antigrasp/report/figures/grasp_figure.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "antigrasp/core/parallel.h"
#include "antigrasp/report/figures/plot.h"

namespace antigrasp {
namespace {

constexpr double kPanelGap = 10.0;                 // points
constexpr double kBeneath = 24.0, kLegend = 22.0;  // below an object, below all
constexpr double kRoom = 1.24;                     // of a picture about its object, for the axes
constexpr double kBeyond = 0.14;                   // of the half side: an axis beyond a contact
constexpr double kGreenPercentile = 95.0;          // of the grasps shown: as green as it gets

constexpr Color kSeries[] = {{0.13, 0.37, 0.66}, {0.80, 0.36, 0.05}, {0.10, 0.55, 0.38},
                             {0.55, 0.25, 0.60}, {0.60, 0.50, 0.10}, {0.25, 0.60, 0.75}};

struct Axis {
  std::vector<SeenPiece> pieces;
  std::vector<Place> contacts;  // those that are seen, in the picture
  double quality = 0.0;
};

struct Panel {
  Camera camera;
  RgbaImage image;
  std::vector<Axis> axes;  // the most robust last: drawn on top
};

// The most robust, ties in the order in which they were sampled.
std::vector<const ScoredGrasp*> MostRobust(const Graspability& score, int count) {
  std::vector<const ScoredGrasp*> grasps;
  for (const ScoredGrasp& grasp : score.grasps) grasps.push_back(&grasp);
  std::stable_sort(grasps.begin(), grasps.end(), [](const ScoredGrasp* a, const ScoredGrasp* b) {
    return a->quality > b->quality;
  });
  if (grasps.size() > static_cast<std::size_t>(count)) {
    grasps.resize(static_cast<std::size_t>(count));
  }
  std::reverse(grasps.begin(), grasps.end());
  return grasps;
}

std::vector<Axis> AxesOf(const GraspedObject& object, const Camera& camera, int count) {
  std::vector<Axis> axes;
  const RayScene scene(object.mesh);
  const double size = Bounds(object.mesh).Extent().norm();
  for (const ScoredGrasp* grasp : MostRobust(object.score, count)) {
    const Eigen::Vector3d a = grasp->grasp.contacts[0].point / object.score.scale;
    const Eigen::Vector3d b = grasp->grasp.contacts[1].point / object.score.scale;
    const Eigen::Vector3d beyond = kBeyond * camera.half_side * grasp->grasp.axis;
    Axis axis;
    axis.quality = grasp->quality;
    axis.pieces = SeenLine(scene, camera, size, a - beyond, b + beyond);
    for (const Eigen::Vector3d& contact : {a, b}) {
      const auto pieces = SeenLine(scene, camera, size, contact, contact);
      if (pieces.front().visible) axis.contacts.push_back(pieces.front().from);
    }
    axes.push_back(std::move(axis));
  }
  return axes;
}

// Where everything stands: a grid of equal cells, the plot in the last one of the first row.
struct GraspLayout {
  GraspLayout(const GraspFigure& figure, const FigureOptions& options) {
    const int objects = static_cast<int>(figure.objects.size());
    has_plot = !figure.histories.empty();
    const int panels = objects + (has_plot ? 1 : 0);
    columns = options.columns > 0 ? options.columns : std::min(panels, has_plot ? 3 : 4);
    columns = std::max(columns, has_plot ? 2 : 1);
    rows = (panels + columns - 1) / columns;
    width = options.Width();
    side = (width - 2.0 * kBorder - (columns - 1) * kPanelGap) / columns;
    height = kBorder + rows * (side + kBeneath) + kLegend;
  }
  // Of object i; the plot pushes what follows it on.
  int Cell(int i) const { return has_plot && i >= columns - 1 ? i + 1 : i; }
  int Row(int i) const { return Cell(i) / columns; }
  Area CellArea(int cell) const {
    return {kBorder + (cell % columns) * (side + kPanelGap),
            kBorder + (cell / columns) * (side + kBeneath), side, side};
  }
  int columns = 1, rows = 1;
  bool has_plot = false;
  double width = 0.0, height = 0.0, side = 0.0;
};

// One scale for the objects of a row: before and after stay comparable.
void ShareScaleInRows(const GraspLayout& layout, std::vector<Panel>* panels) {
  std::vector<double> largest(static_cast<std::size_t>(layout.rows) + 1, 0.0);
  const auto row = [&](std::size_t i) {
    return static_cast<std::size_t>(layout.Row(static_cast<int>(i)));
  };
  for (std::size_t i = 0; i < panels->size(); ++i) {
    largest[row(i)] = std::max(largest[row(i)], (*panels)[i].camera.half_side);
  }
  for (std::size_t i = 0; i < panels->size(); ++i) (*panels)[i].camera.half_side = largest[row(i)];
}

std::vector<Panel> MakePanels(const GraspFigure& figure, const GraspLayout& layout,
                              const FigureOptions& options) {
  std::vector<Panel> panels(figure.objects.size());
  for (std::size_t i = 0; i < panels.size(); ++i) {
    panels[i].camera = FigureCamera(figure.objects[i].mesh, options.view, kRoom);
  }
  ShareScaleInRows(layout, &panels);
  View view = options.view;
  view.pixels = options.Pixels(layout.side);
  ParallelFor(std::ssize(panels), options.threads, [&](std::int64_t i) {
    Panel& panel = panels[static_cast<std::size_t>(i)];
    const GraspedObject& object = figure.objects[static_cast<std::size_t>(i)];
    if (object.mesh.faces.empty()) return;
    panel.image = RenderOnNothing(object.mesh, panel.camera, view);
    panel.axes = AxesOf(object, panel.camera, figure.shown);
  });
  return panels;
}

// From the worst of all grasps shown to a good one: a few far better ones would leave all others
// red.
struct QualityRange {
  explicit QualityRange(const std::vector<Panel>& panels) {
    std::vector<double> qualities;
    for (const Panel& panel : panels) {
      for (const Axis& axis : panel.axes) qualities.push_back(axis.quality);
    }
    if (qualities.empty()) return;
    low = *std::min_element(qualities.begin(), qualities.end());
    high = DiscretePercentile(std::move(qualities), kGreenPercentile);
  }
  // 1 for the most reliable; where all are equal, all are that.
  double Share(double quality) const { return high > low ? (quality - low) / (high - low) : 1.0; }
  double low = 0.0, high = 0.0;
};

void DrawPanel(Canvas* canvas, const Area& area, const Panel& panel, const QualityRange& range) {
  canvas->Picture(panel.image, area);
  for (const bool visible : {false, true}) {
    for (const Axis& axis : panel.axes) {
      const Color color = ReliabilityColor(range.Share(axis.quality));
      for (const SeenPiece& piece : axis.pieces) {
        if (piece.visible != visible) continue;
        canvas->Line({OnPage(area, piece.from), OnPage(area, piece.to)},
                     visible ? color : color.WithAlpha(0.22), visible ? 1.0 : 0.6);
      }
      if (!visible) continue;
      for (const Place& contact : axis.contacts) {
        canvas->Dot(OnPage(area, contact), 1.5, color);
      }
    }
  }
}

void DrawWords(Canvas* canvas, const Area& area, const GraspedObject& object) {
  const double middle = area.x + 0.5 * area.width;
  const TextStyle name{7.5, kInk, Align::kMiddle, true}, number{7.0, kInk, Align::kMiddle};
  canvas->Text(canvas->Shortened(object.name, area.width, name), {middle, area.Bottom() + 7.0},
               name);
  std::string words = object.status;
  if (object.score.status != GraspabilityStatus::kNotEvaluable) {
    char text[64];
    std::snprintf(text, sizeof text, "graspability %.5f", object.score.value);
    words = text + (object.status == "ok" ? std::string() : " (" + object.status + ")");
  }
  canvas->Text(canvas->Shortened(words, area.width, number), {middle, area.Bottom() + 16.5},
               number);
}

// The range of all numbers in the histories' field; [0, 1] when there are none.
double LargestOf(const std::vector<PairHistory>& histories,
                 std::vector<double> PairHistory::*field) {
  double largest = 0.0;
  for (const PairHistory& history : histories) {
    for (const double value : history.*field) {
      if (std::isfinite(value)) largest = std::max(largest, value);
    }
  }
  return largest > 0.0 ? largest : 1.0;
}

void DrawHistories(Canvas* canvas, const Area& cell, const std::vector<PairHistory>& histories) {
  const Area area{cell.x + kLeftOfPlot + 2.0, cell.y + 6.0, cell.width - kLeftOfPlot - 8.0,
                  cell.height - 12.0};
  const double pairs = LargestOf(histories, &PairHistory::pairs);
  const Scale x{0.0, LargestOf(histories, &PairHistory::iteration), "iteration"};
  const Scale y{0.0, RoundUp(0.0, pairs, 5), "antipodal pairs of faces"};
  Plot plot(canvas, area, x, y);
  plot.DrawAxes();
  constexpr std::size_t kColors = std::size(kSeries);
  for (std::size_t i = 0; i < histories.size(); ++i) {
    plot.DrawLine(histories[i].iteration, histories[i].pairs, kSeries[i % kColors], 1.2);
  }
  if (histories.size() < 2 || histories.size() > kColors) return;
  const TextStyle style{6.5, kInk, Align::kRight};
  for (std::size_t i = 0; i < histories.size(); ++i) {
    const double base = area.y + 4.0 + 9.0 * static_cast<double>(i);
    canvas->Line({{area.Right() - 10.0, base - 2.2}, {area.Right(), base - 2.2}}, kSeries[i], 1.2);
    canvas->Text(canvas->Shortened(histories[i].object, 0.6 * area.width, style),
                 {area.Right() - 14.0, base}, style);
  }
}

}  // namespace

void WriteGraspFigure(const std::filesystem::path& path, const GraspFigure& figure,
                      const FigureOptions& options) {
  const GraspLayout layout(figure, options);
  const std::vector<Panel> panels = MakePanels(figure, layout, options);
  const QualityRange range(panels);
  WritePage(path, {layout.width, layout.height, options.dpi}, [&](Canvas* canvas) {
    for (std::size_t i = 0; i < panels.size(); ++i) {
      const Area area = layout.CellArea(layout.Cell(static_cast<int>(i)));
      DrawPanel(canvas, area, panels[i], range);
      DrawWords(canvas, area, figure.objects[i]);
    }
    if (layout.has_plot) {
      DrawHistories(canvas, layout.CellArea(layout.columns - 1), figure.histories);
    }
    const Area bar{0.5 * layout.width - 45.0, layout.height - kLegend + 3.0, 90.0, 5.0};
    DrawColorBar(canvas, bar, &ReliabilityColor, 0.0, 1.0, "least reliable", "most reliable");
    canvas->Text(figure.caption, {0.5 * layout.width, layout.height - 4.0},
                 {6.0, kMuted, Align::kMiddle});
  });
}

}  // namespace antigrasp
