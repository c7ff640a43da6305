#include "tests/support/read_png.h"

#include <png.h>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"

namespace antigrasp {

Image ReadPng(const std::filesystem::path& path) {
  const std::string bytes = ReadFile(path);
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  Image image;
  if (png_image_begin_read_from_memory(&png, bytes.data(), bytes.size())) {
    png.format = PNG_FORMAT_RGB;
    image = Image(static_cast<int>(png.width), static_cast<int>(png.height));
    const png_color white{255, 255, 255};
    if (png_image_finish_read(&png, &white, image.pixels.data(), 0, nullptr)) return image;
  }
  throw InputError(path.string(), png.message, "a PNG image");
}

}  // namespace antigrasp
