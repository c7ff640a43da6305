#pragma once

#include "antigrasp/doctor/examine.h"

namespace antigrasp {

// Prints NetworkFacts and what RunNetworkSelfTest found; whether the bytes are the expected ones.
bool ExamineNetworks(const PrintFn& print);

}  // namespace antigrasp
