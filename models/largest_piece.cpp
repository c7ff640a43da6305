#include "antigrasp/models/largest_piece.h"

#include <ATen/ATen.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "antigrasp/core/pieces.h"

namespace antigrasp {
namespace {

// Numbers the pieces of one grid from 1 in piece[r^3], 0 outside; how many nodes each has.
std::vector<std::int64_t> NumberPieces(const float* value, std::int64_t r,
                                       std::vector<std::int32_t>* piece) {
  const std::array<std::int64_t, 3> stride = {1, r, r * r};
  piece->assign(static_cast<std::size_t>(r * r * r), 0);
  std::vector<std::int64_t> sizes, open;
  for (std::int64_t seed = 0; seed < r * r * r; ++seed) {
    if (!(value[seed] > 0.0F) || (*piece)[static_cast<std::size_t>(seed)] != 0) continue;
    const auto number = static_cast<std::int32_t>(sizes.size() + 1);
    sizes.push_back(0);
    const auto enter = [&](std::int64_t node) {
      std::int32_t& at = (*piece)[static_cast<std::size_t>(node)];
      if (!(value[node] > 0.0F) || at != 0) return;
      at = number;
      open.push_back(node);
    };
    enter(seed);
    while (!open.empty()) {
      const std::int64_t node = open.back();
      open.pop_back();
      ++sizes.back();
      for (const std::int64_t step : stride) {
        const std::int64_t place = node / step % r;
        if (place > 0) enter(node - step);
        if (place + 1 < r) enter(node + step);
      }
    }
  }
  return sizes;
}

}  // namespace

at::Tensor LargestPiece(const at::Tensor& values) {
  at::Tensor kept = values.detach().clone(at::MemoryFormat::Contiguous);
  const std::int64_t r = kept.size(4), nodes = r * r * r;
  auto* data = kept.data_ptr<float>();
  ForPieces(kept.size(0), [&](std::int64_t i) {
    std::vector<std::int32_t> piece;
    float* value = data + i * nodes;
    const std::vector<std::int64_t> sizes = NumberPieces(value, r, &piece);
    if (sizes.size() < 2) return;
    const auto largest =
        std::max_element(sizes.begin(), sizes.end()) - sizes.begin() + 1;  // the first of equals
    for (std::int64_t node = 0; node < nodes; ++node) {
      const std::int32_t number = piece[static_cast<std::size_t>(node)];
      if (number != 0 && number != largest) value[node] = -value[node];
    }
  });
  return kept;
}

}  // namespace antigrasp
