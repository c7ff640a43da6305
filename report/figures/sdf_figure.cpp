#include "antigrasp/report/figures/sdf_figure.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "antigrasp/core/parallel.h"
#include "antigrasp/report/figures/plot.h"
#include "antigrasp/report/figures/sdf_slice.h"

namespace antigrasp {
namespace {

constexpr double kGridGap = 12.0;                  // points
constexpr double kBeneath = 24.0, kLegend = 16.0;  // below the panels
constexpr int kTile = 16;                          // pixels of a node's side

// Each side of the surface has the whole of its colour: inside, distances are much smaller.
struct SliceRange {
  explicit SliceRange(const SdfSlice& slice) {
    for (const float value : slice.values) {
      if (!std::isfinite(value)) continue;
      outside = std::max(outside, -static_cast<double>(value));
      inside = std::max(inside, static_cast<double>(value));
    }
  }
  Color ColorOf(double value) const {
    return SignedColor(value < 0.0 ? value / outside : inside > 0.0 ? value / inside : value);
  }
  double outside = 0.0, inside = 0.0;  // largest distances, both positive
};

// A tile per node, v upward.
RgbaImage Tiles(const SdfSlice& slice, const SliceRange& range) {
  RgbaImage image(slice.n * kTile, slice.n * kTile);
  const auto byte = [](double value) {
    return static_cast<std::uint8_t>(std::lround(255.0 * value));
  };
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const Color c = range.ColorOf(slice.At(x / kTile, slice.n - 1 - y / kTile));
      image.At(x, y) = {byte(c.r), byte(c.g), byte(c.b), 255};
    }
  }
  return image;
}

std::string Number(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, std::abs(value));
  return (value < 0.0 ? "\u2212" : "") + std::string(text);
}

std::string Faces(const std::string& what, const TriangleMesh& mesh) {
  return what + std::to_string(mesh.faces.size()) + " faces";
}

void DrawWords(Canvas* canvas, const Area& area, const std::string& title,
               const std::string& words) {
  const double middle = area.x + 0.5 * area.width;
  const TextStyle first{7.5, kInk, Align::kMiddle, true}, second{7.0, kInk, Align::kMiddle};
  canvas->Text(canvas->Shortened(title, area.width + kGridGap, first),
               {middle, area.Bottom() + 10.0}, first);
  canvas->Text(canvas->Shortened(words, area.width + kGridGap, second),
               {middle, area.Bottom() + 19.5}, second);
}

void DrawSection(Canvas* canvas, const Area& area, const SdfSlice& slice, const SliceRange& range,
                 int axis) {
  canvas->Picture(Tiles(slice, range), area);
  const double tile = area.width / slice.n;
  for (const ContourPiece& piece : ZeroContour(slice)) {
    const auto place = [&](const std::array<double, 2>& node) {
      return Place{area.x + (node[0] + 0.5) * tile, area.Bottom() - (node[1] + 0.5) * tile};
    };
    canvas->Line({place(piece[0]), place(piece[1])}, kInk, 1.1);
  }
  canvas->Frame(area, kMuted, 0.5);
  const char* across[] = {"y", "x", "x"};
  const char* upward[] = {"z", "z", "y"};
  canvas->Text(across[axis], {area.Right() - 3.0, area.Bottom() - 4.0},
               {7.0, {1.0, 1.0, 1.0}, Align::kRight, true});
  canvas->Text(upward[axis], {area.x + 4.0, area.y + 9.0},
               {7.0, {1.0, 1.0, 1.0}, Align::kLeft, true});
}

}  // namespace

void WriteSdfFigure(const std::filesystem::path& path, const SdfFigure& figure,
                    const FigureOptions& options) {
  const double width = options.Width();
  const double side = (width - 2.0 * kBorder - 2.0 * kGridGap) / 3.0;
  const double height = kBorder + side + kBeneath + kLegend;
  const auto panel = [&](int k) {
    return Area{kBorder + k * (side + kGridGap), kBorder, side, side};
  };

  const Camera camera = FigureCamera(figure.original, options.view);
  View view = options.view;
  view.pixels = options.Pixels(side);
  const TriangleMesh* meshes[] = {&figure.original, &figure.remeshed};
  RgbaImage pictures[2];
  ParallelFor(2, options.threads,
              [&](std::int64_t i) { pictures[i] = RenderOnNothing(*meshes[i], camera, view); });
  const SdfSlice slice = MakeSlice(figure.grid, figure.axis, figure.position);
  const SliceRange range(slice);
  const std::string n = std::to_string(figure.grid.n);

  WritePage(path, {width, height, options.dpi}, [&](Canvas* canvas) {
    for (int k = 0; k < 2; ++k) canvas->Picture(pictures[k], panel(k));
    DrawSection(canvas, panel(2), slice, range, figure.axis);
    DrawWords(canvas, panel(0), figure.name, Faces("original mesh, ", figure.original));
    DrawWords(canvas, panel(1), "Remeshed",
              Faces("from " + n + " x " + n + " x " + n + " distances, ", figure.remeshed));
    DrawWords(canvas, panel(2), "Signed distances",
              std::string("section at ") + "xyz"[figure.axis] + Number(" = %.3g", figure.position) +
                  ", zero contour");
    const Area bar{panel(2).x + 0.5 * side - 22.0, height - kLegend + 3.0, 44.0, 5.0};
    DrawColorBar(canvas, bar, &SignedColor, -1.0, 1.0, "outside " + Number("%.2f", -range.outside),
                 Number("%.2f", range.inside) + " inside");
  });
}

}  // namespace antigrasp
