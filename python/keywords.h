#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "antigrasp/core/options.h"

namespace antigrasp::python {

namespace py = pybind11;

// Options by keyword, as the program has them as flags: "metric.num_draws" is num_draws, and a
// gripper's "gripper.palm_width" keeps its section: gripper_palm_width.
class Keywords {
 public:
  Keywords() = default;
  // Any of the `known` options, which need not live longer. InputError that names `where`, and
  // the nearest keyword, for one that there is not.
  Keywords(const py::dict& given, const std::vector<Option>& known, std::string where);

  // InputError for a value out of range. Those whose keys the table has not are left out.
  void Apply(OptionTable* table) const;
  // "num_draws=5", as Python has it; "" of what was not given.
  std::string Typed(const std::string& key) const;
  bool Has(const std::string& key) const { return given_.contains(key); }
  std::vector<std::string> All() const;  // Typed of all that were given

 private:
  struct Given {
    std::string toml, python;
  };
  std::map<std::string, Given> given_;  // by key
  std::string where_;
};

std::string KeywordOf(const std::string& key);  // "gripper.palm_width" -> "gripper_palm_width"

// A line each: "num_draws=25: ..." with help and default, for docstrings.
std::string HelpOf(const std::vector<Option>& options);

// The value of an option as Python has it.
py::object ValueOf(const Option& option);

}  // namespace antigrasp::python
