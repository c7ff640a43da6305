#include "antigrasp/core/options.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>

#define TOML_EXCEPTIONS 1
#include <toml++/toml.h>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/file_kind.h"
#include "antigrasp/core/format.h"
#include "antigrasp/core/nearest.h"

namespace antigrasp {
namespace {

template <class... Fs>
struct Overloaded : Fs... {
  using Fs::operator()...;
};
template <class... Fs>
Overloaded(Fs...) -> Overloaded<Fs...>;

using Assignment = std::function<void()>;

std::string TomlText(const toml::node& node) {
  std::ostringstream text;
  node.visit([&](const auto& value) { text << value; });
  return text.str();
}

[[noreturn]] void Refuse(const Option& option, const std::string& value,
                         const std::string& origin) {
  throw InputError(option.key + " = " + value, origin, Accepted(option));
}

const Option& Find(const std::vector<Option>& options, const std::string& key,
                   const std::string& origin) {
  std::vector<std::string> keys;
  for (const Option& option : options) {
    if (option.key == key) return option;
    keys.push_back(option.key);
  }
  throw InputError("unknown key " + key, origin,
                   keys.empty() ? "no keys" : "a known key; the nearest is " + Nearest(key, keys));
}

// Checks a parsed value against the option and returns what will store it.
Assignment Checked(const Option& option, const toml::node& node, const std::string& origin) {
  const auto refuse = [&]() { Refuse(option, TomlText(node), origin); };
  const auto number_in_range = [&](double number) {
    if (!(number >= option.min && number <= option.max)) refuse();
  };
  return std::visit(
      Overloaded{
          [&](bool* target) -> Assignment {
            if (!node.is_boolean()) refuse();
            return [target, value = node.as_boolean()->get()] { *target = value; };
          },
          [&](int* target) -> Assignment {
            if (!node.is_integer()) refuse();
            const std::int64_t value = node.as_integer()->get();
            number_in_range(static_cast<double>(value));
            if (value < std::numeric_limits<int>::min() || value > std::numeric_limits<int>::max())
              refuse();
            return [target, value] { *target = static_cast<int>(value); };
          },
          [&](std::uint64_t* target) -> Assignment {
            if (!node.is_integer() || node.as_integer()->get() < 0) refuse();
            return [target, value = node.as_integer()->get()] {
              *target = static_cast<std::uint64_t>(value);
            };
          },
          [&](double* target) -> Assignment {
            if (!node.is_number()) refuse();
            const double value = *node.value<double>();
            number_in_range(value);
            return [target, value] { *target = value; };
          },
          [&](std::string* target) -> Assignment {
            if (!node.is_string()) refuse();
            const std::string value = node.as_string()->get();
            if (!option.choices.empty() && std::find(option.choices.begin(), option.choices.end(),
                                                     value) == option.choices.end())
              refuse();
            return [target, value] { *target = value; };
          },
          [&](const Option::Enum& target) -> Assignment {
            if (!node.is_string()) refuse();
            const auto at =
                std::find(option.choices.begin(), option.choices.end(), node.as_string()->get());
            if (at == option.choices.end()) refuse();
            return [target, place = static_cast<std::size_t>(at - option.choices.begin())] {
              target.set(target.value, place);
            };
          },
      },
      option.target);
}

void Collect(const std::vector<Option>& options, const toml::table& table,
             const std::string& prefix, const std::string& origin, const std::string* needed,
             std::vector<Assignment>* assignments) {
  for (const auto& [name, node] : table) {
    const std::string key = prefix + std::string(name.str());
    if (const toml::table* inner = node.as_table()) {
      Collect(options, *inner, key + ".", origin, needed, assignments);
      continue;
    }
    const bool known = std::any_of(options.begin(), options.end(),
                                   [&](const Option& option) { return option.key == key; });
    if (!known && needed != nullptr && !key.starts_with(*needed)) continue;
    const std::string where = origin + ":" + std::to_string(node.source().begin.line);
    assignments->push_back(Checked(Find(options, key, where), node, where));
  }
}

// A TOML string with everything escaped that must be.
std::string Quoted(const std::string& text) {
  std::ostringstream out;
  out << toml::value<std::string>(text);
  return out.str();
}

}  // namespace

void OptionTable::AddAll(const OptionTable& other, const std::string& prefix) {
  for (Option option : other.options_) {
    option.key = prefix + option.key;
    options_.push_back(std::move(option));
  }
}

void OptionTable::Add(std::string key, bool* target, std::string help) {
  options_.push_back({.key = std::move(key), .target = target, .help = std::move(help)});
}

void OptionTable::Add(std::string key, int* target, double min, double max, std::string help) {
  options_.push_back(
      {.key = std::move(key), .target = target, .min = min, .max = max, .help = std::move(help)});
}

void OptionTable::Add(std::string key, std::uint64_t* target, std::string help) {
  options_.push_back({.key = std::move(key), .target = target, .help = std::move(help)});
}

void OptionTable::Add(std::string key, double* target, double min, double max, std::string help) {
  options_.push_back(
      {.key = std::move(key), .target = target, .min = min, .max = max, .help = std::move(help)});
}

void OptionTable::Add(std::string key, std::string* target, std::vector<std::string> choices,
                      std::string help) {
  options_.push_back({.key = std::move(key),
                      .target = target,
                      .choices = std::move(choices),
                      .help = std::move(help)});
}

void OptionTable::ApplyFile(const std::string& path) {
  RequireFile(path, "a TOML configuration file");
  RefuseOtherKind(path, FileKind::kUnknown, "a configuration", "a TOML configuration file");
  ApplyText(ReadFile(path), path);
}

void OptionTable::ApplyText(std::string_view text, const std::string& origin) {
  Apply(text, origin, nullptr);
}

void OptionTable::ApplyKnown(std::string_view text, const std::string& origin,
                             const std::string& needed) {
  Apply(text, origin, &needed);
}

void OptionTable::Apply(std::string_view text, const std::string& origin,
                        const std::string* needed) {
  toml::table table;
  try {
    table = toml::parse(text, origin);
  } catch (const toml::parse_error& error) {
    throw InputError(std::string(error.description()),
                     origin + ":" + std::to_string(error.source().begin.line), "valid TOML");
  }
  std::vector<Assignment> assignments;
  Collect(options_, table, "", origin, needed, &assignments);
  for (const Assignment& assign : assignments) assign();
}

void OptionTable::ApplyOverride(const std::string& key_equals_value) {
  const std::size_t equals = key_equals_value.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw InputError(key_equals_value, "--set", "key=value, e.g. gan.batch=32");
  }
  ApplyValue(key_equals_value.substr(0, equals), key_equals_value.substr(equals + 1), "--set");
}

