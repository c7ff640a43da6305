#include "antigrasp/python/metric_object.h"

#include <pybind11/stl.h>

#include "antigrasp/quality/sampling_effort.h"

namespace antigrasp::python {
namespace {

constexpr const char* kMetricName = "Metric";

OptionTable TableOf(MetricOptions* options) {
  OptionTable table;
  Bind(&table, options);
  return table;
}

std::vector<Option> KnownConstants() {
  static MetricOptions defaults;
  return TableOf(&defaults).options();
}

}  // namespace

MetricObject::MetricObject(const MetricChoice& choice, bool preset_given, const py::dict& constants)
    : choice_(choice),
      preset_given_(preset_given),
      keywords_(constants, KnownConstants(), kMetricName),
      options_(ResolveMetric(
          choice, [this](OptionTable* table) { keywords_.Apply(table); }, kMetricName,
          [this](const std::string& key) { return keywords_.Typed(key); })) {}

bool MetricObject::effort_given() const {
  return preset_given_ || keywords_.Has("metric.num_grasps") ||
         keywords_.Has("metric.max_attempts");
}

MetricOptions MetricObject::OptionsFor(std::int64_t objects) const {
  MetricOptions options = options_;
  if (!effort_given()) RaiseEffortForFew(objects, &options);
  return options;
}

std::string MetricObject::Repr() const {
  std::string text = preset_given_ ? "\"" + choice_.preset + "\"" : "";
  const auto add = [&](const std::string& word) { text += (text.empty() ? "" : ", ") + word; };
  if (!choice_.noise.empty()) add("noise=\"" + choice_.noise + "\"");
  if (!choice_.gripper.empty()) add("gripper=\"" + choice_.gripper + "\"");
  if (choice_.true_size) add("true_size=True");
  for (const std::string& one : keywords_.All()) add(one);
  return "antigrasp.Metric(" + text + ")";
}

py::object MetricObject::Get(const std::string& keyword) const {
  MetricOptions options = options_;
  const OptionTable table = TableOf(&options);
  for (const Option& option : table.options()) {
    if (KeywordOf(option.key) == keyword) return ValueOf(option);
  }
  throw py::attribute_error("Metric has no constant " + keyword);
}

py::dict MetricObject::All() const {
  MetricOptions options = options_;
  py::dict all;
  const OptionTable table = TableOf(&options);
  for (const Option& option : table.options()) {
    all[py::str(KeywordOf(option.key))] = ValueOf(option);
  }
  return all;
}

void BindMetric(py::module_& module) {
  const std::string about =
      R"(The constants of the metric (docs/metric.md). Scores compare only where all are equal.

Metric(preset="default", *, noise="", gripper="", true_size=False, **constants)
preset: default, settled (what follows physics), dexnet or egad, all constants at once; noise: its
part alone, default, dexnet or none; gripper: yumi, panda, ... or a TOML file; true_size: objects
keep their size, their coordinates in `units`, and are not rescaled. Constants go before all of
these; lengths in metres, angles in radians. Each is read as an attribute: Metric().friction.
InputError for what is unknown, out of range or does not fit together.

Constants and defaults:
)" + HelpOf(KnownConstants());
  py::class_<MetricObject>(module, "Metric", about.c_str())
      .def(py::init([](const std::optional<std::string>& preset, const std::string& noise,
                       const std::string& gripper, bool true_size, const py::kwargs& constants) {
             return MetricObject({preset.value_or("default"), noise, gripper, true_size},
                                 preset.has_value(), constants);
           }),
           py::arg("preset") = py::none(), py::kw_only(), py::arg("noise") = "",
           py::arg("gripper") = "", py::arg("true_size") = false)
      .def("__getattr__", &MetricObject::Get)
      .def("as_dict", &MetricObject::All, "every constant by name")
      .def("toml", &MetricObject::Toml, py::arg("seed") = 1,
           "what belongs beside scores: seed and constants, as evaluate --out writes them")
      .def("__repr__", &MetricObject::Repr);
}

}  // namespace antigrasp::python
