#pragma once

#include <string>
#include <vector>

#include "antigrasp/export/print_check.h"

namespace antigrasp {

struct PrintedObject {
  std::string name;
  PrintCheck check;
};

// Columns as docs/formats.md says, one row per object.
std::string PrintCsv(const std::vector<PrintedObject>& objects);

// What the printer will find: one line an object for a few objects, and totals.
std::string PrintSummary(const std::vector<PrintedObject>& objects, const PrintOptions& options);

}  // namespace antigrasp
