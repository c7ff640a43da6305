#pragma once

#include <pybind11/pybind11.h>

#include <cstdint>
#include <string>

#include "antigrasp/python/keywords.h"
#include "antigrasp/quality/metric_choice.h"

namespace antigrasp::python {

// antigrasp.Metric: the metric's constants, resolved, and which of them were asked for.
class MetricObject {
 public:
  MetricObject(const MetricChoice& choice, bool preset_given, const py::dict& constants);

  const MetricOptions& options() const { return options_; }
  // For so many objects: more grasps of few, unless somebody said how many (sampling_effort.h).
  MetricOptions OptionsFor(std::int64_t objects) const;
  bool egad() const { return choice_.preset == "egad"; }
  bool effort_given() const;
  bool friction_given() const { return keywords_.Has("metric.friction"); }
  std::string Toml(std::uint64_t seed) const { return MetricToml(options_, seed); }
  std::string Repr() const;
  // The constant of this keyword. AttributeError when there is none.
  py::object Get(const std::string& keyword) const;
  py::dict All() const;

 private:
  MetricChoice choice_;
  bool preset_given_;
  Keywords keywords_;
  MetricOptions options_;
};

void BindMetric(py::module_& module);

}  // namespace antigrasp::python
