#pragma once

#include <functional>

namespace antigrasp::bench {

// Processor seconds of this thread for one call: the least of `rounds`, so that programs beside it
// count for little.
double LeastThreadSeconds(const std::function<void()>& work, int rounds);

// Floating-point operations a second (2 for each multiply-add) that one thread does in registers
// alone, float: in vectors of eight, and of sixteen (0: this CPU has none).
double PeakRateOfEight();
double PeakRateOfSixteen();

// Bytes a second that one thread moves in a = b + s c, arrays far larger than any cache share; each
// read or written number counts once.
double MemoryRate();

}  // namespace antigrasp::bench
