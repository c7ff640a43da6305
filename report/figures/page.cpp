#include <cairo-svg.h>
#include <cairo.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <memory>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/report/figures/canvas.h"

namespace antigrasp {
namespace {

constexpr double kLongestSide = 30000.0;  // pixels; Cairo's own limit is 32,767
constexpr double kPointsPerInch = 72.0;

std::string Extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

void CheckStatus(cairo_status_t status, const std::filesystem::path& path) {
  if (status == CAIRO_STATUS_SUCCESS) return;
  throw RuntimeFailure("cannot draw " + path.string() + ": " + cairo_status_to_string(status));
}

cairo_status_t Append(void* bytes, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

// Cairo numbers its surfaces through the life of the process, and the numbers become names in the
// SVG. Numbers them anew in the order in which they appear, so that the bytes depend on the drawing
// alone. Text is outlines: nothing but names matches.
std::string Renumbered(const std::string& svg) {
  std::string out;
  std::map<std::string, std::size_t> numbers;
  for (std::size_t at = 0; at < svg.size();) {
    const bool begins = at > 0 && (svg[at - 1] == '"' || svg[at - 1] == '#');
    std::size_t word = at;
    while (begins && word < svg.size() && std::islower(static_cast<unsigned char>(svg[word]))) {
      ++word;
    }
    std::size_t end = word;
    while (word > at && end < svg.size() && std::isdigit(static_cast<unsigned char>(svg[end]))) {
      ++end;
    }
    if (end == word || end >= svg.size() || (svg[end] != '"' && svg[end] != ')')) {
      out += svg[at++];
      continue;
    }
    const std::size_t number =
        numbers.try_emplace(svg.substr(at, end - at), numbers.size() + 1).first->second;
    out += svg.substr(at, word - at) + std::to_string(number);
    at = end;
  }
  return out;
}

void DrawPage(cairo_surface_t* surface, const PageSize& size, double scale,
              const std::filesystem::path& path, const std::function<void(Canvas*)>& draw) {
  const std::unique_ptr<cairo_t, decltype(&cairo_destroy)> context(cairo_create(surface),
                                                                   &cairo_destroy);
  // Outlines as the font has them, whatever the desktop's settings and the resolution are.
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(context.get(), options);
  cairo_font_options_destroy(options);
  cairo_scale(context.get(), scale, scale);
  Canvas canvas(context.get());
  // Beyond the page, too: a PNG's last pixels may hang over.
  canvas.Fill(Area{-1.0, -1.0, size.width + 2.0, size.height + 2.0}, {1.0, 1.0, 1.0});
  draw(&canvas);
  CheckStatus(cairo_status(context.get()), path);
}

}  // namespace

void CheckPage(const std::filesystem::path& path, const PageSize& size) {
  const std::string extension = Extension(path);
  if (extension != ".svg" && extension != ".png") {
    throw InputError("unknown kind of picture", path.string(), "a name that ends in .svg or .png");
  }
  const double longest = std::max(size.width, size.height) * size.dpi / kPointsPerInch;
  if (extension == ".png" && longest > kLongestSide) {
    throw InputError("a picture " + std::to_string(std::lround(longest)) + " pixels long",
                     path.string(), "at most 30000 pixels a side");
  }
}

void WritePage(const std::filesystem::path& path, const PageSize& size,
               const std::function<void(Canvas*)>& draw) {
  CheckPage(path, size);
  std::string bytes;
  using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
  if (Extension(path) == ".svg") {
    const Surface surface(
        cairo_svg_surface_create_for_stream(&Append, &bytes, size.width, size.height),
        &cairo_surface_destroy);
    DrawPage(surface.get(), size, 1.0, path, draw);
    cairo_surface_finish(surface.get());
    CheckStatus(cairo_surface_status(surface.get()), path);
    bytes = Renumbered(bytes);
  } else {
    const double scale = size.dpi / kPointsPerInch;
    const double width = std::ceil(size.width * scale), height = std::ceil(size.height * scale);
    const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(width),
                                                     static_cast<int>(height)),
                          &cairo_surface_destroy);
    DrawPage(surface.get(), size, scale, path, draw);
    CheckStatus(cairo_surface_write_to_png_stream(surface.get(), &Append, &bytes), path);
  }
  WriteFileAtomic(path, bytes);
}

}  // namespace antigrasp
