#include "antigrasp/mesh/fit.h"

#include "antigrasp/core/check.h"

namespace antigrasp {

TriangleMesh FitToPlate(const TriangleMesh& mesh, double extent) {
  const BoundingBox box = Bounds(mesh);
  const double largest = box.Extent().maxCoeff();
  AG_CHECK(largest > 0.0, "a mesh with a positive extent");
  const double scale = extent / largest;
  const Eigen::Vector3d stand(box.Center().x(), box.Center().y(), box.min.z());
  return Transformed(mesh, scale, -scale * stand);
}

}  // namespace antigrasp
