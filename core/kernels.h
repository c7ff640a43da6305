#pragma once

namespace antigrasp {

// LibTorch, oneDNN and OpenBLAS choose their kernels by the processor, and those of AVX-512 add in
// another order. All take those of AVX2 where there is no wish to the contrary in the environment,
// so that a seed gives the same bytes on every x86-64 with AVX2. They look when they are loaded:
// call before (docs/performance.md has what it costs).
void AskForTheSameKernelsEverywhere();

// And for large pages where the system gives them to who asks: a step goes through hundreds of
// megabytes, and takes a twentieth longer by pages of 4 KB. Before the process of the networks
// begins.
void PrepareForNetworks();

}  // namespace antigrasp
