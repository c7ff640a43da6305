#pragma once

#include <cstdint>
#include <span>

#include "antigrasp/core/parallel.h"
#include "antigrasp/quality/epsilon.h"

namespace antigrasp::python {

// Grasps of two contacts as rows of arrays, lengths in the unit of `model`.
struct ContactArrays {
  std::int64_t count = 0;
  const double* points = nullptr;    // [count, 2, 3]
  const double* normals = nullptr;   // [count, 2, 3], OUTWARD, of any length
  const double* closings = nullptr;  // [count, 2, 3]: what each jaw closes along; may be null
  const double* coms = nullptr;      // [3], or [count, 3]
  bool com_each = false;
  const double* frictions = nullptr;  // [count]; null: the model's
  WrenchModel model;
};

// InputError that names the first row whose numbers are not finite, whose direction is zero, or
// whose friction is not in [0, 10].
void RequireContacts(const ContactArrays& contacts);

// Epsilon of every row, as `antigrasp quality` has it, on `threads` threads (0 = all), which no
// value depends on. A jaw that slips while it closes gives no force. Some tenths of a microsecond a
// row.
void EpsilonOfAll(const ContactArrays& contacts, int threads, std::span<double> epsilons,
                  const ProgressFn& progress = nullptr);

}  // namespace antigrasp::python
