#include "antigrasp/report/figures/canvas.h"

#include <cairo.h>

#include <cstring>
#include <memory>
#include <numbers>

#include "antigrasp/core/check.h"

namespace antigrasp {
namespace {

constexpr const char* kFont = "DejaVu Sans";
constexpr const char* kEllipsis = "\u2026";

void SetColor(cairo_t* context, const Color& c) {
  cairo_set_source_rgba(context, c.r, c.g, c.b, c.a);
}

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;

// Cairo keeps colours multiplied by their opacity.
Surface SurfaceOf(const RgbaImage& image) {
  Surface surface(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, image.width, image.height),
                  &cairo_surface_destroy);
  cairo_surface_flush(surface.get());
  unsigned char* bytes = cairo_image_surface_get_data(surface.get());
  AG_CHECK(bytes != nullptr, "a picture with pixels");
  const int stride = cairo_image_surface_get_stride(surface.get());
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const Rgba& pixel = image.At(x, y);
      const std::uint32_t alpha = pixel[3];
      const auto times_alpha = [alpha](std::uint32_t value) { return (value * alpha + 127) / 255; };
      const std::uint32_t word = alpha << 24 | times_alpha(pixel[0]) << 16 |
                                 times_alpha(pixel[1]) << 8 | times_alpha(pixel[2]);
      std::memcpy(bytes + y * stride + 4 * x, &word, sizeof word);
    }
  }
  cairo_surface_mark_dirty(surface.get());
  return surface;
}

// Length of the UTF-8 character that begins here; 0 when none does (RFC 3629).
std::size_t CharacterAt(const std::string& text, std::size_t at) {
  const auto byte = [&](std::size_t k) {
    return at + k < text.size() ? static_cast<unsigned char>(text[at + k]) : 0u;
  };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xc2 && first < 0xe0   ? 2
                             : first >= 0xe0 && first < 0xf0 ? 3
                             : first >= 0xf0 && first < 0xf5 ? 4
                                                             : 0;
  for (std::size_t k = 1; k < length; ++k) {
    if ((byte(k) & 0xc0) != 0x80) return 0;
  }
  const bool overlong = (first == 0xe0 && byte(1) < 0xa0) || (first == 0xf0 && byte(1) < 0x90);
  const bool no_character =
      (first == 0xed && byte(1) >= 0xa0) || (first == 0xf4 && byte(1) >= 0x90);
  return overlong || no_character ? 0 : length;
}

}  // namespace

std::string Printable(const std::string& text) {
  std::string printable;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = CharacterAt(text, at);
    const auto first = static_cast<unsigned char>(text[at]);
    if (length == 0) {
      printable += "\uFFFD";
    } else if (first < 0x20 || first == 0x7f) {
      printable += ' ';
    } else {
      printable.append(text, at, length);
    }
    at += std::max<std::size_t>(length, 1);
  }
  return printable;
}

void Canvas::Trace(const std::vector<Place>& points) {
  cairo_new_path(context_);
  for (const Place& p : points) cairo_line_to(context_, p.x, p.y);
}

void Canvas::Line(const std::vector<Place>& points, const Color& color, double width,
                  const std::vector<double>& dashes) {
  Trace(points);
  SetColor(context_, color);
  cairo_set_line_width(context_, width);
  cairo_set_line_cap(context_, CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(context_, CAIRO_LINE_JOIN_ROUND);
  cairo_set_dash(context_, dashes.data(), static_cast<int>(dashes.size()), 0.0);
  cairo_stroke(context_);
}

void Canvas::Fill(const std::vector<Place>& polygon, const Color& color) {
  Trace(polygon);
  cairo_close_path(context_);
  SetColor(context_, color);
  cairo_fill(context_);
}

void Canvas::Fill(const Area& area, const Color& color) {
  cairo_rectangle(context_, area.x, area.y, area.width, area.height);
  SetColor(context_, color);
  cairo_fill(context_);
}

void Canvas::Frame(const Area& area, const Color& color, double width) {
  cairo_rectangle(context_, area.x, area.y, area.width, area.height);
  SetColor(context_, color);
  cairo_set_line_width(context_, width);
  cairo_set_line_join(context_, CAIRO_LINE_JOIN_MITER);
  cairo_set_dash(context_, nullptr, 0, 0.0);
  cairo_stroke(context_);
}

void Canvas::Dot(const Place& center, double radius, const Color& color) {
  cairo_new_path(context_);
  cairo_arc(context_, center.x, center.y, radius, 0.0, 2.0 * std::numbers::pi);
  SetColor(context_, color);
  cairo_fill(context_);
}

void Canvas::Picture(const RgbaImage& image, const Area& area) {
  if (image.width == 0 || image.height == 0) return;
  const Surface surface = SurfaceOf(image);
  cairo_save(context_);
  cairo_translate(context_, area.x, area.y);
  cairo_scale(context_, area.width / image.width, area.height / image.height);
  cairo_set_source_surface(context_, surface.get(), 0.0, 0.0);
  cairo_pattern_set_filter(cairo_get_source(context_), CAIRO_FILTER_GOOD);
  cairo_paint(context_);
  cairo_restore(context_);
}

void Canvas::Select(const TextStyle& style) {
  cairo_select_font_face(context_, kFont, CAIRO_FONT_SLANT_NORMAL,
                         style.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context_, style.size);
}

void Canvas::Text(const std::string& text, const Place& place, const TextStyle& style) {
  const double width = TextWidth(text, style);
  const double back = style.align == Align::kLeft     ? 0.0
                      : style.align == Align::kMiddle ? 0.5 * width
                                                      : width;
  SetColor(context_, style.color);
  cairo_save(context_);
  cairo_translate(context_, place.x, place.y);
  if (style.upward) cairo_rotate(context_, -0.5 * std::numbers::pi);
  cairo_move_to(context_, -back, 0.0);
  cairo_show_text(context_, Printable(text).c_str());
  cairo_restore(context_);
  cairo_new_path(context_);
}

double Canvas::TextWidth(const std::string& text, const TextStyle& style) {
  Select(style);
  cairo_text_extents_t extents;
  cairo_text_extents(context_, Printable(text).c_str(), &extents);
  return extents.x_advance;
}

std::string Canvas::Shortened(const std::string& text, double width, const TextStyle& style) {
  const std::string whole = Printable(text);
  if (TextWidth(whole, style) <= width) return whole;
  std::string kept;
  for (std::size_t at = 0; at < whole.size();) {
    const std::string longer = kept + whole.substr(at, CharacterAt(whole, at));
    if (TextWidth(longer + kEllipsis, style) > width) break;
    at += longer.size() - kept.size();
    kept = longer;
  }
  return kept + kEllipsis;
}

}  // namespace antigrasp
