#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace antigrasp {

using Rgb = std::array<std::uint8_t, 3>;
using Rgba = std::array<std::uint8_t, 4>;  // the last: 0 clear, 255 opaque; colours not multiplied

// Pixels row by row from the top left.
struct Image {
  Image() = default;
  Image(int width_, int height_, Rgb background = {255, 255, 255});
  Rgb& At(int x, int y) { return pixels[static_cast<std::size_t>(y * width + x)]; }
  const Rgb& At(int x, int y) const { return pixels[static_cast<std::size_t>(y * width + x)]; }

  int width = 0, height = 0;
  std::vector<Rgb> pixels;
};

// The same with opacity, all clear at first.
struct RgbaImage {
  RgbaImage() = default;
  RgbaImage(int width_, int height_);
  Rgba& At(int x, int y) { return pixels[static_cast<std::size_t>(y * width + x)]; }
  const Rgba& At(int x, int y) const { return pixels[static_cast<std::size_t>(y * width + x)]; }

  int width = 0, height = 0;
  std::vector<Rgba> pixels;
};

// Puts `tile` with its top left corner at (x, y); it must fit (CHECKed).
void Paste(const Image& tile, int x, int y, Image* image);

// Whole or not at all; the same bytes for the same image. At least one pixel (CHECKed).
void WritePng(const std::filesystem::path& path, const Image& image);

}  // namespace antigrasp
