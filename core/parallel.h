#pragma once

#include <cstdint>
#include <functional>

namespace antigrasp {

// Called by long work from one thread at a time with items done and items in all. May throw
// (Interrupted, for example): the exception leaves the function that reported.
using ProgressFn = std::function<void(std::int64_t done, std::int64_t total)>;

// Number of hardware threads this process may use.
int HardwareThreads();

// Runs body(i) for every i in [0, count) on `threads` threads (0 = all), dynamic schedule. Write to
// slot i and reduce afterwards: the result must not depend on the order. The first exception stops
// the hand-out of further items and is rethrown here. Progress is reported after each item.
void ParallelFor(std::int64_t count, int threads, const std::function<void(std::int64_t)>& body,
                 const ProgressFn& progress = nullptr);

}  // namespace antigrasp
