#pragma once

#include <pybind11/pybind11.h>

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "antigrasp/datasets/objects.h"
#include "antigrasp/mesh/mesh_file.h"
#include "antigrasp/sdf/sdf_grid.h"

namespace antigrasp::python {

// antigrasp.Mesh: a mesh as it was given, which does not change, and what it is to everything that
// needs a solid, looked at once. Any thread may ask.
class MeshObject {
 public:
  MeshObject(std::string name, MeshFile file) : name_(std::move(name)), file_(std::move(file)) {}
  // One that was looked at already: of a grid, or a result. It is what it is.
  explicit MeshObject(InputObject looked_at);

  const std::string& name() const { return name_; }
  const TriangleMesh& mesh() const { return file_.mesh; }
  const MeshFile& file() const { return file_; }

  // After repair, with its status, note and stream of random draws: the object of this name that a
  // command reads. `into`: the unit to be in, of a file that knows its own.
  using Shared = std::shared_ptr<const InputObject>;
  Shared Usable(std::optional<LengthUnit> into = std::nullopt) const;
  // That mesh. InputError, naming the status, when it is no solid.
  Shared RequireUsable(std::optional<LengthUnit> into = std::nullopt) const;

 private:
  std::string name_;
  MeshFile file_;
  mutable std::mutex mutex_;
  mutable std::map<std::optional<LengthUnit>, Shared> usable_;
};
using MeshPointer = std::shared_ptr<MeshObject>;

// A mesh that a computation left, in the place of the one it was made of: not repaired again.
MeshPointer MeshOf(std::string name, TriangleMesh mesh);

// antigrasp.Grid: distances of the unit cube, and the cube's place in the frame of the mesh that
// they are of: side * (unit cube) + center.
struct GridObject {
  std::string name;
  SdfGrid grid;
  double side = 1.0;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
};

// The cube of n^3 nodes about the mesh's box, exact distances: what `dataset import --scale each`
// writes. InputError for a mesh that is no solid and for n out of [16, 256].
GridObject GridOfMesh(const MeshObject& mesh, int n);
// Where the cube lies. InputError, naming the status, for a grid that is no solid.
MeshPointer MeshOfGrid(const GridObject& grid);

void BindMesh(pybind11::module_& module);
void BindGrid(pybind11::module_& module);

}  // namespace antigrasp::python
