// antigrasp.trial: grasps executed in physics.
#include <pybind11/stl.h>

#include "antigrasp/core/ordered_stream.h"
#include "antigrasp/python/arrays.h"
#include "antigrasp/python/bindings.h"
#include "antigrasp/python/errors.h"
#include "antigrasp/quality/object_size.h"
#include "antigrasp/trial/trial_options.h"
#include "antigrasp/trial/trial_summary.h"

namespace antigrasp::python {
namespace {

constexpr const char* kTrialName = "trial";

struct Tried {
  TrialSummary summary;
  PhysicsTrial trial;
  Protocol protocol;
};

struct AskedTrial {
  PhysicsTrialOptions options;
  MetricOptions metric;
};

AskedTrial Asked(const std::string& name, const MetricObject& metric, const py::dict& given) {
  const auto known = FindChoice<ProtocolName>(name);
  if (!known) {
    throw InputError("no protocol " + name, kTrialName, Alternatives(ChoiceNames<ProtocolName>()));
  }
  PhysicsTrialOptions defaults;
  OptionTable table;
  Bind(&table, &defaults);
  const Keywords keywords(given, table.options(), kTrialName);
  const TypedTrial typed = {[&](OptionTable* options) { keywords.Apply(options); },
                            [&](const std::string& key) { return keywords.Typed(key); },
                            metric.friction_given()};
  AskedTrial asked{{}, metric.options()};
  const Protocol protocol = ProtocolOf(*known);
  asked.options = TrialOptionsOf(protocol, typed, &asked.metric);
  RequireOptionsUsed(protocol, asked.options.physics.tip.shape, typed);
  return asked;
}

Tried TryOne(const MeshObject& mesh, const AskedTrial& asked, std::uint64_t seed, int threads) {
  Tried tried;
  tried.protocol = ProtocolOf(asked.options.protocol);
  const MeshObject::Shared object = mesh.Usable(UnitToReadIn(asked.metric));
  if (!object->ok()) {
    tried.summary = NotTried(object->name, object->status, tried.protocol);
    return tried;
  }
  PhysicsTrials trials(asked.metric, asked.options, seed, threads);
  tried.trial = trials.Try(object->mesh, object->stream);
  tried.summary = SummaryOf(object->name, tried.trial, tried.protocol);
  return tried;
}

std::vector<Tried> TryAll(const std::vector<MeshPointer>& meshes, const std::string& protocol,
                          const MetricObject& metric, std::uint64_t seed, int threads,
                          const py::dict& given) {
  if (meshes.empty()) throw InputError("no object", kTrialName, "a mesh, or a list of some");
  const AskedTrial asked = Asked(protocol, metric, given);
  const int all = threads > 0 ? threads : HardwareThreads();
  const bool many = std::ssize(meshes) >= 2 * all;  // side by side, else grasp by grasp
  std::vector<Tried> results;
  {
    const py::gil_scoped_release released;
    StreamInOrder(
        std::ssize(meshes), many ? all : 1,
        [&](std::int64_t i) {
          return TryOne(*meshes[static_cast<std::size_t>(i)], asked, seed, many ? 1 : all);
        },
        [&](std::int64_t, Tried tried) { results.push_back(std::move(tried)); }, ListenToPython());
  }
  for (const Tried& one : results) {
    if (one.summary.HasShare()) return results;
  }
  const TrialSummary& first = results.front().summary;
  throw InputError("no object could be tried; " + first.object + ": " + first.status, kTrialName,
                   "a closed solid that the gripper reaches");
}

// {stage: (share, low, high)}.
py::dict Stages(const Tried& self) {
  py::dict stages;
  for (std::size_t i = 0; i < self.summary.held.size(); ++i) {
    const Share& share = self.summary.held[i];
    stages[py::str(self.protocol.stages[i].name)] =
        py::make_tuple(share.value, share.interval.low, share.interval.high);
  }
  return stages;
}

py::dict Outcomes(const Tried& self) {
  py::dict counts;
  for (const auto& [outcome, name] : ChoicesOf(Outcome{})) {
    counts[py::str(std::string(name))] = self.summary.outcomes[static_cast<std::size_t>(outcome)];
  }
  return counts;
}

template <typename Field>
py::list OfExecutions(const PhysicsTrial& trial, const Field& field) {
  py::list values;
  for (std::size_t i = 0; i < trial.grasps.size(); ++i) {
    for (const ExecutedDraw& draw : trial.grasps[i].draws) values.append(field(i, draw));
  }
  return values;
}

py::dict Executions(const Tried& self) {
  const py::object array = py::module_::import("numpy").attr("asarray");
  py::dict columns;
  const auto add = [&](const char* name, const auto& field) {
    columns[name] = array(OfExecutions(self.trial, field));
  };
  add("grasp", [](std::size_t i, const ExecutedDraw&) { return i; });
  add("friction", [](std::size_t, const ExecutedDraw& d) { return d.friction; });
  add("epsilon", [](std::size_t, const ExecutedDraw& d) { return d.predicted; });
  add("outcome",
      [](std::size_t, const ExecutedDraw& d) { return ChoiceName(d.execution.outcome); });
  add("stages", [](std::size_t, const ExecutedDraw& d) { return d.execution.stages; });
  add("closing_move", [](std::size_t, const ExecutedDraw& d) { return d.execution.closing_move; });
  add("closing_turn", [](std::size_t, const ExecutedDraw& d) { return d.execution.closing_turn; });
  add("move", [](std::size_t, const ExecutedDraw& d) { return d.execution.move; });
  add("turn", [](std::size_t, const ExecutedDraw& d) { return d.execution.turn; });
  add("seconds", [](std::size_t, const ExecutedDraw& d) { return d.execution.seconds; });
  add("penetration", [](std::size_t, const ExecutedDraw& d) { return d.execution.penetration; });
  return columns;
}

}  // namespace

void BindTrial(py::module_& module) {
  const auto first = [](const Tried& self) { return self.summary.held.front(); };
  py::class_<Tried>(module, "Trial", "What physics says of the grasps of one object.")
      .def_property_readonly("name", [](const Tried& self) { return self.summary.object; })
      .def_property_readonly(
          "status", [](const Tried& self) { return self.summary.status; },
          "'ok', 'no stable pose', 'no reachable grasp', or why it is no solid")
      .def_property_readonly(
          "mass", [](const Tried& self) { return self.summary.mass; }, "kg")
      .def_property_readonly(
          "grasps", [](const Tried& self) { return self.summary.grasps; }, "how many were executed")
      .def_property_readonly(
          "held", [first](const Tried& self) { return first(self).value; },
          "share of the executions held, 0 to 1, of the protocol's first stage")
      .def_property_readonly(
          "interval",
          [first](const Tried& self) {
            const Interval& interval = first(self).interval;
            return std::pair(interval.low, interval.high);
          },
          "(low, high): 95 %")
      .def_property_readonly("stages", &Stages, "{stage: (share, low, high)}")
      .def_property_readonly("outcomes", &Outcomes, "{outcome: executions}")
      .def_property_readonly("executions", &Executions,
                             "{column: array, one entry an execution}: grasp, friction, epsilon, "
                             "outcome, stages, closing_move, closing_turn, move, turn, seconds, "
                             "penetration; metres, radians")
      .def("__repr__", [](const Tried& self) {
        return "<antigrasp.Trial " + self.summary.object + ": " + self.summary.status + ", held " +
               std::string(py::repr(py::float_(self.summary.held.front().value))) + ">";
      });
  module.def("trial", &TryAll, py::arg("meshes"), py::arg("protocol"), py::arg("metric"),
             py::arg("seed"), py::arg("threads"), py::arg("options"));
}

}  // namespace antigrasp::python
