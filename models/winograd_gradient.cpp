#include "antigrasp/core/pieces.h"
#include "antigrasp/models/winograd_conv.h"
#include "antigrasp/models/winograd_sums.h"
#include "antigrasp/models/winograd_tiles.h"
#include "antigrasp/models/winograd_weights.h"

// Compiled for AVX2 and FMA, like all of Winograd's convolution but its products.
namespace antigrasp {
namespace winograd {
namespace {

// Gradients of factors of one block of inputs, summed over blocks of tiles: sums [27][out / 16]
// [rows][16], the 27 SumStep() floats apart.
class BlockGradient {
 public:
  BlockGradient(const CellConvShape& shape, const InputBlock& block, float* sums)
      : s_(shape),
        block_(block),
        rows_(4 * block.width),
        cell_(StepsOf(shape.h, shape.in)),
        output_(StepsOf(shape.h - 1, shape.out)),
        value_step_(kTiles * rows_ + kPadding),
        spread_step_(kTiles * shape.out + kPadding),
        sum_step_(SumStep(shape, block.width)),
        values_(AllocateFloats(9 * value_step_)),
        spread_(AllocateFloats(9 * spread_step_)),
        sums_(sums) {}

  static std::int64_t SumStep(const CellConvShape& shape, std::int64_t width) {
    return 4 * width * shape.out + kPadding;
  }

  template <int Z>
  void Add(const TileBlock& tiles, const float* cells, const float* output_gradient, bool first) {
    const float* phases = cells + 4 * block_.pz * (s_.in / 8) + block_.first;
    for (std::int64_t r = 0; r < tiles.count; ++r) {
      for (int p = 0; p < 4; ++p) {
        DifferenceCells<Z>(phases + tiles.cells[r] + p * (s_.in / 8), cell_, block_.width,
                           values_.get() + r * rows_ + p * block_.width, value_step_);
      }
      for (std::int64_t o = 0; o < s_.out; o += kPanel) {
        SpreadOutputs<Z>(output_gradient + tiles.outputs[r] + o, output_, kPanel,
                         spread_.get() + o * kTiles + r * kPanel, spread_step_);
      }
    }
    for (int k = 0; k < 9; ++k) {
      add_products_({.rows = rows_,
                     .depth = tiles.count,
                     .width = s_.out,
                     .left = values_.get() + k * value_step_,
                     .left_row_step = 1,
                     .left_depth_step = rows_,
                     .right = spread_.get() + k * spread_step_,
                     .right_panel_step = kTiles * kPanel,
                     .sums = sums_ + (9 * Z + k) * sum_step_,
                     .sums_row_step = kPanel,
                     .sums_panel_step = rows_ * kPanel,
                     .first = first});
    }
  }

 private:
  const ProductKernel add_products_ = BestProductKernel();
  CellConvShape s_;
  InputBlock block_;
  std::int64_t rows_;
  Steps cell_, output_;
  std::int64_t value_step_, spread_step_, sum_step_;
  Floats values_, spread_;
  float* sums_;
};

}  // namespace
}  // namespace winograd

void WinogradConvWeightGradient(const CellConvShape& s, const float* cells,
                                const float* output_gradient, float* weight_gradient) {
  using namespace winograd;
  const std::int64_t channels = s.in / 8, t = (s.h - 1) / 2, tiles = s.count * t * t * t;
  const std::int64_t width = channels % 16 == 0 ? 16 : 8, blocks = channels / width;
  const auto block_of = [&](std::int64_t i) { return InputBlock{i % 2, i / 2 * width, width}; };
  const std::int64_t step = BlockGradient::SumStep(s, width);
  const Floats sums = AllocateFloats(2 * blocks * 27 * step);
  // A sum belongs to one piece, the same for any number of threads: three planes of a block, which
  // share what they read, or one.
  const std::int64_t cuts = 2 * blocks < PieceThreads() ? 3 : 1;
  ForPieces(2 * blocks * cuts, [&](std::int64_t i) {
    const std::int64_t plane = cuts == 3 ? i / (2 * blocks) : -1, b = i % (2 * blocks);
    BlockGradient gradient(s, block_of(b), sums.get() + b * 27 * step);
    for (std::int64_t first = 0; first < tiles; first += kTiles) {
      const TileBlock block(s, first, std::min(kTiles, tiles - first));
      if (plane <= 0) gradient.Add<0>(block, cells, output_gradient, first == 0);
      if (plane < 0 || plane == 1) gradient.Add<1>(block, cells, output_gradient, first == 0);
      if (plane < 0 || plane == 2) gradient.Add<2>(block, cells, output_gradient, first == 0);
    }
  });
  ForPieces(2 * blocks, [&](std::int64_t b) {
    GatherWeightGradient(s, block_of(b), sums.get() + b * 27 * step, step, weight_gradient);
  });
}

}  // namespace antigrasp
