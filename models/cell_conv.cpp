#include "antigrasp/models/cell_conv.h"

#include <immintrin.h>

#include <algorithm>
#include <array>
#include <vector>

#include "antigrasp/core/pieces.h"

// Compiled for AVX2 and FMA (CMakeLists.txt); HasCellConv() is asked before anything else.
namespace antigrasp {
namespace {

constexpr int kLanes = 8;       // floats of a vector
constexpr int kPositions = 6;   // rows of a tile of 16 channels: 12 of the 16 registers are sums
constexpr int kNarrowRows = 8;  // rows of a tile of 8 channels
constexpr std::int64_t kGrain = 1 << 20;  // multiply-adds of a piece
constexpr std::int64_t kChunk = 128;      // positions of a weight gradient that stay in L1
constexpr std::int64_t kBlock = 2 * kLanes;

template <int Rows, int Vectors>
struct Tile {
  __m256 sums[Rows][Vectors];
  __m256* operator[](int r) { return sums[r]; }
};

// What the outputs of one kind have in common: `taps` of the kernel, each the weights of panel row
// `tap` and inputs at `offset` floats from the position's own.
struct Taps {
  int count = 0;
  std::array<std::int64_t, 8> offset{};
  std::array<int, 8> tap{};
};

// Inputs and outputs of the positions of one sample, in floats from its start.
struct Position {
  std::int64_t in, out;
};

template <int Rows, int Vectors>
inline void Accumulate(const std::array<const float*, Rows>& in, const Taps& taps,
                       std::int64_t depth, const float* panel, Tile<Rows, Vectors>* sums) {
  Tile<Rows, Vectors> tile = *sums;
  for (int t = 0; t < taps.count; ++t) {
    const float* w = panel + taps.tap[t] * depth * Vectors * kLanes;
    std::array<const float*, Rows> x;
    for (int r = 0; r < Rows; ++r) x[r] = in[r] + taps.offset[t];
    for (std::int64_t i = 0; i < depth; ++i, w += Vectors * kLanes) {
      __m256 weights[Vectors];
#pragma GCC unroll 8
      for (int v = 0; v < Vectors; ++v) weights[v] = _mm256_loadu_ps(w + v * kLanes);
#pragma GCC unroll 8
      for (int r = 0; r < Rows; ++r) {
        const __m256 value = _mm256_broadcast_ss(x[r] + i);
#pragma GCC unroll 8
        for (int v = 0; v < Vectors; ++v) {
          tile[r][v] = _mm256_fmadd_ps(value, weights[v], tile[r][v]);
        }
      }
    }
  }
  *sums = tile;
}

// Fills the outputs of `positions` in samples [0, count) for one panel of channels.
template <int Rows, int Vectors>
void FillPanel(const std::vector<Position>& positions, const Taps& taps, std::int64_t depth,
               const float* panel, const float* bias, const float* in, std::int64_t in_size,
               float* out, std::int64_t out_size, std::int64_t begin, std::int64_t end) {
  const auto length = static_cast<std::int64_t>(positions.size());
  std::int64_t sample = begin / length, k = begin % length;
  Tile<Rows, Vectors> start;
  for (int v = 0; v < Vectors; ++v) {
    const __m256 b = bias != nullptr ? _mm256_loadu_ps(bias + v * kLanes) : _mm256_setzero_ps();
    for (int r = 0; r < Rows; ++r) start[r][v] = b;
  }
  for (std::int64_t i = begin; i < end; i += Rows) {
    std::array<const float*, Rows> from;
    std::array<float*, Rows> to;
    // The last tile repeats its last position.
    for (int r = 0; r < Rows; ++r) {
      from[r] = in + sample * in_size + positions[k].in;
      to[r] = out + sample * out_size + positions[k].out;
      if (i + r + 1 < end && ++k == length) {
        k = 0;
        ++sample;
      }
    }
    Tile<Rows, Vectors> tile = start;
    Accumulate<Rows, Vectors>(from, taps, depth, panel, &tile);
    for (int r = 0; r < Rows; ++r) {
      for (int v = 0; v < Vectors; ++v) _mm256_storeu_ps(to[r] + v * kLanes, tile[r][v]);
    }
  }
}

void Fill(const std::vector<Position>& positions, const Taps& taps, std::int64_t count,
          std::int64_t depth, std::int64_t width, const float* panels, const float* bias,
          const float* in, std::int64_t in_size, float* out, std::int64_t out_size) {
  const std::int64_t total = count * static_cast<std::int64_t>(positions.size());
  const std::int64_t grain = std::max<std::int64_t>(1, kGrain / (taps.count * depth * width));
  ForRanges(total, grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t c = 0; c < width; c += 2 * kLanes) {
      const float* panel = panels + c * 8 * depth;
      const float* b = bias != nullptr ? bias + c : nullptr;
      if (c + 2 * kLanes <= width) {
        FillPanel<kPositions, 2>(positions, taps, depth, panel, b, in, in_size, out + c, out_size,
                                 begin, end);
      } else {
        FillPanel<kNarrowRows, 1>(positions, taps, depth, panel, b, in, in_size, out + c, out_size,
                                  begin, end);
      }
    }
  });
}

