#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "antigrasp/core/choice.h"

namespace antigrasp {

// One knob: where its value lives, what it may be and what it means. A module lists the fields of
// its options struct once, in Bind(OptionTable&, TheOptions&); the configuration file, --set,
// the command-line flags, the saved resolved file and `antigrasp help` are all made from that list.
struct Option {
  // An enum of any type, by the place of its value in ChoicesOf (choice.h).
  struct Enum {
    void* value;
    std::size_t (*get)(const void* value);
    void (*set)(void* value, std::size_t place);
  };
  using Target = std::variant<bool*, int*, std::uint64_t*, double*, std::string*, Enum>;
  std::string key;  // dotted: "metric.friction"
  Target target;
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  std::vector<std::string> choices = {};  // for enums and strings; empty = any
  std::string help = {};                  // one line with the unit
};

class OptionTable {
 public:
  void Add(std::string key, bool* target, std::string help);
  void Add(std::string key, int* target, double min, double max, std::string help);
  void Add(std::string key, std::uint64_t* target, std::string help);
  void Add(std::string key, double* target, double min, double max, std::string help);
  void Add(std::string key, std::string* target, std::vector<std::string> choices,
           std::string help);
  template <Chosen E>
  void Add(std::string key, E* target, std::string help);

  // The options of another table, their keys behind a prefix: "judge." and "trial.mass".
  void AddAll(const OptionTable& other, const std::string& prefix);

  const std::vector<Option>& options() const { return options_; }

  // Each throws InputError naming file:line (or `origin`), key, value and the accepted range. An
  // unknown key is an error that names the nearest known one. Nothing is assigned on error.
  void ApplyFile(const std::string& path);
  void ApplyText(std::string_view toml, const std::string& origin);
  // The same for a file that another version may have written: unknown keys are left out, unless
  // they begin with `needed` ("model.").
  void ApplyKnown(std::string_view toml, const std::string& origin, const std::string& needed);
  void ApplyOverride(const std::string& key_equals_value);  // "a.b=c", from --set
  void ApplyValue(const std::string& key, const std::string& text, const std::string& origin);

  // TOML that ApplyText reads back to the same values, one table per section, help as comments.
  std::string Dump() const;

 private:
  void Apply(std::string_view toml, const std::string& origin, const std::string* needed);

  std::vector<Option> options_;
};

// "a number in [0, 10]", "one of hinge, wgan": what an option accepts, for messages and help.
std::string Accepted(const Option& option);
// The current value as TOML text.
std::string ValueText(const Option& option);

template <Chosen E>
void OptionTable::Add(std::string key, E* target, std::string help) {
  const auto get = [](const void* value) {
    const auto choices = ChoicesOf(E{});
    const auto at = std::find_if(choices.begin(), choices.end(), [&](const Choice<E>& choice) {
      return choice.value == *static_cast<const E*>(value);
    });
    return static_cast<std::size_t>(at - choices.begin());
  };
  const auto set = [](void* value, std::size_t place) {
    *static_cast<E*>(value) = ChoicesOf(E{})[place].value;
  };
  options_.push_back({.key = std::move(key),
                      .target = Option::Enum{target, get, set},
                      .choices = ChoiceNames<E>(),
                      .help = std::move(help)});
}

}  // namespace antigrasp
