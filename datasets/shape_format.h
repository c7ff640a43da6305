#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "antigrasp/core/choice.h"

namespace antigrasp {

// Files of signed-distance grids (docs/formats.md): our own on HDF5, NumPy's array and archive,
// VTK's XML image data.
enum class ShapeFormat { kHdf5, kNpy, kNpz, kVti };
constexpr auto ChoicesOf(ShapeFormat) {  // extensions
  return std::to_array<Choice<ShapeFormat>>({{ShapeFormat::kHdf5, "h5"},
                                             {ShapeFormat::kNpy, "npy"},
                                             {ShapeFormat::kNpz, "npz"},
                                             {ShapeFormat::kVti, "vti"}});
}

// By extension, case does not matter; HDF5 with any other.
ShapeFormat ShapeFormatByName(const std::filesystem::path& path);
// By the first bytes, and by extension where they are of none of these.
ShapeFormat ShapeFormatOf(const std::filesystem::path& path);

// "SDF file (HDF5), NumPy array (.npy), ...", for help texts and messages.
std::string ShapeFileKinds();

}  // namespace antigrasp
