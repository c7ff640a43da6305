// antigrasp.compare.
#include <pybind11/stl.h>

#include "antigrasp/core/error.h"
#include "antigrasp/datasets/compared_set.h"
#include "antigrasp/datasets/comparison_table.h"
#include "antigrasp/python/errors.h"
#include "antigrasp/python/shapes_object.h"

namespace antigrasp::python {
namespace {

namespace py = pybind11;

constexpr const char* kCompareName = "compare";

struct Comparison {
  ComparisonTable table;
};

// A file or folder as the program reads it, a ShapeSet in its unit cube, or meshes.
ComparedSet SetOf(const py::object& given, const std::string& what, LengthUnit units, int threads) {
  if (py::isinstance<py::str>(given)) {
    const std::string path = given.cast<std::string>();
    const py::gil_scoped_release released;
    return ReadComparedSet(path, units, threads, ListenToPython());
  }
  std::vector<MeshPointer> meshes;
  if (py::isinstance<ShapesObject>(given)) {
    const auto& shapes = given.cast<const ShapesObject&>();
    const py::gil_scoped_release released;
    meshes = MeshesOf(shapes, 1.0, threads);
  } else {
    meshes = given.cast<std::vector<MeshPointer>>();
  }
  const py::gil_scoped_release released;
  std::vector<InputObject> objects(meshes.size());
  ParallelFor(
      std::ssize(meshes), threads,
      [&](std::int64_t i) {
        const auto slot = static_cast<std::size_t>(i);
        objects[slot] = *meshes[slot]->Usable(units);
      },
      ListenToPython());
  return ComparedSetOf(what, std::move(objects), units);
}

struct Limits {
  int count;
  SurfaceComparisonOptions options;
};

void RequireLimits(const Limits& limits) {
  const auto require = [](bool holds, const std::string& what, const std::string& expected) {
    if (!holds) throw InputError(what, kCompareName, expected);
  };
  require(limits.count >= 2 && limits.count <= 5000, "count = " + std::to_string(limits.count),
          "a whole number in [2, 5000]");
  require(limits.options.points >= 1 && limits.options.points <= 65536,
          "points = " + std::to_string(limits.options.points), "a whole number in [1, 65536]");
  require(limits.options.normals >= 0.0 && limits.options.normals <= 100.0,
          "normals = " + std::to_string(limits.options.normals), "a number in [0, 100]");
}

Comparison Compare(const py::object& samples_given, const py::object& reference_given,
                   const py::object& training_given, const std::string& units, int count,
                   int points, double normals, std::uint64_t seed, int threads) {
  const auto unit = FindChoice<LengthUnit>(units);
  if (!unit) {
    throw InputError("units = " + units, kCompareName, Alternatives(ChoiceNames<LengthUnit>()));
  }
  const Limits limits{count, {points, normals, seed, threads}};
  RequireLimits(limits);
  ComparedSet samples = SetOf(samples_given, "samples", *unit, threads);
  RequireShapes(samples, 2);
  ComparedSet reference = SetOf(reference_given, "reference", *unit, threads);
  RequireShapes(reference, 2);
  ComparedSet training;
  if (!training_given.is_none()) {
    training = SetOf(training_given, "training", *unit, threads);
    RequireShapes(training, 1);
  }
  std::optional<Comparison> result;
  std::vector<std::string> doubts;
  {
    const py::gil_scoped_release released;
    const std::size_t kept = KeepAsMany(count, seed, &samples, &reference);
    const SurfaceComparison found =
        CompareSurfaces(samples.meshes, reference.meshes, training.meshes, limits.options,
                        [](const std::string&) { return ListenToPython(); },
                        {samples.streams, reference.streams, training.streams});
    result.emplace(ComparisonTable(found, kept, samples.left_out, reference.left_out));
    doubts = DoubtsOf(found);
  }
  for (const std::string& doubt : doubts) Warn(doubt);
  return *std::move(result);
}

py::tuple NumbersOfMeasure(const Comparison& self, const std::string& measure) {
  for (const ComparisonTable::Row& row : self.table.rows()) {
    if (row.name == measure) return py::make_tuple(row.samples, row.reference);
  }
  throw py::key_error(measure);
}

}  // namespace

void BindCompare(py::module_& module) {
  py::class_<Comparison>(module, "Comparison",
                         "Two sets of shapes measured against each other (docs/similarity.md).\n\n"
                         "comparison[measure] is (samples, reference), NaN where there is no such\n"
                         "number: the rows of the file that `antigrasp compare --out` writes.")
      .def("__getitem__", &NumbersOfMeasure)
      .def(
          "as_dict",
          [](const Comparison& self) {
            py::dict all;
            for (const ComparisonTable::Row& row : self.table.rows()) {
              all[row.name] = py::make_tuple(row.samples, row.reference);
            }
            return all;
          },
          "{measure: (samples, reference)}, all of them")
      .def("__str__", [](const Comparison& self) { return self.table.Text(); });
  module.def("compare", &Compare, py::arg("samples"), py::arg("reference"), py::arg("training"),
             py::arg("units"), py::arg("count"), py::arg("points"), py::arg("normals"),
             py::arg("seed"), py::arg("threads"));
}

}  // namespace antigrasp::python
