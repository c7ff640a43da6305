#include "antigrasp/export/overhang.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "antigrasp/export/rounding.h"

namespace antigrasp {

Overhang MeasureOverhang(const TriangleMesh& mesh, const Eigen::Vector3d& up, double angle,
                         double layer, double rounding) {
  std::vector<double> height;
  height.reserve(mesh.vertices.size());
  double plate = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& v : mesh.vertices) {
    height.push_back(up.dot(v));
    plate = std::min(plate, height.back());
  }
  const double limit = std::sin(angle * std::numbers::pi / 180.0);
  const double first_layer = layer + LengthSlack(layer, rounding);
  double area = 0.0, hanging = 0.0, contact = 0.0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Eigen::Vector3d cross = FaceCross(mesh, f);
    const double twice_area = cross.norm();
    area += twice_area;
    const double down = -up.dot(cross);
    if (down <= limit * twice_area) continue;
    if (down <= (limit + AngleSlack(mesh, f, rounding)) * twice_area) continue;
    double top = plate;
    for (const std::int32_t v : mesh.faces[f]) {
      top = std::max(top, height[static_cast<std::size_t>(v)]);
    }
    (top - plate <= first_layer ? contact : hanging) += twice_area;
  }
  return {area > 0.0 ? hanging / area : 0.0, 0.5 * contact};
}

}  // namespace antigrasp
