#include "antigrasp/python/shapes_object.h"

#include <algorithm>

#include "antigrasp/python/errors.h"
#include "antigrasp/sdf/remesh.h"

namespace antigrasp::python {

SdfGrid ShapesObject::Grid(std::size_t i) const {
  SdfGrid grid = UnitCubeGrid(n);
  const std::size_t nodes = grid.values.size();
  std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(i * nodes), nodes, grid.values.begin());
  return grid;
}

ShapesObject ShapesOf(ShapeSet set) {
  ShapesObject shapes;
  shapes.n = set.grids.empty() ? 0 : set.grids.front().n;
  for (const SdfGrid& grid : set.grids) {
    shapes.values.insert(shapes.values.end(), grid.values.begin(), grid.values.end());
  }
  set.grids.clear();
  shapes.about = std::move(set);
  return shapes;
}

std::vector<MeshPointer> MeshesOf(const ShapesObject& shapes, double side, int threads) {
  std::vector<MeshPointer> meshes(shapes.size());
  ParallelFor(
      std::ssize(meshes), threads,
      [&](std::int64_t i) {
        const auto slot = static_cast<std::size_t>(i);
        RemeshResult result = Remesh(shapes.Grid(slot));
        InputObject object;
        object.name = shapes.about.names[slot];
        object.stream = StreamOf(object.name);
        object.status = Name(result.status);
        object.mesh = side == 1.0 ? std::move(result.mesh)
                                  : Transformed(result.mesh, side, Eigen::Vector3d::Zero());
        meshes[slot] = std::make_shared<MeshObject>(std::move(object));
      },
      ListenToPython());
  return meshes;
}

}  // namespace antigrasp::python
