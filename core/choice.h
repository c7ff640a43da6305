#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace antigrasp {

// A value of an enum and its name in files, flags and messages. An enum that people choose from
// lists all of them once, in the order in which messages name them, beside the enum:
//   enum class Squash { kClamp, kTanh };
//   constexpr auto ChoicesOf(Squash) {
//     return std::to_array<Choice<Squash>>({{Squash::kClamp, "clamp"}, {Squash::kTanh, "tanh"}});
//   }
template <class E>
struct Choice {
  E value;
  std::string_view name;
};

template <class E>
concept Chosen = requires(E value) {
  ChoicesOf(value);
};

template <Chosen E>
std::vector<std::string> ChoiceNames() {
  std::vector<std::string> names;
  for (const Choice<E>& choice : ChoicesOf(E{})) names.emplace_back(choice.name);
  return names;
}

// Of a listed value.
template <Chosen E>
std::string ChoiceName(E value) {
  const auto choices = ChoicesOf(value);
  const auto at = std::find_if(choices.begin(), choices.end(),
                               [&](const Choice<E>& choice) { return choice.value == value; });
  return std::string(at->name);
}

template <Chosen E>
std::optional<E> FindChoice(std::string_view name) {
  for (const Choice<E>& choice : ChoicesOf(E{})) {
    if (choice.name == name) return choice.value;
  }
  return std::nullopt;
}

// "stl, obj or ply"; with a prefix for each: ".stl, .obj or .ply".
std::string Alternatives(const std::vector<std::string>& names, const std::string& prefix = "");

}  // namespace antigrasp
