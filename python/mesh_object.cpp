#include "antigrasp/python/mesh_object.h"

#include "antigrasp/core/error.h"
#include "antigrasp/datasets/mesh_object.h"
#include "antigrasp/sdf/mesh_to_sdf.h"
#include "antigrasp/sdf/remesh.h"

namespace antigrasp::python {

MeshObject::MeshObject(InputObject looked_at)
    : name_(looked_at.name), file_{looked_at.mesh, std::nullopt, {}} {
  usable_[std::nullopt] = std::make_shared<const InputObject>(std::move(looked_at));
}

MeshObject::Shared MeshObject::Usable(std::optional<LengthUnit> into) const {
  if (!file_.unit) into.reset();
  const std::lock_guard lock(mutex_);
  Shared& known = usable_[into];
  if (known) return known;
  InputObject object = ObjectOf(file_, into);
  object.name = name_;
  object.stream = StreamOf(name_);
  known = std::make_shared<const InputObject>(std::move(object));
  return known;
}

MeshObject::Shared MeshObject::RequireUsable(std::optional<LengthUnit> into) const {
  Shared object = Usable(into);
  if (object->ok()) return object;
  throw InputError(object->status, name_, "a closed solid");
}

MeshPointer MeshOf(std::string name, TriangleMesh mesh) {
  InputObject object;
  object.stream = StreamOf(name);
  object.name = std::move(name);
  object.mesh = std::move(mesh);
  object.status = "ok";
  return std::make_shared<MeshObject>(std::move(object));
}

GridObject GridOfMesh(const MeshObject& mesh, int n) {
  if (n < 16 || n > 256) {
    throw InputError("n = " + std::to_string(n), "sdf", "a whole number in [16, 256]");
  }
  const MeshObject::Shared object = mesh.RequireUsable();
  const BoundingBox box = Bounds(object->mesh);
  const double room = (n - 2.0 * kFreeCells) / n, scale = room / box.Extent().maxCoeff();
  GridObject result{mesh.name(), UnitCubeGrid(n), 1.0 / scale, box.Center()};
  MeshToSdf(Transformed(object->mesh, scale, -scale * box.Center()), &result.grid);
  return result;
}

MeshPointer MeshOfGrid(const GridObject& grid) {
  RemeshResult result = Remesh(grid.grid);
  if (!result.ok()) {
    throw InputError(std::string(Name(result.status)), grid.name,
                     "a grid whose surface is one closed solid");
  }
  return MeshOf(grid.name, Transformed(result.mesh, grid.side, grid.center));
}

}  // namespace antigrasp::python
