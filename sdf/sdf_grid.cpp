#include "antigrasp/sdf/sdf_grid.h"

#include "antigrasp/core/check.h"

namespace antigrasp {

SdfGrid UnitCubeGrid(int n) {
  AG_CHECK(n > 0, "a grid needs at least one node a side");
  SdfGrid grid;
  grid.n = n;
  grid.spacing = 1.0 / n;
  grid.origin = Eigen::Vector3d::Constant(-0.5 + 0.5 / n);
  const auto side = static_cast<std::size_t>(n);
  grid.values.assign(side * side * side, 0.0F);
  return grid;
}

}  // namespace antigrasp
