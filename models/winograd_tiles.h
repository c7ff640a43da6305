#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <memory>

#include "antigrasp/models/cell_conv.h"
#include "antigrasp/models/winograd_products.h"

// Where the tiles of winograd_conv.h lie, and memory for their values. A tile is 2^3 outputs and
// the 3^3 cells that they see.
namespace antigrasp::winograd {

constexpr int kLanes = 8;               // floats of a vector
constexpr std::int64_t kTiles = 64;     // tiles of a block, at most
constexpr std::int64_t kPadding = 16;   // floats between planes: powers of two fight for lines
constexpr std::size_t kAlignment = 64;  // of a cache line

struct FreeFloats {
  void operator()(float* values) const { std::free(values); }
};
using Floats = std::unique_ptr<float[], FreeFloats>;

// Not initialised.
inline Floats AllocateFloats(std::int64_t count) {
  const std::size_t bytes = static_cast<std::size_t>(count) * sizeof(float);
  return Floats(static_cast<float*>(
      std::aligned_alloc(kAlignment, (bytes + kAlignment - 1) / kAlignment * kAlignment)));
}

// Floats from a cell or output to its neighbour along each axis.
struct Steps {
  std::int64_t z, y, x;
};

inline Steps StepsOf(std::int64_t side, std::int64_t channels) {
  return {side * side * channels, side * channels, channels};
}

// The tiles [first, first + count) of all samples, x fastest: the offset of each one's first cell
// and output. The last is repeated up to a multiple of kRowStep.
struct TileBlock {
  TileBlock(const CellConvShape& shape, std::int64_t first, std::int64_t tiles)
      : count(tiles), rows((tiles + kRowStep - 1) / kRowStep * kRowStep) {
    const std::int64_t g = shape.h - 1, t = g / 2;
    const Steps cell = StepsOf(shape.h, shape.in), output = StepsOf(g, shape.out);
    for (std::int64_t r = 0; r < rows; ++r) {
      const std::int64_t tile = first + std::min(r, count - 1), sample = tile / (t * t * t);
      const std::int64_t z = tile / (t * t) % t, y = tile / t % t, x = tile % t;
      cells[r] = sample * shape.h * cell.z + 2 * (z * cell.z + y * cell.y + x * cell.x);
      outputs[r] = sample * g * output.z + 2 * (z * output.z + y * output.y + x * output.x);
    }
  }

  std::int64_t count, rows;
  std::array<std::int64_t, kTiles> cells, outputs;
};

}  // namespace antigrasp::winograd
