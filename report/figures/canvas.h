#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "antigrasp/render/image.h"
#include "antigrasp/report/figures/color.h"

struct _cairo;

namespace antigrasp {

struct Place {
  double x = 0.0, y = 0.0;
};

// From the top left.
struct Area {
  double x = 0.0, y = 0.0, width = 0.0, height = 0.0;
  double Right() const { return x + width; }
  double Bottom() const { return y + height; }
};

enum class Align { kLeft, kMiddle, kRight };

struct TextStyle {
  double size = 7.0;  // points
  Color color = kInk;
  Align align = Align::kLeft;  // of the place along the text
  bool bold = false;
  bool upward = false;  // turned a quarter, to be read from the right
};

// Draws on a page in points (1/72 inch) from the top left, y down. Text is DejaVu Sans; any UTF-8
// is fine: broken bytes become U+FFFD, line breaks blanks, what the font lacks an empty box. Texts
// are outlines in an SVG, so that no name can be markup.
class Canvas {
 public:
  explicit Canvas(_cairo* context) : context_(context) {}

  void Line(const std::vector<Place>& points, const Color& color, double width,
            const std::vector<double>& dashes = {});
  void Fill(const std::vector<Place>& polygon, const Color& color);
  void Fill(const Area& area, const Color& color);
  void Frame(const Area& area, const Color& color, double width);
  void Dot(const Place& center, double radius, const Color& color);
  void Picture(const RgbaImage& image, const Area& area);  // stretched over the area

  // The place is on the base line.
  void Text(const std::string& text, const Place& place, const TextStyle& style = {});
  double TextWidth(const std::string& text, const TextStyle& style = {});
  // The text cut to this width with an ellipsis where it is longer.
  std::string Shortened(const std::string& text, double width, const TextStyle& style = {});

 private:
  void Select(const TextStyle& style);
  void Trace(const std::vector<Place>& points);

  _cairo* context_;
};

struct PageSize {
  double width = 0.0, height = 0.0;  // points
  double dpi = 300.0;                // of a PNG; an SVG's pictures keep the pixels they have
};

// Draws one page on white and writes it whole or not at all, by extension as SVG or PNG: the same
// bytes whenever and wherever the same is drawn with the same fonts. InputError for any other
// extension and for a PNG side above 30,000 pixels; RuntimeFailure when Cairo fails.
void WritePage(const std::filesystem::path& path, const PageSize& size,
               const std::function<void(Canvas*)>& draw);
// The InputErrors of WritePage before there is anything to draw.
void CheckPage(const std::filesystem::path& path, const PageSize& size);

// `text` with every byte that is no UTF-8 replaced by U+FFFD and every control character by a
// blank.
std::string Printable(const std::string& text);

}  // namespace antigrasp
