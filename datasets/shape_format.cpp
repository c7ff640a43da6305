#include "antigrasp/datasets/shape_format.h"

#include <algorithm>
#include <fstream>
#include <string_view>

#include "antigrasp/core/file_kind.h"
#include "antigrasp/datasets/npy_header.h"

namespace antigrasp {
namespace {

bool BeginsAsXmlImage(std::string_view first) {
  return first.find("<VTKFile") != std::string_view::npos &&
         first.find("ImageData") != std::string_view::npos;
}

}  // namespace

ShapeFormat ShapeFormatByName(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  for (const Choice<ShapeFormat>& format : ChoicesOf(ShapeFormat{})) {
    if (extension == "." + std::string(format.name)) return format.value;
  }
  return ShapeFormat::kHdf5;
}

ShapeFormat ShapeFormatOf(const std::filesystem::path& path) {
  if (IsHdf5(path)) return ShapeFormat::kHdf5;
  const ShapeFormat by_name = ShapeFormatByName(path);
  std::error_code ignored;
  if (by_name != ShapeFormat::kHdf5 || !std::filesystem::is_regular_file(path, ignored)) {
    return by_name;
  }
  std::string first(1024, '\0');
  std::ifstream in(path, std::ios::binary);
  in.read(first.data(), static_cast<std::streamsize>(first.size()));
  first.resize(static_cast<std::size_t>(in.gcount()));
  if (first.starts_with(kNpyMagic)) return ShapeFormat::kNpy;
  return BeginsAsXmlImage(first) ? ShapeFormat::kVti : ShapeFormat::kHdf5;
}

std::string ShapeFileKinds() {
  return "SDF file (HDF5), or NumPy's .npy and .npz and VTK's .vti by their extension";
}

}  // namespace antigrasp
