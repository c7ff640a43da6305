// antigrasp.Grid.
#include <pybind11/stl.h>

#include <cmath>

#include "antigrasp/core/error.h"
#include "antigrasp/python/arrays.h"
#include "antigrasp/python/mesh_object.h"
#include "antigrasp/sdf/remesh.h"

namespace antigrasp::python {
namespace {

using Floats = py::array_t<float, py::array::c_style | py::array::forcecast>;

GridObject MakeGrid(const py::object& values, double side, const py::object& center,
                    const std::string& name) {
  const auto array = Floats::ensure(values);
  const bool cube = array && array.ndim() == 3 && array.shape(0) == array.shape(1) &&
                    array.shape(1) == array.shape(2) && array.shape(0) >= 2 &&
                    array.shape(0) <= 256;
  if (!cube) {
    PyErr_Clear();
    throw InputError("values" + (array ? " of shape " + ShapeText(array) : std::string()), name,
                     "an array of shape (n, n, n), z y x, n in [2, 256]");
  }
  if (!(side > 0.0) || !std::isfinite(side)) {
    throw InputError("side = " + std::string(py::repr(py::float_(side))), name, "a length above 0");
  }
  GridObject grid{name, UnitCubeGrid(static_cast<int>(array.shape(0))), side,
                  Eigen::Vector3d::Zero()};
  grid.grid.values.assign(array.data(), array.data() + array.size());
  if (center.is_none()) return grid;
  const Doubles place = NumbersOf(center, "center", name, "three numbers");
  if (place.ndim() != 1 || place.shape(0) != 3) {
    throw InputError("center of shape " + ShapeText(place), name, "three numbers");
  }
  grid.center = {place.at(0), place.at(1), place.at(2)};
  return grid;
}

py::array_t<float> GridValues(const py::object& self) {
  const auto& grid = self.cast<const GridObject&>().grid;
  const py::ssize_t n = grid.n, size = sizeof(float);
  return ViewOf(grid.values.data(), {n, n, n}, {n * n * size, n * size, size}, self);
}

}  // namespace

void BindGrid(py::module_& module) {
  using Released = py::call_guard<py::gil_scoped_release>;
  py::class_<GridObject>(
      module, "Grid",
      R"(Signed distances on a cubic grid, POSITIVE INSIDE, as SDF files hold them.

values: array (n, n, n) of float32, axes z, y, x, in sides of the cube; nodes lie in the middle of
its n^3 cells. side: of the cube, in the unit of the mesh; center: array (3,), of the cube in the
frame of the mesh. Grid(values, side=1.0, center=(0, 0, 0), name="grid") makes one.)")
      .def(py::init(&MakeGrid), py::arg("values"), py::arg("side") = 1.0,
           py::arg("center") = py::none(), py::arg("name") = "grid")
      .def_readonly("name", &GridObject::name)
      .def_property_readonly("values", &GridValues, "array (n, n, n), read-only, no copy")
      .def_readonly("side", &GridObject::side, "of the cube, in the unit of the mesh")
      .def_property_readonly(
          "center", [](const GridObject& self) { return ArrayOf(self.center); }, "array (3,)")
      .def_property_readonly(
          "spacing", [](const GridObject& self) { return self.side * self.grid.spacing; },
          "between nodes, in the unit of the mesh")
      .def_property_readonly(
          "status",
          [](const GridObject& self) {
            const py::gil_scoped_release released;
            return std::string(Name(Remesh(self.grid).status));
          },
          "'ok', or why its surface is no solid (docs/repair.md)")
      .def("remesh", &MeshOfGrid, Released(),
           "The surface by marching cubes, in the mesh's frame: a Mesh.\n"
           "InputError, naming the status, when it is no closed solid in one piece.")
      .def("__repr__", [](const GridObject& self) {
        const std::string n = std::to_string(self.grid.n);
        return "<antigrasp.Grid " + self.name + ": " + n + "^3>";
      });
}

}  // namespace antigrasp::python
