#include "antigrasp/mesh/pose_table.h"

#include <cstdint>

#include "antigrasp/mesh/convex_hull.h"

namespace antigrasp {

std::vector<StablePose> StablePosesOf(const TriangleMesh& mesh, bool is_solid) {
  if (is_solid) return StablePoses(mesh, CenterOfMass(mesh));
  return StablePoses(mesh, CenterOfMass(ConvexHull(mesh.vertices)));
}

PoseTable::PoseTable(LengthUnit units)
    : units_(units),
      csv_({"object", "pose", "probability", "com_height", "r00", "r01", "r02", "r10", "r11", "r12",
            "r20", "r21", "r22"}) {}

void PoseTable::Add(const std::string& object, const std::vector<StablePose>& poses) {
  for (std::size_t i = 0; i < poses.size(); ++i) {
    csv_.Text(object).Count(static_cast<std::int64_t>(i));
    csv_.Numbers({poses[i].probability, MetresPer(units_) * poses[i].com_height});
    for (const double value : poses[i].table_from_object.reshaped<Eigen::RowMajor>()) {
      csv_.Number(value);
    }
    csv_.EndRow();
  }
}

}  // namespace antigrasp
