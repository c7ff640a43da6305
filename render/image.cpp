#include "antigrasp/render/image.h"

#include <png.h>

#include <algorithm>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/check.h"
#include "antigrasp/core/error.h"

namespace antigrasp {

Image::Image(int width_, int height_, Rgb background)
    : width(width_),
      height(height_),
      pixels(static_cast<std::size_t>(width_ * height_), background) {
  AG_CHECK(width_ >= 0 && height_ >= 0, "an image has a size");
}

RgbaImage::RgbaImage(int width_, int height_)
    : width(width_), height(height_), pixels(static_cast<std::size_t>(width_ * height_)) {
  AG_CHECK(width_ >= 0 && height_ >= 0, "an image has a size");
}

void Paste(const Image& tile, int x, int y, Image* image) {
  AG_CHECK(x >= 0 && y >= 0 && x + tile.width <= image->width && y + tile.height <= image->height,
           "a tile inside the image");
  for (int row = 0; row < tile.height; ++row) {
    std::copy_n(&tile.At(0, row), tile.width, &image->At(x, y + row));
  }
}

void WritePng(const std::filesystem::path& path, const Image& image) {
  AG_CHECK(image.width > 0 && image.height > 0, "an image with pixels");
  AtomicFile file(path);
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width);
  png.height = static_cast<png_uint_32>(image.height);
  png.format = PNG_FORMAT_RGB;
  if (!png_image_write_to_file(&png, file.temp_path().c_str(), 0, image.pixels.data(), 0,
                               nullptr)) {
    throw RuntimeFailure("cannot write " + path.string() + ": " + png.message);
  }
  file.Commit();
}

}  // namespace antigrasp
