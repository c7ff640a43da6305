#pragma once

#include "antigrasp/models/model_options.h"

namespace antigrasp {

// Lets our kernels compute on `threads` threads and LibTorch on `of_libtorch` (both start with
// one), and leaves OpenBLAS one: LibTorch sets no thread count of OpenBLAS, whose threads then spin
// through every small product on a core of their own. That costs 8 % more processor time of a run
// on one thread, and on two it takes the core from the second.
void SetTorchThreads(int threads, int of_libtorch);

// What LibTorch is to have of `threads`: one where our kernels do the convolutions of these
// networks. Its threads share a loop out in halves and spin at its end, so that a step on two took
// four times as long as on one where another program kept a core busy; and its sums would depend on
// their number.
int ThreadsOfLibTorch(const ModelOptions& model, bool on_cpu, int threads);

}  // namespace antigrasp
