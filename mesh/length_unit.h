#pragma once

#include <array>
#include <string>

#include "antigrasp/core/choice.h"

namespace antigrasp {

// What the coordinates of a mesh are in; of the formats that are read only 3MF, GLB and COLLADA say
// so. An SDF file's unit is that of the meshes which it was imported from, else the side of its
// cube.
enum class LengthUnit { kMm, kCm, kM, kIn };
constexpr auto ChoicesOf(LengthUnit) {
  return std::to_array<Choice<LengthUnit>>({{LengthUnit::kMm, "mm"},
                                            {LengthUnit::kCm, "cm"},
                                            {LengthUnit::kM, "m"},
                                            {LengthUnit::kIn, "in"}});
}

constexpr double MetresPer(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::kMm:
      return 0.001;
    case LengthUnit::kCm:
      return 0.01;
    case LengthUnit::kM:
      return 1.0;
    case LengthUnit::kIn:
      return 0.0254;
  }
  return 1.0;
}

// What a file says that its coordinates are in, a foot and a micron included.
struct FileUnit {
  std::string name;  // as in LengthUnit, where it is one
  double metres = 1.0;
};

}  // namespace antigrasp
