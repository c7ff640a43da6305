#pragma once

#include <string>
#include <vector>

#include "antigrasp/datasets/objects.h"
#include "antigrasp/export/print_check.h"

namespace antigrasp {

// An object of the command line with its print check; the check is empty when it is not usable.
struct PrintedObject {
  InputObject object;
  PrintCheck check;
};

// Columns as docs/formats.md says, one row per object.
std::string PrintCsv(const std::vector<PrintedObject>& objects);

// What the printer will find: one line an object for a few objects, and totals.
std::string PrintSummary(const std::vector<PrintedObject>& objects, const PrintOptions& options);

}  // namespace antigrasp
