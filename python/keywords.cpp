#include "antigrasp/python/keywords.h"

#include <algorithm>
#include <type_traits>

#include "antigrasp/core/error.h"
#include "antigrasp/core/nearest.h"

namespace antigrasp::python {
namespace {

// A number of NumPy as one of Python.
py::object PlainOf(py::handle value) {
  return py::hasattr(value, "item") ? value.attr("item")()
                                    : py::reinterpret_borrow<py::object>(value);
}

std::string ReprOf(py::handle value) { return py::repr(PlainOf(value)); }

// As a TOML file has it.
std::string TextOf(py::handle value, const std::string& name, const std::string& where) {
  if (py::isinstance<py::str>(value)) return value.cast<std::string>();
  const py::object plain = PlainOf(value);
  if (py::isinstance<py::bool_>(plain)) return plain.cast<bool>() ? "true" : "false";
  if (py::isinstance<py::int_>(plain) || py::isinstance<py::float_>(plain)) {
    return py::repr(plain);
  }
  throw InputError(name + " = " + std::string(py::repr(value)), where,
                   "a number, True, False or a word");
}

}  // namespace

std::string KeywordOf(const std::string& key) {
  std::string name = key.substr(key.starts_with("gripper.") ? 0 : key.rfind('.') + 1);
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}

Keywords::Keywords(const py::dict& given, const std::vector<Option>& known, std::string where)
    : where_(std::move(where)) {
  for (const auto& [name_object, value] : given) {
    const std::string name = py::str(name_object);
    std::vector<std::string> names;
    const Option* found = nullptr;
    for (const Option& option : known) {
      names.push_back(KeywordOf(option.key));
      if (names.back() == name) found = &option;
    }
    if (found == nullptr) {
      throw InputError("no option " + name, where_,
                       "a known option; the nearest is " + Nearest(name, names));
    }
    given_[found->key] = {TextOf(value, name, where_), name + "=" + ReprOf(value)};
  }
}

void Keywords::Apply(OptionTable* table) const {
  for (const Option& option : table->options()) {
    const auto found = given_.find(option.key);
    if (found == given_.end()) continue;
    table->ApplyValue(option.key, found->second.toml, where_ + ", " + KeywordOf(option.key));
  }
}

std::string Keywords::Typed(const std::string& key) const {
  const auto found = given_.find(key);
  return found == given_.end() ? "" : found->second.python;
}

std::vector<std::string> Keywords::All() const {
  std::vector<std::string> all;
  for (const auto& [key, given] : given_) all.push_back(given.python);
  return all;
}

std::string HelpOf(const std::vector<Option>& options) {
  std::string text;
  for (const Option& option : options) {
    text += "    " + KeywordOf(option.key) + "=" + ValueText(option) + ": " + option.help + "\n";
  }
  return text;
}

py::object ValueOf(const Option& option) {
  return std::visit(
      [&](auto target) -> py::object {
        if constexpr (std::is_same_v<decltype(target), Option::Enum>) {
          return py::str(option.choices.at(target.get(target.value)));
        } else {
          return py::cast(*target);
        }
      },
      option.target);
}

}  // namespace antigrasp::python
