#pragma once

namespace antigrasp {

// Lets LibTorch compute on `threads` threads (it starts with one) and leaves OpenBLAS one: LibTorch
// sets no thread count of OpenBLAS, whose threads then spin through every small product on a core
// of their own. That costs 8 % more processor time of a run on one thread, and on two it takes the
// core from LibTorch's second.
void SetTorchThreads(int threads);

}  // namespace antigrasp
