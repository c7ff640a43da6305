// antigrasp.evaluate, Score and Grasps.
#include <pybind11/stl.h>

#include <cmath>

#include "antigrasp/python/arrays.h"
#include "antigrasp/python/bindings.h"
#include "antigrasp/python/errors.h"
#include "antigrasp/python/scored_mesh.h"
#include "antigrasp/quality/object_size.h"

namespace antigrasp::python {
namespace {

// The grasps of a score, which they keep alive.
const std::vector<ScoredGrasp>& GraspsIn(const GraspsObject& self) {
  return self.scored->score.grasps;
}

// An array of a field of every grasp, where it lies.
template <typename T, typename Field>
py::array_t<T> OfGrasps(const py::object& self, const Field& field,
                        const std::vector<std::pair<py::ssize_t, py::ssize_t>>& more = {}) {
  const auto& grasps = GraspsIn(self.cast<const GraspsObject&>());
  std::vector<py::ssize_t> shape = {static_cast<py::ssize_t>(grasps.size())};
  std::vector<py::ssize_t> strides = {sizeof(ScoredGrasp)};
  for (const auto& [count, stride] : more) {
    shape.push_back(count);
    strides.push_back(stride);
  }
  return ViewOf<T>(grasps.empty() ? nullptr : field(grasps.front()), shape, strides, self);
}

constexpr std::pair<py::ssize_t, py::ssize_t> kXyz = {3, sizeof(double)};
constexpr std::pair<py::ssize_t, py::ssize_t> kBoth = {2, sizeof(Contact)};

// [N, 4, 4]: docs/grasps.md, object_from_grasp.
py::array_t<double> PosesOfGrasps(const GraspsObject& self) {
  const auto& grasps = GraspsIn(self);
  py::array_t<double> poses(
      {static_cast<py::ssize_t>(grasps.size()), py::ssize_t{4}, py::ssize_t{4}});
  auto at = poses.mutable_unchecked<3>();
  for (py::ssize_t i = 0; i < at.shape(0); ++i) {
    const Grasp& grasp = grasps[static_cast<std::size_t>(i)].grasp;
    const Eigen::Vector3d x = grasp.approach, y = grasp.axis, z = x.cross(y);
    for (py::ssize_t row = 0; row < 3; ++row) {
      at(i, row, 0) = x[row];
      at(i, row, 1) = y[row];
      at(i, row, 2) = z[row];
      at(i, row, 3) = grasp.center[row];
      at(i, 3, row) = 0.0;
    }
    at(i, 3, 3) = 1.0;
  }
  return poses;
}

void BindGrasps(py::module_& module) {
  py::class_<GraspsObject>(
      module, "Grasps",
      R"(The grasps that an object was scored on, as read-only arrays without a copy.

In METRES, in the frame of the mesh as the metric looks at it: divide lengths by metres_per_unit to
come to the mesh's unit. Nothing is moved or turned (docs/grasps.md).)")
      .def("__len__", [](const GraspsObject& self) { return GraspsIn(self).size(); })
      .def_property_readonly("metres_per_unit",
                             [](const GraspsObject& self) { return self.scored->score.scale; })
      .def_property_readonly(
          "contacts",
          [](const py::object& self) {
            return OfGrasps<double>(
                self, [](const ScoredGrasp& g) { return g.grasp.contacts[0].point.data(); },
                {kBoth, kXyz});
          },
          "array (N, 2, 3): the points, of jaw 1 and jaw 2")
      .def_property_readonly(
          "normals",
          [](const py::object& self) {
            return OfGrasps<double>(
                self, [](const ScoredGrasp& g) { return g.grasp.contacts[0].normal.data(); },
                {kBoth, kXyz});
          },
          "array (N, 2, 3): outward, there")
      .def_property_readonly(
          "centers",
          [](const py::object& self) {
            return OfGrasps<double>(
                self, [](const ScoredGrasp& g) { return g.grasp.center.data(); }, {kXyz});
          },
          "array (N, 3): midway between the contacts")
      .def_property_readonly(
          "axes",
          [](const py::object& self) {
            return OfGrasps<double>(self, [](const ScoredGrasp& g) { return g.grasp.axis.data(); },
                                    {kXyz});
          },
          "array (N, 3): unit, from contact 1 to contact 2")
      .def_property_readonly(
          "approaches",
          [](const py::object& self) {
            return OfGrasps<double>(
                self, [](const ScoredGrasp& g) { return g.grasp.approach.data(); }, {kXyz});
          },
          "array (N, 3): unit, from the palm to the fingertips; 0 where none was looked for")
      .def_property_readonly(
          "widths",
          [](const py::object& self) {
            return OfGrasps<double>(self, [](const ScoredGrasp& g) { return &g.grasp.width; });
          },
          "array (N,): between the contacts")
      .def_property_readonly(
          "qualities",
          [](const py::object& self) {
            return OfGrasps<double>(self, [](const ScoredGrasp& g) { return &g.quality; });
          },
          "array (N,): robust quality, the mean over the draws")
      .def_property_readonly(
          "draws",
          [](const py::object& self) {
            return OfGrasps<int>(self, [](const ScoredGrasp& g) { return &g.draws; });
          },
          "array (N,) of int32")
      .def_property_readonly(
          "candidates",
          [](const py::object& self) {
            return OfGrasps<std::uint64_t>(self, [](const ScoredGrasp& g) { return &g.candidate; });
          },
          "array (N,) of uint64: which of those tried")
      .def("poses", &PosesOfGrasps,
           "array (N, 4, 4): object_from_grasp, x the approach, y the axis, z = x cross y, metres")
      .def("__repr__", [](const GraspsObject& self) {
        return "<antigrasp.Grasps: " + std::to_string(GraspsIn(self).size()) + ">";
      });
}

py::dict RejectedOf(const ScoredObject& scored) {
  py::dict counts;
  for (const RejectedGrasps::Reason& reason : scored.score.rejected.reasons) {
    counts[py::str(reason.name)] = reason.count;
  }
  counts["copy"] = scored.score.rejected.copies;
  return counts;
}

void BindScore(py::module_& module) {
  py::class_<ScoredObject, std::shared_ptr<ScoredObject>>(
      module, "Score",
      "The graspability of one object: lower = harder to grasp. NaN where it is no solid.")
      .def_readonly("name", &ScoredObject::name)
      .def_readonly("status", &ScoredObject::status,
                    "ok, few_grasps, no_grasps (0), or why it is not usable (NaN)")
      .def_readonly("note", &ScoredObject::note, "what was repaired")
      .def_property_readonly("graspability", &ScoredObject::Value)
      .def_property_readonly(
          "interval",
          [](const ScoredObject& self) { return std::pair(self.score.ci_low, self.score.ci_high); },
          "(low, high): 95 %, over grasps")
      .def_property_readonly(
          "mean", [](const ScoredObject& self) { return self.score.mean; }, "robust quality")
      .def_property_readonly(
          "fraction_nonzero", [](const ScoredObject& self) { return self.score.fraction_nonzero; },
          "share of grasps with a quality above 0")
      .def_property_readonly(
          "attempts", [](const ScoredObject& self) { return self.score.attempts; },
          "candidate grasps tried")
      .def_property_readonly("rejected", &RejectedOf, "those that are no grasps, by reason")
      .def_property_readonly(
          "metres_per_unit", [](const ScoredObject& self) { return self.score.scale; },
          "of the mesh, as the metric rescales it")
      .def_property_readonly(
          "seconds", [](const ScoredObject& self) { return self.score.seconds; }, "wall time")
      .def_property_readonly(
          "egad", [](const ScoredObject& self) { return EgadScore(self.Value()); },
          "EGAD's 0 to 100 of this graspability; means it with Metric('egad')")
      .def_property_readonly(
          "grasps", [](const std::shared_ptr<ScoredObject>& self) { return GraspsObject{self}; })
      .def("__repr__", [](const ScoredObject& self) {
        return "<antigrasp.Score " + self.name + ": " + self.status + ", graspability " +
               std::string(py::repr(py::float_(self.Value()))) + ">";
      });
}

// What the program warns of and refuses. Not by a ScoredSet: what it looks up of known sets costs
// as much as a score on a few grasps.
void WarnOf(const std::vector<std::shared_ptr<ScoredObject>>& scores,
            const MetricOptions& options) {
  UnlikelySizes sizes(options);
  bool any = false;
  for (const std::string& text : UnlikelyLengths(options)) Warn(text);
  for (const auto& scored : scores) {
    sizes.Add(scored->name, scored->extent, &scored->score);
    any = any || !std::isnan(scored->Value());
    if (!scored->note.empty()) Warn(scored->name + ": " + scored->note);
  }
  for (const std::string& text : sizes.Texts()) Warn(text);
  if (any) return;
  throw InputError("no object scored; " + scores.front()->name + ": " + scores.front()->status,
                   "evaluate", "a closed solid");
}

std::vector<std::shared_ptr<ScoredObject>> Evaluate(const std::vector<MeshPointer>& meshes,
                                                    const MetricObject& metric, std::uint64_t seed,
                                                    int threads) {
  if (meshes.empty()) throw InputError("no object", "evaluate", "a mesh, or a list of some");
  const MetricOptions options = metric.OptionsFor(std::ssize(meshes));
  const auto into = UnitToReadIn(options);
  std::vector<std::shared_ptr<ScoredObject>> scores(meshes.size());
  {
    const py::gil_scoped_release released;
    ParallelFor(
        std::ssize(meshes), threads,
        [&](std::int64_t i) {
          const auto slot = static_cast<std::size_t>(i);
          const MeshObject::Shared object = meshes[slot]->Usable(into);
          scores[slot] = std::make_shared<ScoredObject>(ScoreObject(
              object->name, object->status, object->mesh, object->stream, options, seed));
          scores[slot]->note = object->note;
        },
        ListenToPython());
  }
  WarnOf(scores, options);
  return scores;
}

}  // namespace

void BindEvaluate(py::module_& module) {
  BindGrasps(module);
  BindScore(module);
  module.def("evaluate", &Evaluate, py::arg("meshes"), py::arg("metric"), py::arg("seed"),
             py::arg("threads"));
}

}  // namespace antigrasp::python
