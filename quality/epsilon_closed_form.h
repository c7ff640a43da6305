#pragma once

#include <optional>
#include <vector>

#include "antigrasp/quality/pyramid_kernel.h"
#include "antigrasp/quality/wrench_dual.h"

namespace antigrasp {

// The instruction sets the closed form is compiled for. All give the same bits.
enum class SimdLevel { kBaseline, kAvx2, kAvx512 };
const char* Name(SimdLevel level);
// Those this processor can run, slowest first; the last one is used.
const std::vector<SimdLevel>& SupportedSimdLevels();

// max |y|^2 over Q where each contact lies well inside the other's friction pyramid, which has at
// most 8 edges; nullopt elsewhere. No heap. Where the time of one evaluation goes: bench/compare.
std::optional<double> MaxNorm2ClosedForm(const DualMap& map);
std::optional<double> MaxNorm2ClosedForm(const DualMap& map, SimdLevel level);

}  // namespace antigrasp
