#pragma once

#include <array>
#include <string>

#include "antigrasp/core/choice.h"
#include "antigrasp/export/print_table.h"

namespace antigrasp {

// How an object stands in the file to print: in its own axes, or as CheckPrint suggests.
enum class ExportPose { kAsIs, kPrint };
constexpr auto ChoicesOf(ExportPose) {
  return std::to_array<Choice<ExportPose>>(
      {{ExportPose::kAsIs, "as-is"}, {ExportPose::kPrint, "print"}});
}

// A printable solid, placed as it is to be written; else why it is none.
struct PlacedSolid {
  PrintedObject printed;
  std::string refusal;
  TriangleMesh mesh;
};
PlacedSolid PlaceForPrint(const std::string& name, const std::string& file,
                          const TriangleMesh& mesh, double size_mm, ExportPose pose,
                          const PrintOptions& options);

}  // namespace antigrasp
