#include "antigrasp/export/print_place.h"

namespace antigrasp {

PlacedSolid PlaceForPrint(const std::string& name, const std::string& file,
                          const TriangleMesh& mesh, double size_mm, ExportPose pose,
                          const PrintOptions& options) {
  PlacedSolid placed{{name, file, CheckPrint(mesh, size_mm, options)}, "", {}};
  const PrintCheck& check = placed.printed.check;
  placed.refusal = check.why_not_solid;
  if (!placed.refusal.empty()) return placed;
  const Eigen::Matrix3d turn =
      pose == ExportPose::kPrint ? check.table_from_object : Eigen::Matrix3d::Identity();
  placed.mesh = PlacedForPrint(mesh, check, turn);
  return placed;
}

}  // namespace antigrasp
