#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "antigrasp/render/image.h"
#include "antigrasp/report/figures/canvas.h"
#include "tests/support/read_png.h"
#include "tests/support/temp_folder.h"

// Pages read back as pixels.
namespace antigrasp::pixels {

inline bool Near(const Rgb& p, const Color& c, int tolerance = 2) {
  const double want[] = {255.0 * c.r, 255.0 * c.g, 255.0 * c.b};
  for (std::size_t k = 0; k < 3; ++k) {
    if (std::abs(p[k] - want[k]) > tolerance) return false;
  }
  return true;
}

// Where in a part of the image pixels like this are; none: count 0.
struct Spot {
  int count = 0;
  int left = 1 << 30, top = 1 << 30, right = -1, bottom = -1;  // the last column and row within
};

template <typename Like>
Spot Find(const Image& image, const Area& part, const Like& like) {
  Spot spot;
  const int right = std::min(image.width, static_cast<int>(std::lround(part.Right())));
  const int bottom = std::min(image.height, static_cast<int>(std::lround(part.Bottom())));
  for (int y = std::max(0, static_cast<int>(std::lround(part.y))); y < bottom; ++y) {
    for (int x = std::max(0, static_cast<int>(std::lround(part.x))); x < right; ++x) {
      if (!like(image.At(x, y))) continue;
      ++spot.count;
      spot.left = std::min(spot.left, x);
      spot.right = std::max(spot.right, x);
      spot.top = std::min(spot.top, y);
      spot.bottom = std::max(spot.bottom, y);
    }
  }
  return spot;
}

inline Spot FindColor(const Image& image, const Area& part, const Color& color) {
  return Find(image, part, [&](const Rgb& p) { return Near(p, color); });
}

inline Spot FindInk(const Image& image, const Area& part) {
  return Find(image, part, [](const Rgb& p) { return p[0] < 200 || p[1] < 200 || p[2] < 200; });
}

inline Area Whole(const Image& image) {
  return {0.0, 0.0, static_cast<double>(image.width), static_cast<double>(image.height)};
}

// A page of this size in points at `scale` pixels a point.
inline Image Drawn(double width, double height, double scale,
                   const std::function<void(Canvas*)>& draw) {
  const shapes::TempFolder folder;
  WritePage(folder / "page.png", {width, height, 72.0 * scale}, draw);
  return ReadPng(folder / "page.png");
}

}  // namespace antigrasp::pixels