void OptionTable::ApplyValue(const std::string& key, const std::string& text,
                             const std::string& origin) {
  const Option& option = Find(options_, key, origin);
  // A string may be given without the quotes TOML wants; the shell has eaten them.
  const bool is_string = std::holds_alternative<std::string*>(option.target) ||
                         std::holds_alternative<Option::Enum>(option.target);
  toml::table table;
  try {
    table = toml::parse("v = " + (is_string && !text.starts_with('"') ? Quoted(text) : text));
  } catch (const toml::parse_error&) {
    Refuse(option, text, origin);
  }
  if (table.size() != 1) Refuse(option, text, origin);
  Checked(option, *table.get("v"), origin)();
}

std::string OptionTable::Dump() const {
  std::ostringstream out;
  std::string section;
  const auto write = [&](const Option& option, const std::string& name) {
    out << name << " = " << ValueText(option) << "  # " << option.help << "\n";
  };
  // Keys without a section come first: after a [section] line they would belong to it.
  for (const Option& option : options_) {
    if (option.key.find('.') == std::string::npos) write(option, option.key);
  }
  for (const Option& option : options_) {
    const std::size_t dot = option.key.rfind('.');
    if (dot == std::string::npos) continue;
    const std::string head = option.key.substr(0, dot);
    if (head != section) {
      out << (out.tellp() == 0 ? "" : "\n") << "[" << head << "]\n";
      section = head;
    }
    write(option, option.key.substr(dot + 1));
  }
  return out.str();
}

std::string Accepted(const Option& option) {
  const auto range = [&](const std::string& noun) {
    if (std::isinf(option.min) && std::isinf(option.max)) return noun;
    if (std::isinf(option.max)) return noun + " of at least " + FormatDouble(option.min);
    return noun + " in [" + FormatDouble(option.min) + ", " + FormatDouble(option.max) + "]";
  };
  const auto one_of = [&]() {
    std::string list = "one of ";
    for (std::size_t i = 0; i < option.choices.size(); ++i)
      list += (i ? ", " : "") + option.choices[i];
    return list;
  };
  return std::visit(
      Overloaded{
          [](bool*) -> std::string { return "true or false"; },
          [&](int*) { return range("a whole number"); },
          [](std::uint64_t*) -> std::string { return "a whole number of at least 0"; },
          [&](double*) { return range("a number"); },
          [&](std::string*) { return option.choices.empty() ? "text" : one_of(); },
          [&](const Option::Enum&) { return one_of(); },
      },
      option.target);
}

std::string ValueText(const Option& option) {
  return std::visit(Overloaded{
                        [](bool* value) -> std::string { return *value ? "true" : "false"; },
                        [](int* value) { return std::to_string(*value); },
                        [](std::uint64_t* value) { return std::to_string(*value); },
                        [](double* value) {
                          const std::string text = FormatDouble(*value);
                          // TOML tells floats from integers by their look.
                          return text.find_first_of(".en") == std::string::npos ? text + ".0"
                                                                                : text;
                        },
                        [](std::string* value) { return Quoted(*value); },
                        [&](const Option::Enum& target) {
                          return Quoted(option.choices[target.get(target.value)]);
                        },
                    },
                    option.target);
}

}  // namespace antigrasp
