// antigrasp.ShapeSet, what makes and reads it, and the objects of files.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "antigrasp/core/error.h"
#include "antigrasp/datasets/objects.h"
#include "antigrasp/datasets/prior_set.h"
#include "antigrasp/python/arrays.h"
#include "antigrasp/python/errors.h"
#include "antigrasp/python/shapes_object.h"

namespace antigrasp::python {
namespace {

using Floats4 = py::array_t<float, py::array::c_style | py::array::forcecast>;

std::vector<std::string> Numbered(const std::string& kind, py::ssize_t count) {
  std::vector<std::string> names;
  for (py::ssize_t i = 0; i < count; ++i) {
    const std::string digits = std::to_string(i);
    names.push_back(kind + "-" + std::string(digits.size() < 6 ? 6 - digits.size() : 0, '0') +
                    digits);
  }
  return names;
}

ShapesObject MakeShapes(const py::object& values,
                        const std::optional<std::vector<std::string>>& names,
                        const std::string& kind, std::uint64_t seed, const std::string& provenance,
                        double truncation, double side) {
  const auto array = Floats4::ensure(values);
  const bool cubes = array && array.ndim() == 4 && array.shape(1) == array.shape(2) &&
                     array.shape(2) == array.shape(3) && array.shape(1) >= 2 &&
                     array.shape(1) <= 256 && array.shape(0) > 0;
  if (!cubes) {
    PyErr_Clear();
    throw InputError("values" + (array ? " of shape " + ShapeText(array) : std::string()),
                     "ShapeSet", "an array of shape (N, n, n, n), N above 0, n in [2, 256]");
  }
  ShapesObject shapes;
  shapes.about = {
      kind, seed, provenance, truncation, names.value_or(Numbered(kind, array.shape(0))), {}, side};
  if (std::ssize(shapes.about.names) != array.shape(0)) {
    throw InputError(std::to_string(shapes.about.names.size()) + " names", "ShapeSet",
                     "one a grid, " + std::to_string(array.shape(0)));
  }
  shapes.n = static_cast<int>(array.shape(1));
  shapes.values.assign(array.data(), array.data() + array.size());
  return shapes;
}

py::array_t<float> ShapeValues(const py::object& self) {
  const auto& shapes = self.cast<const ShapesObject&>();
  const py::ssize_t n = shapes.n, size = sizeof(float);
  return ViewOf(shapes.values.data(), {static_cast<py::ssize_t>(shapes.size()), n, n, n},
                {n * n * n * size, n * n * size, n * size, size}, self);
}

GridObject GridAt(const ShapesObject& self, py::ssize_t i) {
  const auto count = static_cast<py::ssize_t>(self.size());
  if (i < 0) i += count;
  if (i < 0 || i >= count) throw py::index_error("of " + std::to_string(count) + " shapes");
  const auto slot = static_cast<std::size_t>(i);
  const double side = self.about.side > 0.0 ? self.about.side : 1.0;
  return {self.about.names[slot], self.Grid(slot), side, Eigen::Vector3d::Zero()};
}

void SaveShapes(const ShapesObject& self, const std::filesystem::path& path) {
  ShapeSet about = self.about;
  about.names.clear();
  ShapeSetWriter writer(path, about, self.size());
  for (std::size_t i = 0; i < self.size(); ++i) writer.Add(self.about.names[i], self.Grid(i));
  writer.Commit();
}

ShapesObject MakePrior(const std::string& kind, int count, std::uint64_t seed, int resolution,
                       int grafts, int threads) {
  const auto require = [](bool holds, const std::string& what, const std::string& expected) {
    if (!holds) throw InputError(what, "datasets.make", expected);
  };
  const std::vector<std::string> kinds = PriorSetKinds();
  require(std::find(kinds.begin(), kinds.end(), kind) != kinds.end(), "kind = " + kind,
          Alternatives(kinds));
  require(count >= 1 && count <= 1'000'000, "count = " + std::to_string(count),
          "a whole number in [1, 1000000]");
  require(resolution >= 16 && resolution <= 256, "resolution = " + std::to_string(resolution),
          "a whole number in [16, 256]");
  require(grafts >= 0 && grafts <= 2, "grafts = " + std::to_string(grafts), "0, 1 or 2");
  const py::gil_scoped_release released;
  return ShapesOf(MakePriorSet({kind, count, seed, resolution, threads, grafts}, ListenToPython()));
}

std::vector<MeshPointer> ReadObjects(const std::vector<std::string>& paths, int threads) {
  std::vector<MeshPointer> meshes;
  const py::gil_scoped_release released;
  for (InputObject& object : LoadObjects(ObjectSource(paths), threads, ListenToPython())) {
    meshes.push_back(std::make_shared<MeshObject>(std::move(object)));
  }
  return meshes;
}

}  // namespace

void BindShapes(py::module_& module) {
  using Released = py::call_guard<py::gil_scoped_release>;
  py::class_<ShapesObject>(
      module, "ShapeSet",
      R"(Signed-distance grids of one size, as an SDF file holds them (docs/formats.md).

ShapeSet(values): an array (N, n, n, n) of float32, axes z, y, x, POSITIVE INSIDE, in sides of the
unit cube. names: one a grid; side: of the cube, in the unit of the meshes they came from, 0 where
there is none. set[i] is a Grid.)")
      .def(py::init(&MakeShapes), py::arg("values"), py::kw_only(), py::arg("names") = py::none(),
           py::arg("kind") = "import", py::arg("seed") = 0, py::arg("provenance") = "",
           py::arg("truncation") = 0.0, py::arg("side") = 0.0)
      .def("__len__", &ShapesObject::size)
      .def("__getitem__", &GridAt)
      .def_property_readonly("values", &ShapeValues, "array (N, n, n, n), read-only, no copy")
      .def_property_readonly("names", [](const ShapesObject& self) { return self.about.names; })
      .def_property_readonly("kind", [](const ShapesObject& self) { return self.about.kind; })
      .def_property_readonly("seed", [](const ShapesObject& self) { return self.about.seed; })
      .def_property_readonly("provenance",
                             [](const ShapesObject& self) { return self.about.provenance; })
      .def_property_readonly(
          "truncation", [](const ShapesObject& self) { return self.about.truncation; },
          "values are cut to +- this; 0: exact distances")
      .def_property_readonly("side", [](const ShapesObject& self) { return self.about.side; })
      .def(
          "meshes",
          [](const ShapesObject& self, int threads) {
            return MeshesOf(self, self.about.side > 0.0 ? self.about.side : 1.0, threads);
          },
          Released(), py::arg("threads") = 0,
          "A Mesh of every grid; what is no solid has a status that says why.")
      .def("save", &SaveShapes, Released(), py::arg("path"),
           "Writes .h5, .npy, .npz or .vti by extension: what the program reads.")
      .def("__repr__", [](const ShapesObject& self) {
        return "<antigrasp.ShapeSet: " + std::to_string(self.size()) + " " + self.about.kind +
               ", " + std::to_string(self.n) + "^3>";
      });
  module.def("make_shapes", &MakePrior, py::arg("kind"), py::arg("count"), py::arg("seed"),
             py::arg("resolution"), py::arg("grafts"), py::arg("threads"));
  module.def(
      "read_shapes", [](const std::filesystem::path& path) { return ShapesOf(ReadShapeSet(path)); },
      Released(), py::arg("path"));
  module.def("read_objects", &ReadObjects, py::arg("paths"), py::arg("threads"));
}

}  // namespace antigrasp::python
