#include "antigrasp/bundle/simulator_names.h"

namespace antigrasp {

std::string LinkName(std::string_view name) {
  std::string text(name);
  for (std::size_t at = 0; (at = text.find("::", at)) != std::string::npos;) {
    text.replace(at, 2, "_");
  }
  const bool kept = text.starts_with("__") && text.ends_with("__");
  return text == "world" || kept ? text + "_object" : text;
}

std::string UsdName(std::string_view name) {
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  std::string text;
  for (const char c : name) text += letter(c) || digit(c) ? c : '_';
  return text.empty() || digit(text[0]) ? "_" + text : text;
}

}  // namespace antigrasp
