#pragma once

#include <string>
#include <vector>

#include "antigrasp/core/options.h"

namespace antigrasp {

// "key = value" of every option of a table: names and values at a glance. A round trip through the
// table's own text cannot see two keys that have changed places.
inline std::vector<std::string> Lines(const OptionTable& table) {
  std::vector<std::string> lines;
  for (const Option& option : table.options()) {
    lines.push_back(option.key + " = " + ValueText(option));
  }
  return lines;
}

// What Bind lists for `options` once every "key=value" was applied.
template <typename Options>
std::vector<std::string> LinesOf(Options options) {
  OptionTable table;
  Bind(&table, &options);
  return Lines(table);
}

}  // namespace antigrasp