std::int64_t Index(std::int64_t z, std::int64_t y, std::int64_t x, std::int64_t side) {
  return (z * side + y) * side + x;
}

// The positions of a chunk with the channels [0, width) of each, width at most kBlock, side by
// side: tensors step by powers of two from position to position, and would fight for cache lines.
using Block = std::array<float, kChunk * kBlock>;

void GatherBlock(const float* values, const std::vector<std::int64_t>& offsets, std::int64_t width,
                 Block* block) {
  float* to = block->data();
  for (const std::int64_t offset : offsets) {
    _mm256_storeu_ps(to, _mm256_loadu_ps(values + offset));
    if (width == kBlock) _mm256_storeu_ps(to + kLanes, _mm256_loadu_ps(values + offset + kLanes));
    to += kBlock;
  }
}

// Outputs of a chunk, `step` floats from one position to the next.
struct ChunkOutputs {
  const float* values;
  std::int64_t step;
};

// gradient[r][v] += sum over the chunk of cells[r] outputs[v]; rows are `stride` apart.
template <int Rows, int Vectors>
void AddProducts(const float* cells, ChunkOutputs outputs, std::size_t positions,
                 std::int64_t stride, float* gradient) {
  Tile<Rows, Vectors> tile;
#pragma GCC unroll 8
  for (int r = 0; r < Rows; ++r) {
#pragma GCC unroll 8
    for (int v = 0; v < Vectors; ++v) {
      tile[r][v] = _mm256_loadu_ps(gradient + r * stride + v * kLanes);
    }
  }
  for (std::size_t p = 0; p < positions; ++p, cells += kBlock) {
    __m256 values[Vectors];
#pragma GCC unroll 8
    for (int v = 0; v < Vectors; ++v) values[v] = _mm256_loadu_ps(outputs.values + v * kLanes);
    outputs.values += outputs.step;
#pragma GCC unroll 8
    for (int r = 0; r < Rows; ++r) {
      const __m256 cell = _mm256_broadcast_ss(cells + r);
#pragma GCC unroll 8
      for (int v = 0; v < Vectors; ++v) tile[r][v] = _mm256_fmadd_ps(cell, values[v], tile[r][v]);
    }
  }
#pragma GCC unroll 8
  for (int r = 0; r < Rows; ++r) {
#pragma GCC unroll 8
    for (int v = 0; v < Vectors; ++v) {
      _mm256_storeu_ps(gradient + r * stride + v * kLanes, tile[r][v]);
    }
  }
}

// Adds the products of a chunk of output positions [begin, end) to the gradient of the tasks.
// A task is one tap and one block of inputs.
class ChunkProducts {
 public:
  explicit ChunkProducts(const CellConvShape& shape)
      : s_(shape),
        output_blocks_((shape.out + kBlock - 1) / kBlock),
        gathered_(shape.out > kBlock ? output_blocks_.size() : 0) {}

  void Gather(std::int64_t begin, std::int64_t end, const float* output_gradient) {
    const std::int64_t g = s_.h - 1;
    cell_offsets_.clear();
    output_offsets_.clear();
    if (gathered_.empty()) output_blocks_[0] = {output_gradient + begin * s_.out, s_.out};
    std::int64_t x = begin % g, row = begin / g;  // of outputs: y, z and sample
    std::int64_t cell = RowStart(row, g);
    for (std::int64_t p = begin; p < end; ++p) {
      cell_offsets_.push_back((cell + x) * s_.in);
      output_offsets_.push_back(p * s_.out);
      if (++x == g) {
        x = 0;
        cell = RowStart(++row, g);
      }
    }
    for (std::size_t b = 0; b < gathered_.size(); ++b) {
      const auto o = static_cast<std::int64_t>(b) * kBlock;
      GatherBlock(output_gradient + o, output_offsets_, std::min(kBlock, s_.out - o),
                  &gathered_[b]);
      output_blocks_[b] = {gathered_[b].data(), kBlock};
    }
  }

