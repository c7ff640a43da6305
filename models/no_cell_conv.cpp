#include "antigrasp/core/check.h"
#include "antigrasp/models/cell_conv.h"
#include "antigrasp/models/winograd_conv.h"

// In place of cell_conv.cpp and winograd_*.cpp where the processor is no x86-64: LibTorch's
// convolutions do the work (folded_conv.cpp asks HasCellConv() first).
namespace antigrasp {
namespace {

[[noreturn]] void Missing() {
  CheckFailed(__FILE__, __LINE__, "HasCellConv()", "a convolution for AVX2 on another processor");
}

}  // namespace

bool HasCellConv() { return false; }

void CellConv(const CellConvShape&, const float*, const float*, const float*, float*) { Missing(); }
void CellConvTranspose(const CellConvShape&, const float*, const float*, float*) { Missing(); }
void CellConvWeightGradient(const CellConvShape&, const float*, const float*, float*) { Missing(); }
void WinogradConv(const CellConvShape&, const float*, const float*, const float*, float*) {
  Missing();
}
void WinogradConvTranspose(const CellConvShape&, const float*, const float*, float*) { Missing(); }
bool SuitsSampleBySample(const CellConvShape&) { return false; }
void WinogradConvOfFilled(const CellConvShape&, const std::function<void(std::int64_t)>&,
                          const float*, const float*, const float*, float*) {
  Missing();
}
void WinogradConvTransposeTaken(const CellConvShape&, const float*, const float*,
                                const std::function<void(std::int64_t, const float*)>&) {
  Missing();
}
void WinogradConvWeightGradient(const CellConvShape&, const float*, const float*, float*) {
  Missing();
}

}  // namespace antigrasp
