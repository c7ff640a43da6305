// antigrasp.perturb: the algorithms of section IV, the searches, and polyhedra.
#include <pybind11/stl.h>

#include "antigrasp/perturb/antipodal_rotation.h"
#include "antigrasp/perturb/certificate.h"
#include "antigrasp/perturb/exhaustive.h"
#include "antigrasp/perturb/perturb_all.h"
#include "antigrasp/perturb/random_perturbation.h"
#include "antigrasp/perturb/search_choice.h"
#include "antigrasp/python/bindings.h"
#include "antigrasp/python/errors.h"
#include "antigrasp/python/python_judge.h"
#include "antigrasp/quality/object_size.h"

namespace antigrasp::python {
namespace {

// An object before and after, and its row of perturb.csv.
struct Perturbed {
  MeshPointer before, after;  // none where there is none
  PerturbRow row;
};

Perturbed PerturbedOf(const PerturbedObject& item) {
  Perturbed result{nullptr, nullptr, RowOf(item)};
  const std::string& name = item.object.name;
  if (!item.scored.before.faces.empty()) result.before = MeshOf(name, item.scored.before);
  if (item.Status() == "ok") result.after = MeshOf(name, item.scored.result.mesh);
  return result;
}

// The settings of one algorithm: its own options, those that the paper's three share, how finely
// meshes are divided first.
template <typename Options, typename Run>
PerturbSettings SettingsOf(const std::string& where, double subdivide, const py::dict& given,
                           Run run) {
  Options own;
  PerturbSettings settings;
  settings.subdivide.longest = subdivide;
  OptionTable table;
  Bind(&table, &own);
  Bind(&table, &settings.common);
  Bind(&table, &settings.subdivide);
  Keywords(given, table.options(), where).Apply(&table);
  settings.method = Bound(run, own);
  return settings;
}

// `judge`: a function of Python, or None.
PerturbSettings SearchSettings(const std::string& where, const py::dict& given,
                               const py::object& judge, const MetricOptions& metric,
                               std::uint64_t seed, int threads) {
  SearchChoice own;
  PerturbSettings settings;
  settings.subdivide.longest = 0.0;
  OptionTable table;
  Bind(&table, &own);
  Bind(&table, &settings.subdivide);
  const Keywords keywords(given, table.options(), where);
  keywords.Apply(&table);
  if (!judge.is_none()) own.objective = "a function";
  RequireUsed(own, [&](const std::string& key) { return keywords.Typed(key); });
  settings.metric = metric;
  settings.seed = seed;
  UseSearch(own, threads, &settings, judge.is_none() ? nullptr : JudgeOfFunction(judge));
  return settings;
}

PerturbSettings SettingsOfMethod(const std::string& method, const py::dict& given,
                                 const py::object& judge, const MetricOptions& metric,
                                 std::uint64_t seed, int threads) {
  const std::string where = "perturb." + method;
  if (method == "search") return SearchSettings(where, given, judge, metric, seed, threads);
  if (method == "random") {
    return SettingsOf<RandomPerturbOptions>(where, 0.0, given, PerturbRandomly);
  }
  if (method == "rotation") {
    return SettingsOf<RotationOptions>(where, kAsItIs, given, PerturbByRotation);
  }
  return SettingsOf<ExhaustiveOptions>(where, kAsItIs, given, PerturbExhaustively);
}

std::vector<Perturbed> Perturb(const std::string& method, const std::vector<MeshPointer>& meshes,
                               const py::object& judge, const MetricObject& metric,
                               std::uint64_t seed, int threads, const py::dict& given) {
  PerturbSettings settings =
      SettingsOfMethod(method, given, judge, metric.options(), seed, threads);
  settings.metric = metric.options();
  settings.seed = seed;
  RequireSubdivision(settings.subdivide, "perturb." + method);
  std::vector<Perturbed> results;
  {
    const py::gil_scoped_release released;
    std::vector<InputObject> inputs;
    for (const MeshPointer& mesh : meshes) {
      inputs.push_back(*mesh->Usable(UnitToReadIn(settings.metric)));
    }
    const auto stop = [] {
      ThrowIfPythonWasInterrupted();
      return false;
    };
    for (const PerturbedObject& item :
         PerturbAll(std::move(inputs), settings, threads, stop, ListenToPython())) {
      results.push_back(PerturbedOf(item));
    }
  }
  for (const MeshPointer& mesh : meshes) {
    const MeshObject::Shared object = mesh->Usable(UnitToReadIn(settings.metric));
    if (!object->note.empty()) Warn(object->name + ": " + object->note);
  }
  return results;
}

py::dict NumbersOfRow(const Perturbed& self) {
  py::dict numbers;
  for (const PerturbColumn& column : kPerturbColumns) {
    numbers[column.name] = self.row.*column.value;
  }
  if (self.row.judge.empty()) return numbers;
  numbers["judge_before"] = self.row.judge_before;
  numbers["judge_after"] = self.row.judge_after;
  return numbers;
}

double NumberOfRow(const Perturbed& self, const std::string& name) {
  const py::dict numbers = NumbersOfRow(self);
  if (numbers.contains(name)) return numbers[name.c_str()].cast<double>();
  throw py::attribute_error("Perturbed has no number " + name);
}

AdversarialPolyhedron Shape(const std::string& kind, double phi, double size_mm, std::uint64_t seed,
                            int threads, const py::kwargs& given) {
  const auto known = FindChoice<Polyhedron>(kind);
  if (!known) {
    throw InputError("no solid " + kind, "perturb.shape", Alternatives(ChoiceNames<Polyhedron>()));
  }
  PolyhedronOptions options;
  options.phi = phi;
  options.size = size_mm;
  options.seed = seed;
  OptionTable table;
  Bind(&table, &options);
  Keywords(given, table.options(), "perturb.shape").Apply(&table);
  const py::gil_scoped_release released;
  return RequestedPolyhedron(*known, options, threads, ListenToPython());
}

void BindShape(py::module_& module) {
  py::class_<AdversarialPolyhedron>(module, "Polyhedron",
                                    "A solid of which no two faces oppose each other well.")
      .def_property_readonly(
          "mesh", [](const AdversarialPolyhedron& self) { return MeshOf("polyhedron", self.mesh); },
          "millimetres: a Mesh")
      .def_property_readonly(
          "antipodality",
          [](const AdversarialPolyhedron& self) { return self.antipodality.degrees; },
          "the smallest angle between a face's normal and the reverse of another's, degrees")
      .def_readonly("largest_move", &AdversarialPolyhedron::largest_move,
                    "of a corner from the plain solid, a share of the size")
      .def_readonly("rms_move", &AdversarialPolyhedron::rms_move, "of all corners");
  module.def(
      "shape", &Shape, py::arg("kind"), py::arg("phi"), py::arg("size_mm") = 40.0, py::kw_only(),
      py::arg("seed") = 1, py::arg("threads") = 0,
      R"(A polyhedron that a gripper finds nothing to pinch on (docs/perturbation.md): a Polyhedron.

kind: cube, tetrahedron, octahedron, cuboctahedron, dodecahedron or icosahedron; phi: the smallest
antipodality angle of any two faces, degrees; size_mm: edge of the cube about the plain solid.
restarts, moves: of the search. The solid is the same for any number of threads.
InputError where phi is out of reach, with the best that was reached.)");
}

}  // namespace

void BindPerturb(py::module_& module) {
  py::class_<Perturbed>(
      module, "Perturbed",
      R"(An object before and after, with the numbers of perturb.csv as attributes.

faces, pairs and graspability, each _before and _after, difference, normal_max_deg, normal_mean_deg,
hausdorff_pct, chamfer_pct, volume_change_pct, center_of_mass_pct (percent of the diagonal, or of the
volume), iterations, moved, no_gain, refused; of a search on a judge judge_before and judge_after.
NaN where there is no such number (docs/formats.md).)")
      .def_property_readonly("name", [](const Perturbed& self) { return self.row.object; })
      .def_property_readonly(
          "status", [](const Perturbed& self) { return self.row.status; },
          "'ok', or why there is no result")
      .def_readonly("before", &Perturbed::before, "the input, subdivided; None of what is no solid")
      .def_readonly("mesh", &Perturbed::after, "the result, in its place; None unless ok")
      .def_property_readonly(
          "judge", [](const Perturbed& self) { return self.row.judge; },
          "who else scored; '' = nobody")
      .def("as_dict", &NumbersOfRow, "every number by name")
      .def("__getattr__", &NumberOfRow)
      .def("__repr__", [](const Perturbed& self) {
        return "<antigrasp.Perturbed " + self.row.object + ": " + self.row.status + ">";
      });
  module.def("perturb", &Perturb, py::arg("method"), py::arg("meshes"), py::arg("judge"),
             py::arg("metric"), py::arg("seed"), py::arg("threads"), py::arg("options"));
  BindShape(module);
}

}  // namespace antigrasp::python
