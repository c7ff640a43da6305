// antigrasp.evaluate_grasps and GraspScores.
#include <pybind11/stl.h>

#include <cmath>
#include <limits>

#include "antigrasp/python/arrays.h"
#include "antigrasp/python/bindings.h"
#include "antigrasp/python/scored_mesh.h"
#include "antigrasp/quality/given_grasps.h"
#include "antigrasp/quality/object_size.h"

namespace antigrasp::python {
namespace {

constexpr const char* kGivenName = "evaluate_grasps";
constexpr const char* kPosesExpected =
    "Grasps, an array (N, 4, 4) of poses, or (centers, axes) with arrays (N, 3)";

struct GivenScores {
  std::vector<GivenScore> scores;
};

std::vector<GivenGrasp> GivenOfGrasps(const GraspsObject& grasps) {
  std::vector<GivenGrasp> given;
  for (const ScoredGrasp& one : grasps.scored->score.grasps) {
    GivenGrasp grasp;
    grasp.frame = GraspFrame::kMetres;
    grasp.metres_per_unit = grasps.scored->score.scale;
    grasp.center = one.grasp.center;
    grasp.axis = one.grasp.axis;
    grasp.approach = one.grasp.approach;
    grasp.width = one.grasp.width;
    grasp.candidate = one.candidate;
    grasp.of_a_candidate = true;
    given.push_back(grasp);
  }
  return given;
}

// Rows are those of a table: the number of a row is that of its draws.
GivenGrasp GivenRow(py::ssize_t row) {
  GivenGrasp grasp;
  grasp.candidate = static_cast<std::uint64_t>(row);
  return grasp;
}

std::vector<GivenGrasp> GivenOfMatrices(const Doubles& poses) {
  const auto at = poses.unchecked<3>();
  std::vector<GivenGrasp> given;
  for (py::ssize_t i = 0; i < at.shape(0); ++i) {
    GivenGrasp grasp = GivenRow(i);
    for (py::ssize_t row = 0; row < 3; ++row) {
      grasp.approach[row] = at(i, row, 0);
      grasp.axis[row] = at(i, row, 1);
      grasp.center[row] = at(i, row, 3);
    }
    given.push_back(grasp);
  }
  return given;
}

Doubles RowsOfThree(const py::handle& array, const char* name) {
  const Doubles rows = NumbersOf(array, name, kGivenName, "an array (N, 3)");
  if (rows.ndim() == 2 && rows.shape(1) == 3) return rows;
  throw InputError(std::string(name) + " of shape " + ShapeText(rows), kGivenName,
                   "an array (N, 3)");
}

std::vector<GivenGrasp> GivenOfAxes(const py::sequence& pair) {
  const Doubles centers = RowsOfThree(pair[0], "centers"), axes = RowsOfThree(pair[1], "axes");
  if (centers.shape(0) != axes.shape(0)) {
    throw InputError(std::to_string(axes.shape(0)) + " axes", kGivenName,
                     "as many as centers, " + std::to_string(centers.shape(0)));
  }
  std::vector<GivenGrasp> given;
  for (py::ssize_t i = 0; i < centers.shape(0); ++i) {
    GivenGrasp grasp = GivenRow(i);
    grasp.center = {centers.at(i, 0), centers.at(i, 1), centers.at(i, 2)};
    grasp.axis = {axes.at(i, 0), axes.at(i, 1), axes.at(i, 2)};
    given.push_back(grasp);
  }
  return given;
}

std::vector<GivenGrasp> GivenOf(const py::object& poses) {
  if (py::isinstance<GraspsObject>(poses)) return GivenOfGrasps(poses.cast<GraspsObject>());
  if (py::isinstance<py::tuple>(poses) && py::len(poses) == 2) return GivenOfAxes(poses);
  const Doubles matrices = NumbersOf(poses, "poses", kGivenName, kPosesExpected);
  if (matrices.ndim() == 3 && matrices.shape(1) == 4 && matrices.shape(2) == 4) {
    return GivenOfMatrices(matrices);
  }
  throw InputError("poses of shape " + ShapeText(matrices), kGivenName, kPosesExpected);
}

void TakeWidths(const py::object& widths, std::vector<GivenGrasp>* given) {
  if (widths.is_none()) return;
  const Doubles numbers = NumbersOf(widths, "widths", kGivenName, "an array (N,)");
  if (numbers.ndim() != 1 || numbers.size() != std::ssize(*given)) {
    throw InputError("widths of shape " + ShapeText(numbers), kGivenName,
                     "an array (" + std::to_string(given->size()) + ",)");
  }
  for (std::size_t i = 0; i < given->size(); ++i) {
    (*given)[i].width = numbers.at(static_cast<py::ssize_t>(i));
  }
}

GivenScores EvaluateGiven(const MeshPointer& mesh, const py::object& poses,
                          const py::object& widths, bool metres, const MetricObject& metric,
                          std::uint64_t seed) {
  const MetricOptions& options = metric.options();
  std::vector<GivenGrasp> given = GivenOf(poses);
  TakeWidths(widths, &given);
  const py::gil_scoped_release released;
  const MeshObject::Shared object = mesh->RequireUsable(UnitToReadIn(options));
  if (metres) {
    const double scale = MetresPerUnit(options, Bounds(object->mesh).Extent());
    for (GivenGrasp& grasp : given) {
      grasp.frame = GraspFrame::kMetres;
      grasp.metres_per_unit = grasp.of_a_candidate ? grasp.metres_per_unit : scale;
    }
  }
  return {ScoreGivenGrasps(object->mesh, given, options, seed, object->stream)};
}

template <typename Field>
py::array_t<double> OfGiven(const GivenScores& self, const Field& field) {
  std::vector<double> values;
  for (const GivenScore& score : self.scores) {
    values.push_back(score.scored() ? field(score) : std::nan(""));
  }
  return ArrayOf(values);
}

std::vector<std::string> StatusesOf(const GivenScores& self) {
  std::vector<std::string> statuses;
  for (const GivenScore& score : self.scores) statuses.push_back(score.status);
  return statuses;
}

py::object ReachableOf(const GivenScores& self) {
  py::array_t<bool> reachable(static_cast<py::ssize_t>(self.scores.size()));
  for (std::size_t i = 0; i < self.scores.size(); ++i) {
    reachable.mutable_at(static_cast<py::ssize_t>(i)) = self.scores[i].reachable.value_or(false);
  }
  return reachable;
}

}  // namespace

void BindGivenGrasps(py::module_& module) {
  py::class_<GivenScores>(module, "GraspScores",
                          "What the metric says of given grasps, row by row.")
      .def("__len__", [](const GivenScores& self) { return self.scores.size(); })
      .def_property_readonly("statuses", &StatusesOf,
                             "ok, slips, starts inside, misses; not scored: too wide, no pose")
      .def_property_readonly(
          "epsilons",
          [](const GivenScores& self) {
            return OfGiven(self, [](const GivenScore& score) { return score.epsilon; });
          },
          "array (N,): as planned, without noise; NaN where not scored")
      .def_property_readonly(
          "qualities",
          [](const GivenScores& self) {
            return OfGiven(self, [](const GivenScore& score) { return score.robust_quality; });
          },
          "array (N,): robust quality, as of evaluate; NaN where not scored")
      .def_property_readonly(
          "widths",
          [](const GivenScores& self) {
            return OfGiven(self, [](const GivenScore& score) {
              return score.status == GivenScore::kOk ? score.grasp.width : std::nan("");
            });
          },
          "array (N,): between the contacts, metres; NaN unless ok")
      .def_property_readonly("reachable", &ReachableOf,
                             "array (N,) of bool: whether the gripper gets there; False where "
                             "nobody looked (Metric(collision='jaws'))");
  module.def("evaluate_grasps", &EvaluateGiven, py::arg("mesh"), py::arg("poses"),
             py::arg("widths"), py::arg("metres"), py::arg("metric"), py::arg("seed"));
}

}  // namespace antigrasp::python