  void Add(int tap, std::int64_t i0, const float* cells, float* gradient) {
    const std::int64_t width = std::min(kBlock, s_.in - i0);
    GatherBlock(cells + Index(tap >> 2, tap >> 1 & 1, tap & 1, s_.h) * s_.in + i0, cell_offsets_,
                width, &cell_block_);
    float* row = gradient + (tap * s_.in + i0) * s_.out;
    for (std::size_t b = 0; b < output_blocks_.size(); ++b, row += kBlock) {
      const bool narrow = s_.out - static_cast<std::int64_t>(b) * kBlock < kBlock;
      const auto add = narrow ? AddProducts<8, 1> : AddProducts<4, 2>;
      const std::int64_t step = narrow ? 8 : 4;
      for (std::int64_t i = 0; i < width; i += step) {
        add(cell_block_.data() + i, output_blocks_[b], cell_offsets_.size(), s_.out,
            row + i * s_.out);
      }
    }
  }

 private:
  // The cell of the first output of a row.
  std::int64_t RowStart(std::int64_t row, std::int64_t g) const {
    return row / (g * g) * s_.h * s_.h * s_.h + Index(row / g % g, row % g, 0, s_.h);
  }

  CellConvShape s_;
  std::vector<std::int64_t> cell_offsets_, output_offsets_;
  std::vector<ChunkOutputs> output_blocks_;
  std::vector<Block> gathered_;  // of more than one block; one lies side by side as it is
  Block cell_block_;
};

}  // namespace

bool HasCellConv() {
  static const bool has = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  return has;
}

void CellConv(const CellConvShape& s, const float* cells, const float* panels, const float* bias,
              float* outputs) {
  const std::int64_t g = s.h - 1;
  Taps taps;
  for (int t = 0; t < 8; ++t) {
    taps.offset[t] = Index(t >> 2, t >> 1 & 1, t & 1, s.h) * s.in;
    taps.tap[t] = t;
  }
  taps.count = 8;
  std::vector<Position> positions;
  for (std::int64_t z = 0; z < g; ++z) {
    for (std::int64_t y = 0; y < g; ++y) {
      for (std::int64_t x = 0; x < g; ++x) {
        positions.push_back({Index(z, y, x, s.h) * s.in, Index(z, y, x, g) * s.out});
      }
    }
  }
  Fill(positions, taps, s.count, s.in, s.out, panels, bias, cells, s.h * s.h * s.h * s.in, outputs,
       g * g * g * s.out);
}

void CellConvTranspose(const CellConvShape& s, const float* outputs, const float* panels,
                       float* cells) {
  const std::int64_t g = s.h - 1;
  // Cells at either end of an axis have one tap along it, all others two: 27 kinds.
  const std::array<std::int64_t, 4> bounds = {0, 1, g, s.h};
  for (int kind = 0; kind < 27; ++kind) {
    const std::array<int, 3> where = {kind / 9, kind / 3 % 3, kind % 3};
    Taps taps;
    for (int t = 0; t < 8; ++t) {
      const std::array<int, 3> shift = {t >> 2, t >> 1 & 1, t & 1};
      bool inside = true;
      for (int axis = 0; axis < 3; ++axis) {
        inside = inside && !(where[axis] == 0 && shift[axis] == 1) &&
                 !(where[axis] == 2 && shift[axis] == 0);
      }
      if (!inside) continue;
      taps.offset[taps.count] = -Index(shift[0], shift[1], shift[2], g) * s.out;
      taps.tap[taps.count++] = t;
    }
    std::vector<Position> positions;
    for (std::int64_t z = bounds[where[0]]; z < bounds[where[0] + 1]; ++z) {
      for (std::int64_t y = bounds[where[1]]; y < bounds[where[1] + 1]; ++y) {
        for (std::int64_t x = bounds[where[2]]; x < bounds[where[2] + 1]; ++x) {
          positions.push_back({Index(z, y, x, g) * s.out, Index(z, y, x, s.h) * s.in});
        }
      }
    }
    if (positions.empty()) continue;
    Fill(positions, taps, s.count, s.out, s.in, panels, nullptr, outputs, g * g * g * s.out, cells,
         s.h * s.h * s.h * s.in);
  }
}

void CellConvWeightGradient(const CellConvShape& s, const float* cells,
                            const float* output_gradient, float* gradient) {
  std::fill(gradient, gradient + 8 * s.in * s.out, 0.0F);
  const std::int64_t g = s.h - 1, positions = s.count * g * g * g;
  // A task belongs to one piece: the same sums for any number of threads.
  const std::int64_t blocks = (s.in + kBlock - 1) / kBlock, tasks = 8 * blocks;
  ForRanges(tasks, (tasks + PieceThreads() - 1) / PieceThreads(),
            [&](std::int64_t begin, std::int64_t end) {
              ChunkProducts products(s);
              for (std::int64_t first = 0; first < positions; first += kChunk) {
                products.Gather(first, std::min(positions, first + kChunk), output_gradient);
                for (std::int64_t task = begin; task < end; ++task) {
                  products.Add(static_cast<int>(task / blocks), task % blocks * kBlock, cells,
                               gradient);
                }
              }
            });
}

}  // namespace antigrasp
