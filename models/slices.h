#pragma once

#include <ATen/ATen.h>
#include <ATen/core/LegacyTypeDispatch.h>

#include <array>

#include "antigrasp/core/pieces.h"

namespace antigrasp {

// A multiple of all vectors that LibTorch takes at a time: what is left over for its scalar loops,
// whose bits can differ, is left over in the last slice as in the whole.
constexpr std::int64_t kSlice = 1 << 15;

// Whether all are dense on the CPU and in the same order of memory.
template <std::size_t Count>
bool LieAlike(const std::array<at::Tensor, Count>& tensors) {
  for (const at::Tensor& tensor : tensors) {
    if (!tensor.device().is_cpu() || !tensor.is_non_overlapping_and_dense() ||
        tensor.sizes() != tensors[0].sizes() || tensor.strides() != tensors[0].strides()) {
      return false;
    }
  }
  return true;
}

// Element by element, op(a slice of each tensor's memory) for all slices, in pieces
// (core/pieces.h): the numbers of one op(tensors). Without gradients. Tensors that do not lie alike
// go whole.
template <std::size_t Count, typename Op>
void OnSlices(const std::array<at::Tensor, Count>& tensors, const Op& op) {
  if (!LieAlike(tensors)) {
    const at::AutoDispatchBelowADInplaceOrView no_gradients;
    return op(tensors);
  }
  std::array<at::Tensor, Count> flat;
  for (std::size_t i = 0; i < Count; ++i) {
    flat[i] = tensors[i].detach().as_strided({tensors[i].numel()}, {1});
  }
  ForRanges(flat[0].numel(), kSlice, [&](std::int64_t begin, std::int64_t end) {
    const at::AutoDispatchBelowADInplaceOrView no_gradients;
    std::array<at::Tensor, Count> slices;
    for (std::size_t i = 0; i < Count; ++i) slices[i] = flat[i].slice(0, begin, end);
    op(slices);
  });
}

}  // namespace antigrasp
